// Linear programs by Clp (COIN-OR): what temper/feasibility.hpp needs, in a library of its own (temper::lp).
#pragma once

#include <memory>

#include "temper/feasibility.hpp"

namespace temper {

/// Clp's simplex methods. Deterministic; one solver may be used from one thread at a time.
[[nodiscard]] std::unique_ptr<LpSolver> clp_solver();

}  // namespace temper
