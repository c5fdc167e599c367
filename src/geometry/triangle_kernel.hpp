// The triangle pqr as a function of (x, y, w) of its corner p: what energies and their derivatives need.
//
// With a = q − p, b = r − p, S = a × b, u_a = (|a|² + w_p − w_q)/2, u_b = (|b|² + w_p − w_r)/2, the scaled
// heights g = h ℓ are rational:
//
//   g_pq = (u_b |a|² − u_a a·b)/S     g_rp = (u_a |b|² − u_b a·b)/S     g_qr = S − g_pq − g_rp
//
// h is positive on the left of the directed edges pq, qr, rp, whatever the orientation of the triangle.
#pragma once

#include <array>

#include "temper/vec2.hpp"

namespace temper {

/// Squared length, weight difference and scaled height of one edge: all that an edge energy depends on.
struct EdgeShape {
  double l2 = 0;  ///< ℓ²
  double dw = 0;  ///< w_i − w_j; the energies are even in it
  double g = 0;   ///< h ℓ
};

/// The edges pq, qr, rp.
struct TriangleShape {
  std::array<EdgeShape, 3> edges;
  double doubled_area = 0;  ///< S, signed
};

[[gnu::always_inline]] inline TriangleShape triangle_shape(const WeightedPoint& p, const WeightedPoint& q,
                                                           const WeightedPoint& r) {
  const double ax = q.x - p.x, ay = q.y - p.y, bx = r.x - p.x, by = r.y - p.y;
  const double s = ax * by - ay * bx;
  const double la = ax * ax + ay * ay, lb = bx * bx + by * by, ab = ax * bx + ay * by;
  const double cx = r.x - q.x, cy = r.y - q.y;
  const double wa = p.w - q.w, wb = p.w - r.w;
  const double ua = 0.5 * (la + wa), ub = 0.5 * (lb + wb);
  const double inverse_s = 1.0 / s;
  const double ga = (ub * la - ua * ab) * inverse_s;
  const double gb = (ua * lb - ub * ab) * inverse_s;
  return {{{{la, wa, ga}, {cx * cx + cy * cy, q.w - r.w, s - ga - gb}, {lb, wb, gb}}}, s};
}

/// A symmetric function of (x, y, w): gradient, and Hessian as xx, xy, xw, yy, yw, ww.
struct Jet {
  std::array<double, 3> gradient = {};
  std::array<double, 6> hessian = {};
};

/// Derivatives of the shape by (x, y, w) of p. ∇ℓ² = (−2a, 0), ∇²ℓ² = 2 on the xy diagonal, ∇dw = (0, 0, 1)
/// for pq and rp, and zero for qr, need no storage; what is left are the heights.
struct TriangleJet {
  TriangleShape shape;
  Vec2 a, b;             ///< q − p and r − p
  std::array<Jet, 3> g;  ///< of g_pq, g_qr, g_rp
};

namespace detail {

/// Numerator N = u_b |a|² − u_a a·b of g_pq over S, differentiated twice, and divided by S.
/// N's Hessian: xy block (|a|² + 2 u_b − a·b − 2 u_a) I + a⊗b + b⊗a − 2 a⊗a; xw block (b − a)/2; ww zero.
[[gnu::always_inline]] inline Jet height_jet(Vec2 a, Vec2 b, double la, double ab, double ua, double ub, double g,
                                             Vec2 ds, double inverse_s) {
  Jet jet;
  const double nx = -b.x * la - 2 * ub * a.x + a.x * ab + ua * (a.x + b.x);
  const double ny = -b.y * la - 2 * ub * a.y + a.y * ab + ua * (a.y + b.y);
  const double nw = 0.5 * (la - ab);
  const double gx = (nx - g * ds.x) * inverse_s, gy = (ny - g * ds.y) * inverse_s, gw = nw * inverse_s;
  const double diagonal = la + 2 * ub - ab - 2 * ua;
  jet.gradient = {gx, gy, gw};
  jet.hessian = {(diagonal + 2 * a.x * b.x - 2 * a.x * a.x - 2 * gx * ds.x) * inverse_s,
                 (a.x * b.y + a.y * b.x - 2 * a.x * a.y - gx * ds.y - gy * ds.x) * inverse_s,
                 (0.5 * (b.x - a.x) - gw * ds.x) * inverse_s,
                 (diagonal + 2 * a.y * b.y - 2 * a.y * a.y - 2 * gy * ds.y) * inverse_s,
                 (0.5 * (b.y - a.y) - gw * ds.y) * inverse_s,
                 0};
  return jet;
}

}  // namespace detail

[[gnu::always_inline]] inline TriangleJet triangle_jet(const WeightedPoint& p, const WeightedPoint& q,
                                                       const WeightedPoint& r) {
  TriangleJet jet;
  jet.shape = triangle_shape(p, q, r);
  jet.a = q.position() - p.position();
  jet.b = r.position() - p.position();
  const auto& [pq, qr, rp] = jet.shape.edges;
  const double ab = dot(jet.a, jet.b);
  const double ua = 0.5 * (pq.l2 + pq.dw), ub = 0.5 * (rp.l2 + rp.dw);
  const Vec2 ds{jet.a.y - jet.b.y, jet.b.x - jet.a.x};  // gradient of S, which is linear in p
  const double inverse_s = 1.0 / jet.shape.doubled_area;
  jet.g[0] = detail::height_jet(jet.a, jet.b, pq.l2, ab, ua, ub, pq.g, ds, inverse_s);
  jet.g[2] = detail::height_jet(jet.b, jet.a, rp.l2, ab, ub, ua, rp.g, ds, inverse_s);
  for (std::size_t i = 0; i < 3; ++i) jet.g[1].gradient[i] = -jet.g[0].gradient[i] - jet.g[2].gradient[i];
  for (std::size_t i = 0; i < 6; ++i) jet.g[1].hessian[i] = -jet.g[0].hessian[i] - jet.g[2].hessian[i];
  jet.g[1].gradient[0] += ds.x;
  jet.g[1].gradient[1] += ds.y;
  return jet;
}

}  // namespace temper
