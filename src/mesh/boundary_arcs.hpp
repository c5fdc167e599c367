// The boundary of a mesh of the sphere: do its arcs cross or touch, does a component lie on another one?
//
// A component whose stars wind once and whose boundary loops are simple and apart covers no spot twice. It is mapped to
// the sphere without folds; the b loops cut the sphere into b + 1 regions, and region r is covered d_r times, once more
// on the left of each loop than on its right. Counting Euler characteristics, Σ d_r (2 − loops of r) = 2 − 2g − b for
// genus g, which is Σ d_r (1 − i_r) = 1 − g with i_r the loops that have r on their right. Of regions that are on the
// right of none there is at least one, each covered, and one more than Σ (i_r − 1) over those with i_r ≥ 1; each of
// these is covered less often than those around it. So the sum is at least 1, and it is 1 only when d is 1 in one
// region and 0 in all others. Without boundary the component is a covering of the sphere, which has none but itself.
#pragma once

#include <optional>

#include "mesh/boundary_sweep.hpp"

namespace temper {

/// Finds a clash, as find_boundary_clash() does in the plane; of what is `covered`, `first` is any halfedge. Exact.
/// Preconditions: the mesh lies on the sphere; stars are whole and wind once. O(m k + n c) for m boundary edges with k
/// others at their latitude, and c components.
[[nodiscard]] std::optional<BoundaryClash> find_arc_clash(const Mesh& mesh);

}  // namespace temper
