// The fast paths of the exact predicates, for inlining into the loops that call them millions of times.
//
// Each computes its determinant in doubles together with the permanent, the same sum of the terms' absolute values.
// Rounding moves the determinant by at most a few u = 2⁻⁵³ times the permanent. Beyond that bound its sign is right;
// otherwise the exact stage in predicates.cpp decides. The bounds count roundings along the longest path from a
// coordinate to the result. For n roundings the error is below n u (1 + 2nu) times the exact permanent, and the
// computed permanent is too small by at most another n u. Each constant is a power of two above its n; multiplying by
// it is exact.
//
// Comparisons are strict: a permanent of zero (coincident or aligned points) decides nothing, nor does an infinite one
// or a NaN. Nothing overflows or underflows in the range of is_exact_coordinate (geometry.hpp). Differences are
// multiples of 2^-266, so nonzero determinants are multiples of 2^-1064. The bound alone can underflow, if the
// permanent is below 2^-1011. Then 53 bits hold every such multiple, so that nothing was rounded at all.
#pragma once

#include <cmath>

#include "base/pack.hpp"
#include "temper/detail/geometry.hpp"

namespace temper::exact {

// Stages without filter: right for every input in range, and up to two hundred times slower (1 µs).
[[nodiscard]] Sign orient2d(Vec2 a, Vec2 b, Vec2 c);
[[nodiscard]] Sign power_test(const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c,
                              const WeightedPoint& d);
[[nodiscard]] Sign height_numerator_sign(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r);
[[nodiscard]] Sign dual_crossing_sign(const WeightedPoint& p, const WeightedPoint& q);

[[nodiscard]] Sign orientation(Vec3 p, Vec3 q, Vec3 r);
[[nodiscard]] Sign power_test(Vec3 a, Vec3 b, Vec3 c, Vec3 d);
[[nodiscard]] Sign height_numerator_sign(Vec3 p, Vec3 q, Vec3 r);
[[nodiscard]] Sign dual_crossing_sign(Vec3 p, Vec3 q);

}  // namespace temper::exact

namespace temper::inlined {

// The functions below have the names and arguments of the public ones: call them qualified.

inline constexpr double kUnitRoundoff = 0x1p-53;
// Roundings: 3 up to the products; the last subtraction is rounded without change of sign.
inline constexpr double kOrient2dBound = 4 * kUnitRoundoff;
// 5: the difference (twice, in the square), the square, two sums.
inline constexpr double kDualCrossingBound = 8 * kUnitRoundoff;
// 12: lift 5, minor 4, their product, two sums.
inline constexpr double kPowerTestBound = 16 * kUnitRoundoff;
// 11: dot product 4, dot product and weights 5, their product, one sum.
inline constexpr double kHeightBound = 16 * kUnitRoundoff;
// On the sphere. 7: minor 4, its product with a coordinate, two sums.
inline constexpr double kOrientationBound = 8 * kUnitRoundoff;
// 8: minor 4, its product with a difference 2, two sums.
inline constexpr double kSpherePowerTestBound = 16 * kUnitRoundoff;
// 4: difference, product, two sums.
inline constexpr double kSphereDualCrossingBound = 8 * kUnitRoundoff;
// 11: dot product 4, dot product of differences 5, their product, one sum.
inline constexpr double kSphereHeightBound = 16 * kUnitRoundoff;

/// A value whose sign is a predicate, with a bound of its rounding: beyond the bound the sign is right. The functions
/// that return it take points of doubles or of packs (base/pack.hpp).
template <class T>
struct Filtered {
  T value, bound;
};

/// A vertex in coordinates of the plane, x, y, w, or of the sphere, x, y, z of the weighted vector.
template <class Point>
concept Planar = requires(const Point& p) {
  p.w;
};
template <class Point>
concept OnSphere = requires(const Point& p) {
  p.z;
};

/// The sign of a filtered value, or the result of `exactly` if the filter does not decide.
template <class Exactly>
[[nodiscard]] inline Sign sign_or(const Filtered<double>& x, Exactly&& exactly) {
  if (x.value > x.bound) return Sign::positive;
  if (x.value < -x.bound) return Sign::negative;
  return exactly();
}

template <class Point>
TEMPER_INLINE auto filtered_orient2d(const Point& a, const Point& b, const Point& c) {
  using T = decltype(a.x - c.x);
  const T left = (a.x - c.x) * (b.y - c.y);
  const T right = (a.y - c.y) * (b.x - c.x);
  return Filtered<T>{left - right, kOrient2dBound * (absolute(left) + absolute(right))};
}

template <Planar Point>
TEMPER_INLINE auto filtered_orientation(const Point& a, const Point& b, const Point& c) {
  return filtered_orient2d(a, b, c);
}

[[nodiscard]] inline Sign orient2d(Vec2 a, Vec2 b, Vec2 c) {
  return sign_or(filtered_orient2d(a, b, c), [&] { return exact::orient2d(a, b, c); });
}

template <Planar Point>
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
  return sign_or(filtered_power_test(a, b, c, d), [&] { return exact::power_test(a, b, c, d); });
}

