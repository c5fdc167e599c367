// The polynomials of the predicates and constructions, each written once for all kinds of numbers.
//
// T is a number with +, −, * and difference(a, b) of two doubles: Estimate (a double with the bound of its rounding),
// exact::Compact (the exact number), or Plain (a double). All polynomials are made of differences of the inputs, so
// they do not depend on the origin.
#pragma once

#include "base/pack.hpp"
#include "temper/tets/geometry.hpp"

namespace temper::tets {

/// A double.
struct Plain {
  double value = 0;
  static Plain difference(double a, double b) { return {a - b}; }
  friend Plain operator+(Plain a, Plain b) { return {a.value + b.value}; }
  friend Plain operator-(Plain a, Plain b) { return {a.value - b.value}; }
  friend Plain operator*(Plain a, Plain b) { return {a.value * b.value}; }
};

/// A double, or a pack of them, and its permanent, the same polynomial of absolute values. Rounding moves the value by
/// at most n u times the permanent, where n counts the roundings along the longest path from an input to the result
/// (see geometry/predicates_inline.hpp).
template <class V>
struct EstimateOf {
  V value, permanent;
  TEMPER_INLINE static EstimateOf difference(const V& a, const V& b) { return {a - b, absolute(a - b)}; }
  friend TEMPER_INLINE EstimateOf operator+(const EstimateOf& a, const EstimateOf& b) {
    return {a.value + b.value, a.permanent + b.permanent};
  }
  friend TEMPER_INLINE EstimateOf operator-(const EstimateOf& a, const EstimateOf& b) {
    return {a.value - b.value, a.permanent + b.permanent};
  }
  friend TEMPER_INLINE EstimateOf operator*(const EstimateOf& a, const EstimateOf& b) {
    return {a.value * b.value, a.permanent * b.permanent};
  }
};
using Estimate = EstimateOf<double>;

// Bounds of the rounding, relative to the permanent: powers of two above the numbers of roundings below.
inline constexpr double kPowerBound = 0x1p-48, kHeightBound = 0x1p-48;
inline constexpr double kFaceHeightBound = 0x1p-49, kCrossingBound = 0x1p-50;

template <class T>
struct Vector {
  T x, y, z;
  friend TEMPER_INLINE Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend TEMPER_INLINE Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend TEMPER_INLINE Vector operator*(const T& s, const Vector& a) { return {s * a.x, s * a.y, s * a.z}; }
};
template <class T, class Point>
TEMPER_INLINE Vector<T> from_to(const Point& a, const Point& b) {
  return {T::difference(b.x, a.x), T::difference(b.y, a.y), T::difference(b.z, a.z)};
}
template <class T>
TEMPER_INLINE T dot(const Vector<T>& a, const Vector<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
TEMPER_INLINE Vector<T> cross(const Vector<T>& a, const Vector<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// The cosine of the least dihedral angle of a tetrahedron.
template <class T>
TEMPER_INLINE T largest_dihedral_cosine(const Vector<T>& p, const Vector<T>& q, const Vector<T>& r,
                                        const Vector<T>& s) {
  const auto unit_normal = [](const Vector<T>& a, const Vector<T>& b, const Vector<T>& c) {
    const Vector<T> n = cross(b - a, c - a);
    return 1 / square_root(dot(n, n)) * n;
  };
  const Vector<T> normals[4] = {unit_normal(q, s, r), unit_normal(p, r, s), unit_normal(p, s, q), unit_normal(p, q, r)};
  T most = all<T>(-1);
  for (std::size_t f = 1; f < 4; ++f) {
    for (std::size_t g = 0; g < f; ++g) {
      const T cosine = -dot(normals[f], normals[g]);
      most = select(cosine > most, cosine, most);
    }
  }
  return most;
}

/// |v|² − w + w₀: the lift of v seen from an origin of weight w₀.
template <class T, class W>
TEMPER_INLINE T lift(const Vector<T>& v, const W& w, const W& w_origin) {
  return dot(v, v) - T::difference(w, w_origin);
}

/// 6 V of tetrahedron pqrs. Roundings: 8 (cross product 4, product 2, sums 2).
template <class T>
T volume_polynomial(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r, const WeightedPoint& s) {
  return dot(cross(from_to<T>(p, q), from_to<T>(p, r)), from_to<T>(p, s));
}

/// 4 A² of the face pqr. Roundings: 11 (cross products 8, product 1, sums 2).
template <class T>
T area_polynomial(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  const Vector<T> normal = cross(from_to<T>(p, q), from_to<T>(p, r));
  return dot(normal, normal);
}

/// 6 V Σ λ_i (|x_i − t|² − w_i + w_t), where λ are the barycentric coordinates of t in pqrs. Roundings: 18 (lift 6,
/// determinant of three 8, product 1, sums 3).
template <class T>
T power_polynomial(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r, const WeightedPoint& s,
                   const WeightedPoint& t) {
  const Vector<T> a = from_to<T>(t, p), b = from_to<T>(t, q), c = from_to<T>(t, r), d = from_to<T>(t, s);
  const Vector<T> cd = cross(c, d), ab = cross(a, b);
  return (lift(a, p.w, t.w) * dot(b, cd) - lift(b, q.w, t.w) * dot(a, cd)) +
         (lift(c, r.w, t.w) * dot(d, ab) - lift(d, s.w, t.w) * dot(c, ab));
}

/// 2 · 6 V (o − p) of tetrahedron pqrs. Roundings: 13 (lift 6, cross product 4, product 1, sums 2).
template <class T, class Point>
TEMPER_INLINE Vector<T> orthocenter_polynomial(const Point& p, const Point& q, const Point& r, const Point& s) {
  const Vector<T> u = from_to<T>(p, q), v = from_to<T>(p, r), t = from_to<T>(p, s);
  const T at_q = lift(u, q.w, p.w), at_r = lift(v, r.w, p.w), at_s = lift(t, s.w, p.w);
  const Vector<T> vt = cross(v, t), tu = cross(t, u), uv = cross(u, v);
  return {at_q * vt.x + at_r * tu.x + at_s * uv.x, at_q * vt.y + at_r * tu.y + at_s * uv.y,
          at_q * vt.z + at_r * tu.z + at_s * uv.z};
}

/// 2 h_s · 2 A |6 V|, where A is the area of the face pqr. Roundings: 20 (orthocenter 13, cross product 4, product 1,
/// sums 2).
template <class T, class Point>
TEMPER_INLINE T height_polynomial(const Point& p, const Point& q, const Point& r, const Point& s) {
  return dot(cross(from_to<T>(p, q), from_to<T>(p, r)), orthocenter_polynomial<T>(p, q, r, s));
}

/// 2 h_r ℓ · 2 A over edge pq of the face pqr. Let D_p = (q − p)·(r − p) be the dot product at p, and so on. Then this
/// is D_p (D_r + w_q − w_r) + D_q (D_r + w_p − w_r), as in the plane. Roundings: 13 (dot product 5, dot product and
/// weights 6, product 1, sum 1).
template <class T>
T height_polynomial(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  const Vector<T> pq = from_to<T>(p, q), pr = from_to<T>(p, r), qr = from_to<T>(q, r);
  const T at_r = dot(pr, qr);
  return dot(pq, pr) * (at_r + T::difference(q.w, r.w)) - dot(pq, qr) * (at_r + T::difference(p.w, r.w));
}

/// 2 d_pq ℓ. Roundings: 6.
template <class T>
T crossing_polynomial(const WeightedPoint& p, const WeightedPoint& q) {
  return lift(from_to<T>(p, q), q.w, p.w);
}

}  // namespace temper::tets
