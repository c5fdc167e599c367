// Orthocenters, heights and crossings in doubles.
//
// Everything starts from differences of positions and of weights. They are nearly exact for neighbors in a mesh,
// however far these are from the origin, and however large a constant all weights share.
#include <array>
#include <cmath>

#include "geometry/surface.hpp"
#include "temper/detail/geometry.hpp"

namespace temper {

// Let a = q − p, b = r − p and o = p + c. Then 2 a·c = |a|² + w_p − w_q and 2 b·c = |b|² + w_p − w_r.
Vec2 orthocenter(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  const Vec2 a = q.position() - p.position();
  const Vec2 b = r.position() - p.position();
  const double along_a = squared_length(a) + (p.w - q.w);
  const double along_b = squared_length(b) + (p.w - r.w);
  const double scale = 0.5 / cross(a, b);
  return p.position() + scale * Vec2{along_a * b.y - along_b * a.y, along_b * a.x - along_a * b.x};
}

double dual_crossing(const WeightedPoint& p, const WeightedPoint& q) {
  const double l = length(q.position() - p.position());
  return 0.5 * (l + (p.w - q.w) / l);
}

double signed_height(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  return scaled_heights(p, q, r)[2] / length(q.position() - p.position());
}

// Let D_p = (q − p)·(r − p) and so on be dot products at the corners, and S twice the area. Then, cyclically,
//   2 S h_pq ℓ_pq = D_p (D_r + w_q − w_r) + D_q (D_r + w_p − w_r).
// The weights drop out of the sum over the edges, which is 2 (D_p D_q + D_q D_r + D_r D_p) = 2 S².
std::array<double, 3> scaled_heights(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  const Vec2 pq = q.position() - p.position();
  const Vec2 qr = r.position() - q.position();
  const Vec2 rp = p.position() - r.position();
  const double at_p = -dot(pq, rp);
  const double at_q = -dot(qr, pq);
  const double at_r = -dot(rp, qr);
  const double pq_w = p.w - q.w;
  const double qr_w = q.w - r.w;
  const double rp_w = r.w - p.w;
  const double scale = 0.5 / cross(pq, qr);
  return {scale * (at_q * (at_p + rp_w) + at_r * (at_p - pq_w)), scale * (at_r * (at_q + pq_w) + at_p * (at_q - qr_w)),
          scale * (at_p * (at_r + qr_w) + at_q * (at_r - rp_w))};
}

double doubled_area(Vec2 p, Vec2 q, Vec2 r) { return cross(q - p, r - p); }

// atan2 keeps its digits for angles near 0 and π, unlike acos of the normalized dot product.
double corner_angle(Vec2 p, Vec2 q, Vec2 r) {
  const Vec2 a = q - p;
  const Vec2 b = r - p;
  return std::atan2(std::abs(cross(a, b)), dot(a, b));
}

// --- on the sphere ----------------------------------------------------------------------------------------------
//
// Cross products of neighbors by their difference, P × Q = P × (Q − P), which keeps its digits where arcs are short.

Vec3 orthocenter(Vec3 p, Vec3 q, Vec3 r) {
  const Vec3 n = cross(q - p, r - p);
  return (1 / length(n)) * n;
}

double arc_length(Vec3 p, Vec3 q) { return std::atan2(length(cross(p, q - p)), dot(p, q)); }

double dual_crossing(Vec3 p, Vec3 q) { return std::atan2(dot(p, p - q), length(cross(p, q - p))); }

double signed_height(Vec3 p, Vec3 q, Vec3 r) {
  const Vec3 n = cross(q - p, r - p), m = cross(p, q - p);
  return std::atan2(dot(m, n), length(cross(m, n)));
}

double corner_angle(Vec3 p, Vec3 q, Vec3 r) {
  const Vec3 u = cross(p, q - p), v = cross(p, r - p);
  return std::atan2(length(cross(u, v)), dot(u, v));
}

double solid_angle(Vec3 p, Vec3 q, Vec3 r) { return solid_angle(dot(p, cross(q - p, r - p)), p, q, r); }

double distance(const Space& space, const WeightedPoint& p, const WeightedPoint& q) {
  return space.is_plane() ? length(q.position() - p.position())
                          : space.radius() * arc_length(as_vector(p), as_vector(q));
}

double corner_angle(const Space& space, const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  return space.is_plane() ? corner_angle(p.position(), q.position(), r.position())
                          : corner_angle(as_vector(p), as_vector(q), as_vector(r));
}

}  // namespace temper
