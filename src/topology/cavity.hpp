// The regular triangulation of a cavity: the polygon that the star of a removed vertex leaves.
//
//        3-----2          Of all triangulations of the polygon 0 … k−1 whose triangles are counter-clockwise by the
//       /       \         exact test, the one of least volume under the lifted surface z = |x|² − w. The volume over
//      4         1        a triangle is area × the mean of its corners' heights, so the best triangulation of the
//       \       /         part cut off by a diagonal ij does not depend on the rest: a dynamic programme,
//        5-----0            V(i, j) = min over i < m < j of V(i, m) + V(m, j) + volume(i, m, j),   O(k³).
//
// Why least volume is regular: flipping an edge that is not regular takes the volume of a tetrahedron off (lawson.hpp),
// so where the volume is least no such edge can be flipped. In doubles, relative to the removed vertex: the heights and
// areas are then as small as the star, and what rounding gets wrong is a near tie, which Lawson mends.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "temper/mesh.hpp"

namespace temper {

/// Appends the triangles of the best triangulation of a simple polygon, counter-clockwise, to `triangles`; or nothing,
/// and returns false, when there is none whose diagonals are all new to the mesh. `origin`: what to measure from.
/// Allocates nothing else for polygons of up to 24 corners.
[[nodiscard]] bool triangulate_cavity(const Mesh& mesh, std::span<const VertexId> polygon, const WeightedPoint& origin,
                                      std::vector<std::array<VertexId, 3>>& triangles);

/// Is there an edge between a and b, either way round? O(degree).
[[nodiscard]] bool has_edge(const Mesh& mesh, VertexId a, VertexId b);

}  // namespace temper
