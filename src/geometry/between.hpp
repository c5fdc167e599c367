// Points on one line, or on one great circle.
#pragma once

#include <algorithm>
#include <optional>

#include "geometry/predicates_inline.hpp"
#include "temper/detail/space.hpp"
#include "temper/detail/vec2.hpp"
#include "temper/detail/vec3.hpp"

namespace temper {

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
                          : is_between(lifted(a), lifted(b), lifted(p));
}

}  // namespace temper
