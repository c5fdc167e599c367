// The fast paths of the exact predicates, for inlining into the loops that call them millions of times.
//
// Each computes its determinant in doubles together with the permanent, the same sum with every term taken
// absolute. Rounding moves the determinant by at most a few u = 2⁻⁵³ times the permanent; beyond that bound its
// sign is right, and what is not decided goes to the exact stage in predicates.cpp. The bounds count roundings
// along the longest path from a coordinate to the result: n roundings give an error below n u (1 + 2nu) times
// the exact permanent, and the computed permanent is too small by no more than another n u. Each constant is a
// power of two above its n; multiplying by it is exact.
//
// Comparisons are strict: a permanent of zero (coincident or aligned points) decides nothing, nor does an infinite
// one or a NaN. Nothing overflows or underflows in the range of is_exact_coordinate (geometry.hpp): differences are
// multiples of 2^-266, so nonzero determinants are multiples of 2^-1064. Only the bound can underflow, where the
// permanent is below 2^-1011; there 53 bits hold every such multiple, so that nothing was rounded at all.
#pragma once

#include <cmath>

#include "base/pack.hpp"
#include "temper/geometry.hpp"

namespace temper::exact {

// Stages without filter: right for every input in range, and up to two hundred times slower (1 µs).
[[nodiscard]] Sign orient2d(Vec2 a, Vec2 b, Vec2 c);
[[nodiscard]] Sign power_test(const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c,
                              const WeightedPoint& d);
[[nodiscard]] Sign height_numerator_sign(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r);
[[nodiscard]] Sign edge_split_sign(const WeightedPoint& p, const WeightedPoint& q);

}  // namespace temper::exact

