// Solves the programs of temper/feasibility.hpp: linear ones by Clp (COIN-OR), convex ones by temper's interior point
// method. Eigen orders the unknowns. It is a library of its own, temper::lp.
#pragma once

#include <memory>

#include "temper/detail/convex.hpp"
#include "temper/feasibility.hpp"

namespace temper {

/// Returns Clp's simplex methods. Deterministic. Only one thread at a time may use one solver.
[[nodiscard]] std::unique_ptr<LpSolver> clp_solver();

/// Returns a primal-dual interior point method for the best weights. Deterministic. It takes O(n) memory and, for
/// meshes of the plane, some O(n^1.5) time per iteration; 3 to 30 iterations are usual.
[[nodiscard]] std::unique_ptr<ConvexSolver> interior_point_solver();

}  // namespace temper
