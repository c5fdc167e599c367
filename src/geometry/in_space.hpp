// Constructions in the space of a mesh, for those who repair it: what they make, the optimiser moves on.
//
// On the sphere a place is any point in its direction.
#pragma once

#include <array>
#include <cmath>

#include "temper/detail/geometry.hpp"
#include "temper/detail/space.hpp"

namespace temper {

/// The places midway; their weights mean nothing.
[[nodiscard]] inline WeightedPoint middle(const Space& space, const WeightedPoint& a, const WeightedPoint& b) {
  if (!space.is_plane()) return as_point(0.5 * (lifted(a) + lifted(b)));
  const Vec2 p = 0.5 * (a.position() + b.position());
  return {p.x, p.y, 0};
}
[[nodiscard]] inline WeightedPoint middle(const Space& space, const WeightedPoint& a, const WeightedPoint& b,
                                          const WeightedPoint& c) {
  if (!space.is_plane()) return as_point((1.0 / 3) * (lifted(a) + lifted(b) + lifted(c)));
  const Vec2 p = (1.0 / 3) * (a.position() + b.position() + c.position());
  return {p.x, p.y, 0};
}

/// The place of the orthocenter, with weight 0.
[[nodiscard]] inline WeightedPoint orthocenter(const Space& space, const WeightedPoint& a, const WeightedPoint& b,
                                               const WeightedPoint& c) {
  if (!space.is_plane()) return as_point(space.radius() * orthocenter(lifted(a), lifted(b), lifted(c)));
  const Vec2 o = orthocenter(a, b, c);
  return {o.x, o.y, 0};
}

/// The vertex at a place inside triangle abc with the weight that is linear between the corners': never hidden, since
/// the plane through the lifted corners is beyond.
[[nodiscard]] inline WeightedPoint with_interpolated_weight(const Space& space, const WeightedPoint& p,
                                                            const WeightedPoint& a, const WeightedPoint& b,
                                                            const WeightedPoint& c) {
  const auto across = [&](const WeightedPoint& q, const WeightedPoint& r) {  // of the triangle pqr, or of 0pqr
    return space.is_plane() ? cross(q.position() - p.position(), r.position() - p.position())
                            : dot(lifted(p), cross(lifted(q), lifted(r)));
  };
  const double at_a = across(b, c), at_b = across(c, a), at_c = across(a, b);
  return space.with_weight(
      p, (at_a * space.weight(a) + at_b * space.weight(b) + at_c * space.weight(c)) / (at_a + at_b + at_c));
}

/// The place in the coordinates of its space, without its weight: of the plane with z = 0.
[[nodiscard]] inline Vec3 place_in_space(const Space& space, const WeightedPoint& p) {
  return space.is_plane() ? Vec3{p.x, p.y, 0} : lifted(space.with_weight(p, 0));
}

/// The dual of the edge ab with c on its left and d on its right [length]. Signed.
[[nodiscard]] inline double dual_length(const Space& space, const WeightedPoint& a, const WeightedPoint& b,
                                        const WeightedPoint& c, const WeightedPoint& d) {
  if (space.is_plane()) return signed_height(a, b, c) + signed_height(b, a, d);
  const Vec3 p = lifted(a), q = lifted(b);
  return space.radius() * (signed_height(p, q, lifted(c)) + signed_height(q, p, lifted(d)));
}

/// The weighted midpoint of an edge; on the sphere the foot of the perpendicular from its center.
[[nodiscard]] inline WeightedPoint weighted_midpoint(const Space& space, const WeightedPoint& a,
                                                     const WeightedPoint& b) {
  const Vec3 p = lifted(a), along = space.chord(a, b);
  if (!space.is_plane()) return as_point(p - (dot(p, along) / squared_length(along)) * along);
  const double part = edge_split(a, b) / length(along);
  return {a.x + part * along.x, a.y + part * along.y, 0};
}

/// Twice the area of a triangle, of which one corner is p; on the sphere of that of the lifted points.
[[nodiscard]] inline double unsigned_doubled_area(const Space& space, const WeightedPoint& p, const WeightedPoint& q,
                                                  const WeightedPoint& r) {
  const Vec3 across = cross(space.chord(p, q), space.chord(p, r));
  return space.is_plane() ? std::abs(across.z) : length(across);
}

/// Of three vertices on one line: is b on a's side of v? (On the sphere less than half the way around; the normals of
/// both great circles are the same, or opposite.) Exact.
[[nodiscard]] inline bool is_ahead(const Space& space, const WeightedPoint& v, const WeightedPoint& a,
                                   const WeightedPoint& b) {
  if (!space.is_plane()) return dot(cross(lifted(v), lifted(a)), cross(lifted(v), lifted(b))) > 0;
  return (v.x < a.x) == (v.x < b.x) && (v.x > a.x) == (v.x > b.x) && (v.y < a.y) == (v.y < b.y) &&
         (v.y > a.y) == (v.y > b.y);
}

/// A vertex seen from the origin on the lifted surface: in the plane with its height there.
[[nodiscard]] inline Vec3 on_lifted_surface(const Space& space, const WeightedPoint& p, const WeightedPoint& origin) {
  const double x = p.x - origin.x, y = p.y - origin.y, w = p.w - origin.w;
  return {x, y, space.is_plane() ? x * x + y * y - w : w};
}
/// Six times the volume between a triangle of such points and the plane z = 0. On the sphere the surface of least
/// volume is the farthest out: minus that of the tetrahedron with the origin, which is no constant apart from that with
/// the center of the sphere.
[[nodiscard]] inline double volume_under(const Space& space, Vec3 a, Vec3 b, Vec3 c) {
  if (!space.is_plane()) return -dot(a, cross(b, c));
  const double doubled_area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  return doubled_area * (a.z + b.z + c.z);
}

}  // namespace temper
