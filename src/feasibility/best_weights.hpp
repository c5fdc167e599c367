// Weights that are best by one convex program over the whole mesh: WeightGoal::center and WeightGoal::accuracy.
#pragma once

#include <optional>

#include "feasibility/demand.hpp"
#include "temper/detail/convex.hpp"
#include "temper/feasibility.hpp"

namespace temper {

/// Says whether a convex program finds the weights of this goal.
[[nodiscard]] constexpr bool is_convex(WeightGoal goal) {
  return goal == WeightGoal::center || goal == WeightGoal::accuracy;
}

/// The value of an offset less its target, linear in the potentials.
[[nodiscard]] LinearForm offset_form(const Demand& demand, const OffsetTerm& term);

/// The best weights, with a margin for accuracy. Nothing if the solver finds none whose cells keep their constraints,
/// exactly: there may be none.
[[nodiscard]] std::optional<WeightReport> best_weights(const Demand& demand, ConvexSolver& solver,
                                                       const WeightOptions& options, double margin);

}  // namespace temper
