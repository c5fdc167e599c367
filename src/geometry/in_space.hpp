// Constructions in the space of a mesh, for those who repair it: what they make, the optimiser moves on.
//
// On the sphere a place is any point in its direction.
#pragma once

#include <array>

#include "temper/geometry.hpp"
#include "temper/space.hpp"

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

}  // namespace temper
