// Positions of points of a mesh's space, for the flat geometry of places. In the plane they are x, y, 0; on the sphere
// the direction, of length 1. Triangles of the sphere are the flat triangles between these. A point is in the triangle
// that its ray from the center meets, and data are linear there. Weights do not count.
#pragma once

#include "temper/mesh.hpp"

namespace temper {

[[nodiscard]] inline Vec3 position_of(const Space& space, const WeightedPoint& p) {
  if (space.is_plane()) return {p.x, p.y, 0};
  return (1 / length(as_vector(p))) * as_vector(p);
}
[[nodiscard]] inline Vec3 position_of(const Mesh& mesh, VertexId v) { return position_of(mesh.space(), mesh.point(v)); }
/// The image of a vertex in a periodic plane that is nearest to a point.
[[nodiscard]] inline Vec3 position_of(const Mesh& mesh, VertexId v, const WeightedPoint& near) {
  return position_of(mesh.space(), mesh.point(v, near));
}
[[nodiscard]] inline std::array<Vec3, 3> positions_of(const Mesh& mesh, TriangleId t) {
  const auto [a, b, c] = mesh.points(t);
  const Space& space = mesh.space();
  return {position_of(space, a), position_of(space, b), position_of(space, c)};
}

/// Twice the area of the triangle of p and two others, or on the sphere the determinant of the three. `to_a` and `to_b`
/// are vectors to the others, from p or from each other. Positive when counter-clockwise.
[[nodiscard]] inline double spanned(const Space& space, Vec3 p, Vec3 to_a, Vec3 to_b) {
  const Vec3 n = cross(to_a, to_b);
  return space.is_plane() ? n.z : dot(p, n);
}

/// The position of p on the edge from a to b, as a part of the way.
[[nodiscard]] inline double part_of_edge(const Space& space, Vec3 a, Vec3 b, Vec3 p) {
  if (space.is_plane()) return dot(p - a, b - a) / squared_length(b - a);
  const double from_a = length(cross(a, p - a)), from_b = length(cross(b, p - b));
  return from_a / (from_a + from_b);
}

}  // namespace temper
