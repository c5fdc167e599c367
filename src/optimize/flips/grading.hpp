// BoundaryVertices::split cuts long edges of the boundary and of constrained lines next to short ones, before the
// sweeps. Sweeps cannot repair such a pair of edges: no position of the inner vertices puts orthocenters inside both
// triangles.
//
// The first cuts are on edges that leave their dual little or no room to cross (temper/detail/necessity.hpp), since no
// mesh inside can help there. plan_boundary_grading() plans the other cuts. Each cut is at a place that the user's
// coordinates can hold, and goes to the recorder.
#pragma once

#include <cstddef>

#include "optimize/flips/flipper.hpp"
#include "optimize/flips/guard.hpp"

namespace temper {

struct SplitCounts {
  std::size_t vertices = 0;   ///< inserted on edges
  std::size_t conflicts = 0;  ///< of these, on edges that left their dual little or no room
  std::size_t inside = 0;     ///< inserted in triangles with all corners on the boundary or on lines
  std::size_t refused = 0;    ///< edges not cut: rounding would turn over a triangle, a vertex be hidden, or
                              ///< there would be too many cuts
  double ratio_before = 1;    ///< largest ratio of lengths of two such edges that meet
  double ratio_after = 1;     ///< this ratio after all cuts
};
/// Adds the counts of cuts a, and cuts b after them.
[[nodiscard]] SplitCounts operator+(const SplitCounts& a, const SplitCounts& b);

/// The mesh's unconstrained edges are regular, before and after.
SplitCounts split_boundary(WorkingCopy& work, Flipper& flipper, double ratio,
                           const std::shared_ptr<const GuardLimits>& guard = nullptr);
/// Splits at the corners of bad triangles alone. There it splits lines that leave their dual little or no room. If a
/// bad triangle has no such line, its longest line is halved.
SplitCounts split_where_bad(WorkingCopy& work, Flipper& flipper,
                            const std::shared_ptr<const GuardLimits>& guard = nullptr);

}  // namespace temper
