// The lengths of edges and of their duals, on the sphere those of arcs.
#pragma once

#include "temper/geometry.hpp"
#include "temper/space.hpp"

namespace temper {

[[nodiscard]] inline double edge_length(const Space& space, const WeightedPoint& a, const WeightedPoint& b) {
  if (space.is_plane()) return length(b.position() - a.position());
  return space.radius() * arc_length(lifted(a), lifted(b));
}

/// Of the edge ab with c on its left and d on its right. Signed.
[[nodiscard]] inline double dual_length(const Space& space, const WeightedPoint& a, const WeightedPoint& b,
                                        const WeightedPoint& c, const WeightedPoint& d) {
  if (space.is_plane()) return signed_height(a, b, c) + signed_height(b, a, d);
  const Vec3 p = lifted(a), q = lifted(b);
  return space.radius() * (signed_height(p, q, lifted(c)) + signed_height(q, p, lifted(d)));
}

}  // namespace temper
