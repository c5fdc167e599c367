// Areas of triangles, above all of the sphere, from what is known of them already.
#pragma once

#include <cmath>

#include "temper/detail/space.hpp"
#include "temper/detail/vec3.hpp"

namespace temper {

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

}  // namespace temper
