// Point location: finds the triangle that a point is in, exactly.
//
// A visibility walk goes from a triangle across its first edge with the point on its outer side, to the next triangle.
// It may run into a hole or a bay of the domain, and without the Delaunay property even in circles. Then all triangles
// are tested. The answer is the same either way: a point is in one triangle, on one edge, or at one vertex.
#pragma once

#include "temper/mesh.hpp"

namespace temper {

struct Location {
  enum class Kind { outside, in_triangle, on_edge, at_vertex };
  Kind kind = Kind::outside;
  TriangleId triangle;  ///< that the point is in, its sides included; invalid outside
  HalfedgeId edge;      ///< on_edge: that edge, from its end of smaller number where both sides have triangles
};

/// The place of a vertex, whatever its weight. The walk begins at `near`, which may be invalid. About O(√n) when the
/// way is free, else O(n).
[[nodiscard]] Location locate(const Mesh& mesh, const WeightedPoint& p, TriangleId near);
/// The place of a point of the plane.
[[nodiscard]] inline Location locate(const Mesh& mesh, Vec2 p, TriangleId near) {
  return locate(mesh, WeightedPoint{p.x, p.y, 0}, near);
}

}  // namespace temper
