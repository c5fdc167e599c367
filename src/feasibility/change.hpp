// The weights of one region with the least change, or the least violation, for a margin.
#pragma once

#include <functional>
#include <vector>

#include "feasibility/demand.hpp"
#include "feasibility/region.hpp"
#include "temper/feasibility.hpp"

namespace temper {

struct RegionChange {
  LpStatus status = LpStatus::failed;
  std::vector<double>
      change;  ///< of the potential (potential.hpp) of each free vertex; exactly 0 where nothing has to change
  std::vector<WeightConstraint> conflict = {};  ///< of least_squares, if there are no weights: where the conflict is
  double violation = 0;                         ///< of least_squares: the sum of all violations
};

/// The constraints on the weights of a region.
struct RegionProblem {
  const Demand& demand;
  const VertexWeights& start;  ///< the weights before the change; the weights of the rim stay
  double margin = 0;
  double floor = -kUnbounded;  ///< elastic weights have at least this margin, whatever they violate
  std::function<bool()> must_stop = {};

  /// What one constraint must keep for a margin. If zero is allowed, a constraint inside may stay as small as it was.
  [[nodiscard]] double margin_of(const WeightConstraint& constraint, double asked) const;
};

/// Minimizes Σ |Δw_i − Δw_j| / (2ℓ) over the edges of the region, subject to the margin.
[[nodiscard]] RegionChange least_change(const RegionProblem& problem, const Region& region, LpSolver& solver);

/// Constraints that least_squares may violate, down to the floor.
enum class MayViolate {
  none,
  least,  ///< with the least sum, up to the solver's weighting
  few,    ///< then programs in which a violation costs less, the larger it was: the fewest violations of all
};
/// Minimizes Σ (Δd/ℓ)² over the edges of the region, subject to the margin.
[[nodiscard]] RegionChange least_squares(const RegionProblem& problem, const Region& region, ConvexSolver& solver,
                                         MayViolate may_violate = MayViolate::none);

/// Minimizes the violation of the margin, summed over h/ℓ, d/ℓ, 1 − d/ℓ and dual length/ℓ. Among these weights it takes
/// the weights with the least change. No weights: `floor` is above what the region can have.
[[nodiscard]] RegionChange least_violation(const RegionProblem& problem, const Region& region, LpSolver& solver);

}  // namespace temper
