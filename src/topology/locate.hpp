// Point location: finds the triangle that a point is in, exactly.
//
// A visibility walk: from a triangle across the first of its edges that has the point on its outer side, to the next.
// It may run into a hole or a bay of the domain, and where the mesh is not Delaunay even in circles; then all triangles
// are asked. The answer is the same either way: a point is in one triangle, on one edge, or at one vertex.
#pragma once

#include "temper/mesh.hpp"

namespace temper {

/// The place of a point in a mesh.
struct Location {
  enum class Kind { outside, in_triangle, on_edge, at_vertex };
  Kind kind = Kind::outside;
  TriangleId triangle;  ///< that the point is in, its sides included; invalid outside
  HalfedgeId edge;      ///< on_edge: that edge, from its end of smaller number where both sides have triangles
};

/// The place of a vertex, its weight whatever it is. `near`: where to begin; may be invalid. About O(√n) when the way
/// is free, else O(n).
[[nodiscard]] Location locate(const Mesh& mesh, const WeightedPoint& p, TriangleId near);
/// Of a point of the plane.
[[nodiscard]] inline Location locate(const Mesh& mesh, Vec2 p, TriangleId near) {
  return locate(mesh, WeightedPoint{p.x, p.y, 0}, near);
}

}  // namespace temper
