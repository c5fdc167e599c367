// BoundaryVertices::split: long edges of the boundary and of constrained lines, where they meet short ones, are cut
// before the sweeps. A long edge beside a short one is what plain sweeps cannot mend: no position of the vertices
// inside gives both of their triangles an orthocenter of their own.
//
// First come edges on which no dual can cross, or hardly (temper/detail/necessity.hpp): no mesh inside makes up for
// them. The other cuts are those of plan_boundary_grading(), but at places that the user's coordinates can hold, and
// told to the recorder one by one.
#pragma once

#include <cstddef>

#include "optimize/flips/flipper.hpp"

namespace temper {

struct SplitCounts {
  std::size_t vertices = 0;   ///< inserted on edges
  std::size_t conflicts = 0;  ///< of these, on edges that left their dual no room or little
  std::size_t inside = 0;     ///< inserted in triangles whose corners all are on the boundary or on lines
  std::size_t refused = 0;    ///< edges not cut: a triangle would be turned over, by rounding, or a vertex hidden
  double ratio_before = 1;    ///< of the lengths of two such edges that meet at a vertex
  double ratio_after = 1;     ///< the same after all cuts
};
/// Both together, those of b after those of a.
[[nodiscard]] SplitCounts operator+(const SplitCounts& a, const SplitCounts& b);

/// The mesh's unconstrained edges are regular, and so they are left.
SplitCounts split_boundary(WorkingCopy& work, Flipper& flipper, double ratio);
/// The same at the corners of bad triangles alone: of lines that leave a dual no room or little; else, at each triangle
/// without such, the longest one is halved.
SplitCounts split_where_bad(WorkingCopy& work, Flipper& flipper);

}  // namespace temper
