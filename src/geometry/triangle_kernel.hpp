// The triangle pqr as a function of (x, y, w) of its corner p: what energies and their derivatives need, for one
// triangle (T = double) or for eight at once (T = Pack).
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

/// Squared length, weight difference and scaled height of an edge: all that an edge energy depends on.
template <class T>
struct EdgeShapeOf {
  T l2 = {};  ///< ℓ²
  T dw = {};  ///< w_i − w_j; the energies are even in it
  T g = {};   ///< h ℓ
};
using EdgeShape = EdgeShapeOf<double>;

template <class T>
struct TriangleShapeOf {
  EdgeShapeOf<T> pq, qr, rp;
  T doubled_area = {};  ///< S, signed
};

/// The edges pq, qr, rp.
struct TriangleShape {
  std::array<EdgeShape, 3> edges;
  double doubled_area = 0;  ///< S, signed
};

/// What the shape is made of, besides.
template <class T>
struct TriangleVectors {
  T ax, ay, bx, by;     ///< q − p, r − p
  T la, lb, ab;         ///< |a|², |b|², a·b
  T ua, ub, inverse_s;  ///< u_a, u_b, 1/S
};

/// Point: three T's called x, y, w.
template <class Point>
[[gnu::always_inline]] inline auto triangle_shape(const Point& p, const Point& q, const Point& r,
                                                  TriangleVectors<decltype(p.x + p.x)>& v) {
  using T = decltype(p.x + p.x);
  v.ax = q.x - p.x, v.ay = q.y - p.y, v.bx = r.x - p.x, v.by = r.y - p.y;
  const T s = v.ax * v.by - v.ay * v.bx;
  v.la = v.ax * v.ax + v.ay * v.ay, v.lb = v.bx * v.bx + v.by * v.by, v.ab = v.ax * v.bx + v.ay * v.by;
  const T cx = r.x - q.x, cy = r.y - q.y;
  const T wa = p.w - q.w, wb = p.w - r.w;
  v.ua = 0.5 * (v.la + wa), v.ub = 0.5 * (v.lb + wb);
  v.inverse_s = 1.0 / s;
  const T ga = (v.ub * v.la - v.ua * v.ab) * v.inverse_s;
  const T gb = (v.ua * v.lb - v.ub * v.ab) * v.inverse_s;
  return TriangleShapeOf<T>{{v.la, wa, ga}, {cx * cx + cy * cy, q.w - r.w, s - ga - gb}, {v.lb, wb, gb}, s};
}

[[gnu::always_inline]] inline TriangleShape triangle_shape(const WeightedPoint& p, const WeightedPoint& q,
                                                           const WeightedPoint& r) {
  TriangleVectors<double> unused;
  const TriangleShapeOf<double> s = triangle_shape(p, q, r, unused);
  return {{s.pq, s.qr, s.rp}, s.doubled_area};
}

}  // namespace temper
