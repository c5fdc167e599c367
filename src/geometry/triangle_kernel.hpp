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
  T inverse_area = {};  ///< 1/S
};

/// The edges pq, qr, rp.
struct TriangleShape {
  std::array<EdgeShape, 3> edges;
  double doubled_area = 0;  ///< S, signed
};

template <class T>
struct PointOf {
  T x, y, w;
};

/// From p to another corner.
template <class T>
struct Spoke {
  T x, y;  ///< a
  T l2;    ///< |a|²
  T dw;    ///< w_p − w_q
  T u;     ///< u_a
};

/// Point: PointOf<T>, or what else has x, y, w.
template <class Point>
[[gnu::always_inline]] inline auto spoke(const Point& p, const Point& q) {
  using T = decltype(p.x + p.x);
  const T x = q.x - p.x, y = q.y - p.y, l2 = x * x + y * y, dw = p.w - q.w;
  return Spoke<T>{x, y, l2, dw, 0.5 * (l2 + dw)};
}

/// The triangle between two spokes, to q and to r.
template <class Point, class T>
[[gnu::always_inline]] inline TriangleShapeOf<T> triangle_shape(const Spoke<T>& a, const Spoke<T>& b, const Point& q,
                                                                const Point& r) {
  const T s = a.x * b.y - a.y * b.x, ab = a.x * b.x + a.y * b.y, inverse = 1.0 / s;
  const T cx = r.x - q.x, cy = r.y - q.y;
  const T ga = (b.u * a.l2 - a.u * ab) * inverse;
  const T gb = (a.u * b.l2 - b.u * ab) * inverse;
  return {{a.l2, a.dw, ga}, {cx * cx + cy * cy, q.w - r.w, s - ga - gb}, {b.l2, b.dw, gb}, s, inverse};
}

[[gnu::always_inline]] inline TriangleShape triangle_shape(const WeightedPoint& p, const WeightedPoint& q,
                                                           const WeightedPoint& r) {
  const TriangleShapeOf<double> s = triangle_shape(spoke(p, q), spoke(p, r), q, r);
  return {{s.pq, s.qr, s.rp}, s.doubled_area};
}

}  // namespace temper
