// From the dual of the margin program to a certificate that the exact checker accepts.
#pragma once

#include <span>
#include <vector>

#include "feasibility/demand.hpp"
#include "temper/feasibility.hpp"

namespace temper {

/// The search for a certificate begins when the best margin is at most this: the rounding of the program. The
/// certificate itself is checked exactly.
inline constexpr double kNoMargin = 1e-9;

/// The program of best_margin, solved, with the constraints of its rows and their multipliers.
struct Bound {
  BestMargin best;  ///< without certificate
  std::vector<WeightConstraint> constraints;
  std::vector<double> dual;
  double attained = 0;  ///< sphere: the margin of the weights; `best.margin`, except for the last digits
};
[[nodiscard]] Bound bound_margin(const Demand& demand, std::span<const CellId> cells, LpSolver& solver);

/// The margin to refute when a bound rules out all weights. `duals`: for dual lengths in the plane, unless the best
/// margin is below zero.
[[nodiscard]] inline double refuted_margin(const Demand& demand, const Bound& bound, double duals) {
  const bool may_be_negative = demand.has_outer_heights() || demand.is_curved();
  if (!demand.has_duals() || (may_be_negative && bound.best.margin < -kNoMargin)) return 0;
  return demand.space().is_plane() && !demand.is_curved() ? duals : kLeastRefutedDual;
}

/// The best margin of some cells, with a certificate if there are no weights.
[[nodiscard]] BestMargin best_margin_of(const Demand& demand, std::span<const CellId> cells, LpSolver& solver);

/// A certificate that refutes the margin, with as few terms as possible; without terms when the checker accepts none.
[[nodiscard]] Certificate certify(const Demand& demand, const Bound& bound, double margin);

}  // namespace temper