/// Sign of 2 h ℓ S over edge pq, where S is twice the signed area. Let D_p = (q − p)·(r − p) be the dot product at p,
/// and so on. Then |q − p|² = D_p + D_q and 2 h ℓ S = D_p (D_r + w_q − w_r) + D_q (D_r + w_p − w_r).
template <Planar Point>
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
  return sign_or(filtered_height_numerator(p, q, r), [&] { return exact::height_numerator_sign(p, q, r); });
}

/// Sign of 2 d ℓ of edge pq, from p.
template <Planar Point>
TEMPER_INLINE auto filtered_dual_crossing(const Point& p, const Point& q) {
  using T = decltype(q.x - p.x);
  const T x = q.x - p.x, y = q.y - p.y, w = p.w - q.w;
  const T squared = x * x + y * y;
  return Filtered<T>{squared + w, kDualCrossingBound * (squared + absolute(w))};
}

[[nodiscard]] inline Sign dual_crossing_sign(const WeightedPoint& p, const WeightedPoint& q) {
  return sign_or(filtered_dual_crossing(p, q), [&] { return exact::dual_crossing_sign(p, q); });
}

/// 0 < d_pq < ℓ.
[[nodiscard]] inline bool crosses_edge(const WeightedPoint& p, const WeightedPoint& q) {
  return inlined::dual_crossing_sign(p, q) == Sign::positive && inlined::dual_crossing_sign(q, p) == Sign::positive;
}

[[nodiscard]] inline bool is_well_centered(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  return inlined::orient2d(p.position(), q.position(), r.position()) == Sign::positive &&
         inlined::height_numerator_sign(p, q, r) == Sign::positive &&
         inlined::height_numerator_sign(q, r, p) == Sign::positive &&
         inlined::height_numerator_sign(r, p, q) == Sign::positive && inlined::crosses_edge(p, q) &&
         inlined::crosses_edge(q, r) && inlined::crosses_edge(r, p);
}

// --- on the sphere: all from differences of neighbors, of which few digits cancel -------------------------------

/// det(P, Q, R) = P·((Q − P) × (R − P)).
template <OnSphere Point>
TEMPER_INLINE auto filtered_orientation(const Point& p, const Point& q, const Point& r) {
  using T = decltype(q.x - p.x);
  const T ax = q.x - p.x, ay = q.y - p.y, az = q.z - p.z;
  const T bx = r.x - p.x, by = r.y - p.y, bz = r.z - p.z;
  const T aybz = ay * bz, azby = az * by, azbx = az * bx, axbz = ax * bz, axby = ax * by, aybx = ay * bx;
  const T determinant = p.x * (aybz - azby) + p.y * (azbx - axbz) + p.z * (axby - aybx);
  const T permanent = absolute(p.x) * (absolute(aybz) + absolute(azby)) +
                      absolute(p.y) * (absolute(azbx) + absolute(axbz)) +
                      absolute(p.z) * (absolute(axby) + absolute(aybx));
  return Filtered<T>{determinant, kOrientationBound * permanent};
}

