// Constructions in the space of a mesh, for those who repair it: what they make, the optimiser moves on.
//
// On the sphere a place is any point in its direction.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "geometry/predicates_inline.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/detail/space.hpp"
#include "temper/detail/vec.hpp"

namespace temper {

/// The places midway; their weights mean nothing.
[[nodiscard]] inline WeightedPoint middle(const Space& space, const WeightedPoint& a, const WeightedPoint& b) {
  if (!space.is_plane()) return as_point(0.5 * (as_vector(a) + as_vector(b)));
  const Vec2 p = 0.5 * (a.position() + b.position());
  return {p.x, p.y, 0};
}
[[nodiscard]] inline WeightedPoint middle(const Space& space, const WeightedPoint& a, const WeightedPoint& b,
                                          const WeightedPoint& c) {
  if (!space.is_plane()) return as_point((1.0 / 3) * (as_vector(a) + as_vector(b) + as_vector(c)));
  const Vec2 p = (1.0 / 3) * (a.position() + b.position() + c.position());
  return {p.x, p.y, 0};
}

/// The place of the orthocenter, with weight 0.
[[nodiscard]] inline WeightedPoint orthocenter(const Space& space, const WeightedPoint& a, const WeightedPoint& b,
                                               const WeightedPoint& c) {
  if (!space.is_plane()) return as_point(space.radius() * orthocenter(as_vector(a), as_vector(b), as_vector(c)));
  const Vec2 o = orthocenter(a, b, c);
  return {o.x, o.y, 0};
}

/// The vertex at a place inside triangle abc with the weight that is linear between the corners': never hidden, since
/// the plane through the weighted vectors of the corners is beyond.
[[nodiscard]] inline WeightedPoint with_interpolated_weight(const Space& space, const WeightedPoint& p,
                                                            const WeightedPoint& a, const WeightedPoint& b,
                                                            const WeightedPoint& c) {
  const auto across = [&](const WeightedPoint& q, const WeightedPoint& r) {  // of the triangle pqr, or of 0pqr
    return space.is_plane() ? cross(q.position() - p.position(), r.position() - p.position())
                            : dot(as_vector(p), cross(as_vector(q), as_vector(r)));
  };
  const double at_a = across(b, c), at_b = across(c, a), at_c = across(a, b);
  return space.with_weight(
      p, (at_a * space.weight(a) + at_b * space.weight(b) + at_c * space.weight(c)) / (at_a + at_b + at_c));
}

/// The place in the coordinates of its space, without its weight: of the plane with z = 0.
[[nodiscard]] inline Vec3 place_in_space(const Space& space, const WeightedPoint& p) {
  return space.is_plane() ? Vec3{p.x, p.y, 0} : as_vector(space.with_weight(p, 0));
}

/// The dual of the edge ab with c on its left and d on its right [length]. Signed.
[[nodiscard]] inline double dual_length(const Space& space, const WeightedPoint& a, const WeightedPoint& b,
                                        const WeightedPoint& c, const WeightedPoint& d) {
  if (space.is_plane()) return signed_height(a, b, c) + signed_height(b, a, d);
  const Vec3 p = as_vector(a), q = as_vector(b);
  return space.radius() * (signed_height(p, q, as_vector(c)) + signed_height(q, p, as_vector(d)));
}

/// The weighted midpoint of an edge; on the sphere the foot of the perpendicular from its center.
[[nodiscard]] inline WeightedPoint weighted_midpoint(const Space& space, const WeightedPoint& a,
                                                     const WeightedPoint& b) {
  const Vec3 p = as_vector(a), along = space.chord(a, b);
  if (!space.is_plane()) return as_point(p - (dot(p, along) / squared_length(along)) * along);
  const double part = dual_crossing(a, b) / length(along);
  return {a.x + part * along.x, a.y + part * along.y, 0};
}

/// Twice the area of a triangle, of which one corner is p; on the sphere of that of the weighted vectors.
[[nodiscard]] inline double unsigned_doubled_area(const Space& space, const WeightedPoint& p, const WeightedPoint& q,
                                                  const WeightedPoint& r) {
  const Vec3 across = cross(space.chord(p, q), space.chord(p, r));
  return space.is_plane() ? std::abs(across.z) : length(across);
}

/// Of three vertices on one line: is b on a's side of v? (On the sphere less than half the way around; the normals of
/// both great circles are the same, or opposite.) Exact.
[[nodiscard]] inline bool is_ahead(const Space& space, const WeightedPoint& v, const WeightedPoint& a,
                                   const WeightedPoint& b) {
  if (!space.is_plane()) return dot(cross(as_vector(v), as_vector(a)), cross(as_vector(v), as_vector(b))) > 0;
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

/// The solid angle of PQR whose determinant is known, maybe more accurately than by differences. Van Oosterom and
/// Strackee (1983): tan(E/2) = det(P, Q, R)/(|P||Q||R| + (P·Q)|R| + (Q·R)|P| + (R·P)|Q|).
inline double solid_angle(double determinant, Vec3 p, Vec3 q, Vec3 r) {
  const double a = length(p), b = length(q), c = length(r);
  return 2 * std::atan2(determinant, a * b * c + dot(p, q) * c + dot(q, r) * a + dot(r, p) * b);
}

/// Of the right triangles on both sides of an edge, beside its end at distance d of the weighted midpoint.
inline double right_triangle_areas(const Space& space, double d, double left, double right) {
  if (space.is_plane()) return 0.5 * d * (left + right);
  return space.right_triangle_area(d, left) + space.right_triangle_area(d, right);
}

/// Says whether p is on the closed segment ab, given that the three are collinear.
[[nodiscard]] inline bool is_between(Vec2 a, Vec2 b, Vec2 p) {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

/// Says whether the direction of p is on the closed arc from a to b, shorter than half a great circle, given that the
/// three are on one. Exact: of the planes of two coordinates, in one they are not all on a line through 0.
[[nodiscard]] inline bool is_between(Vec3 a, Vec3 b, Vec3 p) {
  constexpr Vec2 kOrigin = {0, 0};
  const auto from_a_to_b = [&](auto shadow) -> std::optional<bool> {
    const Sign turn = inlined::orient2d(kOrigin, shadow(a), shadow(b));
    if (turn == Sign::zero) return std::nullopt;
    return inlined::orient2d(kOrigin, shadow(a), shadow(p)) != -turn &&
           inlined::orient2d(kOrigin, shadow(p), shadow(b)) != -turn;
  };
  if (const auto xy = from_a_to_b([](Vec3 q) { return Vec2{q.x, q.y}; })) return *xy;
  if (const auto yz = from_a_to_b([](Vec3 q) { return Vec2{q.y, q.z}; })) return *yz;
  return from_a_to_b([](Vec3 q) { return Vec2{q.z, q.x}; }).value_or(false);
}

/// The same in the space of a mesh.
[[nodiscard]] inline bool is_between(const Space& space, const WeightedPoint& a, const WeightedPoint& b,
                                     const WeightedPoint& p) {
  return space.is_plane() ? is_between(a.position(), b.position(), p.position())
                          : is_between(as_vector(a), as_vector(b), as_vector(p));
}

}  // namespace temper
