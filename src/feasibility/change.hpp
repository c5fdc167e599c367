// The weights of one region that change least, or that violate least, for a margin.
#pragma once

#include <vector>

#include "feasibility/region.hpp"
#include "temper/feasibility.hpp"

namespace temper {

struct RegionChange {
  LpStatus status = LpStatus::failed;
  std::vector<double> change;  ///< Δw of each free vertex; exactly 0 where nothing has to change
};

/// Minimises Σ |Δw_i − Δw_j| / (2ℓ) over the edges of the region, subject to the margin. `start`: weights that change
/// is measured from; those of the rim stay.
[[nodiscard]] RegionChange least_change(const Mesh& mesh, const Region& region, const IdVector<VertexId, double>& start,
                                        double margin, LpSolver& solver);

/// Minimises what h/ℓ, d/ℓ and 1 − d/ℓ lack of the margin, summed; of all such weights those that change least.
[[nodiscard]] RegionChange least_violation(const Mesh& mesh, const Region& region,
                                           const IdVector<VertexId, double>& start, double margin, LpSolver& solver);

}  // namespace temper
