// Linear programs by Clp (COIN-OR), for temper/feasibility.hpp. It is a library of its own, temper::lp.
#pragma once

#include <memory>

#include "temper/feasibility.hpp"

namespace temper {

/// Returns Clp's simplex methods. Deterministic. Only one thread at a time may use one solver.
[[nodiscard]] std::unique_ptr<LpSolver> clp_solver();

}  // namespace temper
