// The weights of one region that change least, or that violate least, for a margin.
#pragma once

#include <vector>

#include "feasibility/constraints.hpp"
#include "feasibility/region.hpp"
#include "temper/feasibility.hpp"

namespace temper {

struct RegionChange {
  LpStatus status = LpStatus::failed;
  std::vector<double>
      change;  ///< of the potential (potential.hpp) of each free vertex; exactly 0 where nothing has to change
};

/// What is asked of the weights of a region.
struct RegionProblem {
  const Mesh& mesh;
  const Demand& demand;
  const IdVector<VertexId, double>& start;  ///< weights that change is measured from; those of the rim stay
  double margin = 0;
};

/// Minimizes Σ |Δw_i − Δw_j| / (2ℓ) over the edges of the region, subject to the margin.
[[nodiscard]] RegionChange least_change(const RegionProblem& problem, const Region& region, LpSolver& solver);

/// Minimizes what h/ℓ, d/ℓ, 1 − d/ℓ and dual length/ℓ lack of the margin, summed; of all such weights those that change
/// least.
[[nodiscard]] RegionChange least_violation(const RegionProblem& problem, const Region& region, LpSolver& solver);

}  // namespace temper