/// − det(A − D, B − D, C − D).
template <OnSphere Point>
TEMPER_INLINE auto filtered_power_test(const Point& a, const Point& b, const Point& c, const Point& d) {
  using T = decltype(a.x - d.x);
  const T ax = a.x - d.x, ay = a.y - d.y, az = a.z - d.z;
  const T bx = b.x - d.x, by = b.y - d.y, bz = b.z - d.z;
  const T cx = c.x - d.x, cy = c.y - d.y, cz = c.z - d.z;
  const T bxcy = bx * cy, bycx = by * cx;
  const T cxay = cx * ay, cyax = cy * ax;
  const T axby = ax * by, aybx = ay * bx;
  const T determinant = az * (bxcy - bycx) + bz * (cxay - cyax) + cz * (axby - aybx);
  const T permanent = absolute(az) * (absolute(bxcy) + absolute(bycx)) +
                      absolute(bz) * (absolute(cxay) + absolute(cyax)) +
                      absolute(cz) * (absolute(axby) + absolute(aybx));
  return Filtered<T>{-determinant, kSpherePowerTestBound * permanent};
}

/// (P × Q)·n = (P·a) (a·b) − (P·b) |a|², with a = Q − P, b = R − P and n = a × b.
template <OnSphere Point>
TEMPER_INLINE auto filtered_height_numerator(const Point& p, const Point& q, const Point& r) {
  using T = decltype(q.x - p.x);
  const T ax = q.x - p.x, ay = q.y - p.y, az = q.z - p.z;
  const T bx = r.x - p.x, by = r.y - p.y, bz = r.z - p.z;
  const T pax = p.x * ax, pay = p.y * ay, paz = p.z * az;
  const T pbx = p.x * bx, pby = p.y * by, pbz = p.z * bz;
  const T abx = ax * bx, aby = ay * by, abz = az * bz;
  const T aa = ax * ax + ay * ay + az * az;
  const T numerator = (pax + pay + paz) * (abx + aby + abz) - (pbx + pby + pbz) * aa;
  const T permanent =
      (absolute(pax) + absolute(pay) + absolute(paz)) * (absolute(abx) + absolute(aby) + absolute(abz)) +
      (absolute(pbx) + absolute(pby) + absolute(pbz)) * aa;
  return Filtered<T>{numerator, kSphereHeightBound * permanent};
}

/// P·(P − Q).
template <OnSphere Point>
TEMPER_INLINE auto filtered_dual_crossing(const Point& p, const Point& q) {
  using T = decltype(q.x - p.x);
  const T x = p.x * (p.x - q.x), y = p.y * (p.y - q.y), z = p.z * (p.z - q.z);
  return Filtered<T>{x + y + z, kSphereDualCrossingBound * (absolute(x) + absolute(y) + absolute(z))};
}

// --- in the space of a mesh: what the plane does is inlined, the sphere is a call -------------------------------

[[nodiscard]] inline Sign orientation(const Space& space, const WeightedPoint& p, const WeightedPoint& q,
                                      const WeightedPoint& r) {
  if (space.is_plane()) [[likely]]
    return inlined::orient2d(p.position(), q.position(), r.position());
  return temper::orientation(as_vector(p), as_vector(q), as_vector(r));
}

[[nodiscard]] inline Sign power_test(const Space& space, const WeightedPoint& a, const WeightedPoint& b,
                                     const WeightedPoint& c, const WeightedPoint& d) {
  if (space.is_plane()) [[likely]]
    return inlined::power_test(a, b, c, d);
  return temper::power_test(as_vector(a), as_vector(b), as_vector(c), as_vector(d));
}

[[nodiscard]] inline bool crosses_edge(const Space& space, const WeightedPoint& p, const WeightedPoint& q) {
  if (space.is_plane()) [[likely]]
    return inlined::crosses_edge(p, q);
  return temper::dual_crossing_sign(as_vector(p), as_vector(q)) == Sign::positive &&
         temper::dual_crossing_sign(as_vector(q), as_vector(p)) == Sign::positive;
}

[[nodiscard]] inline bool is_well_centered(const Space& space, const WeightedPoint& p, const WeightedPoint& q,
                                           const WeightedPoint& r) {
  if (space.is_plane()) [[likely]]
    return inlined::is_well_centered(p, q, r);
  return temper::is_well_centered(as_vector(p), as_vector(q), as_vector(r));
}

}  // namespace temper::inlined