namespace temper::inlined {

// The functions below have the names and arguments of the public ones: call them qualified.

inline constexpr double kUnitRoundoff = 0x1p-53;
// Roundings: 3 up to the products; the last subtraction is rounded without change of sign.
inline constexpr double kOrient2dBound = 4 * kUnitRoundoff;
// 5: the difference (twice, in the square), the square, two sums.
inline constexpr double kEdgeSplitBound = 8 * kUnitRoundoff;
// 12: lift 5, minor 4, their product, two sums.
inline constexpr double kPowerTestBound = 16 * kUnitRoundoff;
// 11: dot product 4, dot product and weights 5, their product, one sum.
inline constexpr double kHeightBound = 16 * kUnitRoundoff;

/// A value whose sign is a predicate, with a bound of its rounding: the sign is right where the value is beyond the
/// bound. The functions that return it take points of doubles or of packs (base/pack.hpp).
template <class T>
struct Filtered {
  T value, bound;
};

template <class Point>
TEMPER_INLINE auto filtered_orient2d(const Point& a, const Point& b, const Point& c) {
  using T = decltype(a.x - c.x);
  const T left = (a.x - c.x) * (b.y - c.y);
  const T right = (a.y - c.y) * (b.x - c.x);
  return Filtered<T>{left - right, kOrient2dBound * (absolute(left) + absolute(right))};
}

[[nodiscard]] inline Sign orient2d(Vec2 a, Vec2 b, Vec2 c) {
  const auto [determinant, bound] = filtered_orient2d(a, b, c);
  if (determinant > bound) return Sign::positive;
  if (determinant < -bound) return Sign::negative;
  return exact::orient2d(a, b, c);
}

template <class Point>
TEMPER_INLINE auto filtered_power_test(const Point& a, const Point& b, const Point& c, const Point& d) {
  using T = decltype(a.x - d.x);
  const T ax = a.x - d.x, ay = a.y - d.y, aw = a.w - d.w;
  const T bx = b.x - d.x, by = b.y - d.y, bw = b.w - d.w;
  const T cx = c.x - d.x, cy = c.y - d.y, cw = c.w - d.w;
  const T bxcy = bx * cy, bycx = by * cx;
  const T cxay = cx * ay, cyax = cy * ax;
  const T axby = ax * by, aybx = ay * bx;
  const T aa = ax * ax + ay * ay, bb = bx * bx + by * by, cc = cx * cx + cy * cy;
  const T determinant = (aa - aw) * (bxcy - bycx) + (bb - bw) * (cxay - cyax) + (cc - cw) * (axby - aybx);
  const T permanent = (aa + absolute(aw)) * (absolute(bxcy) + absolute(bycx)) +
                      (bb + absolute(bw)) * (absolute(cxay) + absolute(cyax)) +
                      (cc + absolute(cw)) * (absolute(axby) + absolute(aybx));
  return Filtered<T>{determinant, kPowerTestBound * permanent};
}

[[nodiscard]] inline Sign power_test(const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c,
                                     const WeightedPoint& d) {
  const auto [determinant, bound] = filtered_power_test(a, b, c, d);
  if (determinant > bound) return Sign::positive;
  if (determinant < -bound) return Sign::negative;
  return exact::power_test(a, b, c, d);
}

/// Sign of 2 h ℓ S over edge pq, S twice the signed area. With the dot products D_p = (q − p)·(r − p) and so on,
/// |q − p|² = D_p + D_q and 2 h ℓ S = D_p (D_r + w_q − w_r) + D_q (D_r + w_p − w_r).
template <class Point>
TEMPER_INLINE auto filtered_height_numerator(const Point& p, const Point& q, const Point& r) {
  using T = decltype(q.x - p.x);
  const T pqx = q.x - p.x, pqy = q.y - p.y;
  const T prx = r.x - p.x, pry = r.y - p.y;
  const T qrx = r.x - q.x, qry = r.y - q.y;
  const T wqr = q.w - r.w, wpr = p.w - r.w;
  const T px = pqx * prx, py = pqy * pry;
  const T qx = -pqx * qrx, qy = -pqy * qry;
  const T rx = prx * qrx, ry = pry * qry;
  const T numerator = (px + py) * (rx + ry + wqr) + (qx + qy) * (rx + ry + wpr);
  const T at_r = absolute(rx) + absolute(ry);
  const T permanent =
      (absolute(px) + absolute(py)) * (at_r + absolute(wqr)) + (absolute(qx) + absolute(qy)) * (at_r + absolute(wpr));
  return Filtered<T>{numerator, kHeightBound * permanent};
}

[[nodiscard]] inline Sign height_numerator_sign(const WeightedPoint& p, const WeightedPoint& q,
                                                const WeightedPoint& r) {
  const auto [numerator, bound] = filtered_height_numerator(p, q, r);
  if (numerator > bound) return Sign::positive;
  if (numerator < -bound) return Sign::negative;
  return exact::height_numerator_sign(p, q, r);
}

/// Sign of 2 d ℓ of edge pq, from p.
template <class Point>
TEMPER_INLINE auto filtered_edge_split(const Point& p, const Point& q) {
  using T = decltype(q.x - p.x);
  const T x = q.x - p.x, y = q.y - p.y, w = p.w - q.w;
  const T squared = x * x + y * y;
  return Filtered<T>{squared + w, kEdgeSplitBound * (squared + absolute(w))};
}

[[nodiscard]] inline Sign edge_split_sign(const WeightedPoint& p, const WeightedPoint& q) {
  const auto [sum, bound] = filtered_edge_split(p, q);
  if (sum > bound) return Sign::positive;
  if (sum < -bound) return Sign::negative;
  return exact::edge_split_sign(p, q);
}

/// 0 < d_pq < ℓ.
[[nodiscard]] inline bool crosses_edge(const WeightedPoint& p, const WeightedPoint& q) {
  return inlined::edge_split_sign(p, q) == Sign::positive && inlined::edge_split_sign(q, p) == Sign::positive;
}

[[nodiscard]] inline bool is_well_centered(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  return inlined::orient2d(p.position(), q.position(), r.position()) == Sign::positive &&
         inlined::height_numerator_sign(p, q, r) == Sign::positive &&
         inlined::height_numerator_sign(q, r, p) == Sign::positive &&
         inlined::height_numerator_sign(r, p, q) == Sign::positive && inlined::crosses_edge(p, q) &&
         inlined::crosses_edge(q, r) && inlined::crosses_edge(r, p);
}

}  // namespace temper::inlined
