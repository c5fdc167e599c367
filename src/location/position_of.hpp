// Where points of a mesh's space are, for the flat geometry of places: in the plane x, y, 0; on the sphere the
// direction, of length 1. Triangles of the sphere are the flat ones between these, and a point is in the one that its
// ray from the center meets: there data are linear. Weights do not count.
#pragma once

#include "temper/mesh.hpp"

namespace temper {

[[nodiscard]] inline Vec3 position_of(const Space& space, const WeightedPoint& p) {
  if (space.is_plane()) return {p.x, p.y, 0};
  return (1 / length(as_vector(p))) * as_vector(p);
}
[[nodiscard]] inline Vec3 position_of(const Mesh& mesh, VertexId v) { return position_of(mesh.space(), mesh.point(v)); }
/// Of images of a periodic plane the one nearest to a point.
[[nodiscard]] inline Vec3 position_of(const Mesh& mesh, VertexId v, const WeightedPoint& near) {
  return position_of(mesh.space(), mesh.point(v, near));
}
[[nodiscard]] inline std::array<Vec3, 3> positions_of(const Mesh& mesh, TriangleId t) {
  const auto [a, b, c] = mesh.points(t);
  const Space& space = mesh.space();
  return {position_of(space, a), position_of(space, b), position_of(space, c)};
}

/// What the triangle of p and two others spans, which are `to_a` and `to_b` away from it or from each other: twice its
/// area, or on the sphere the determinant of the three. Positive when counter-clockwise.
[[nodiscard]] inline double spanned(const Space& space, Vec3 p, Vec3 to_a, Vec3 to_b) {
  const Vec3 n = cross(to_a, to_b);
  return space.is_plane() ? n.z : dot(p, n);
}

/// The part of the way from a to b where p, which is on the edge, is.
[[nodiscard]] inline double part_of_edge(const Space& space, Vec3 a, Vec3 b, Vec3 p) {
  if (space.is_plane()) return dot(p - a, b - a) / squared_length(b - a);
  const double from_a = length(cross(a, p - a)), from_b = length(cross(b, p - b));
  return from_a / (from_a + from_b);
}

}  // namespace temper
