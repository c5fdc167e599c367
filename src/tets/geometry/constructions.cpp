// Lengths, angles and places in doubles.
#include <algorithm>
#include <cmath>

#include "tets/geometry/formulas.hpp"

namespace temper::tets {

double six_volumes(Vec3 p, Vec3 q, Vec3 r, Vec3 s) { return dot(cross(q - p, r - p), s - p); }

Vec3 orthocenter(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r, const WeightedPoint& s) {
  const Vector<Plain> scaled = orthocenter_polynomial<Plain>(p, q, r, s);
  const double factor = 0.5 / six_volumes(p.position(), q.position(), r.position(), s.position());
  return p.position() + factor * Vec3{scaled.x.value, scaled.y.value, scaled.z.value};
}

Vec3 orthocenter(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  const Vec3 u = q.position() - p.position(), v = r.position() - p.position(), n = cross(u, v);
  const double at_q = squared_length(u) - (q.w - p.w), at_r = squared_length(v) - (r.w - p.w);
  return p.position() + 0.5 / squared_length(n) * (at_q * cross(v, n) + at_r * cross(n, u));
}

double signed_height(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r, const WeightedPoint& s) {
  const Vec3 a = p.position(), b = q.position(), c = r.position();
  return height_polynomial<Plain>(p, q, r, s).value /
         (2 * length(cross(b - a, c - a)) * std::abs(six_volumes(a, b, c, s.position())));
}

double signed_height(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  const Vec3 a = p.position(), b = q.position(), c = r.position();
  return height_polynomial<Plain>(p, q, r).value / (2 * length(b - a) * length(cross(b - a, c - a)));
}

double dual_crossing(const WeightedPoint& p, const WeightedPoint& q) {
  return crossing_polynomial<Plain>(p, q).value / (2 * length(q.position() - p.position()));
}

double dihedral_angle(Vec3 p, Vec3 q, Vec3 r, Vec3 s) {
  const Vec3 edge = q - p, m = cross(edge, r - p), n = cross(edge, s - p);
  return std::atan2(length(edge) * std::abs(dot(m, s - p)), dot(m, n));
}

// Van Oosterom and Strackee, 1983. The volume of a positive tetrahedron may be rounded below 0.
double solid_angle(Vec3 p, Vec3 q, Vec3 r, Vec3 s) {
  const Vec3 a = q - p, b = r - p, c = s - p;
  const double la = length(a), lb = length(b), lc = length(c);
  return 2 * std::atan2(std::max(0.0, dot(cross(a, b), c)),
                        la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
}

}  // namespace temper::tets
