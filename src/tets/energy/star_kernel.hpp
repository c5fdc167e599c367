// The energy of one tetrahedron pqrs as a function of its corner p = (x, y, z, w), with derivatives.
//
//   E = κ_h Σ 1/φ_γ(h/ℓ) + κ_s (Σ length²)^(3/2) / volume        φ_γ(y) = (y + √(y² + γ²))/2
//
// The first sum is over the four faces: h is the height of the orthocenter over the face, and ℓ the side of the
// equilateral triangle of the same area. The second sum is over the six edges. E does not change with the scale. It is
// +∞ unless the tetrahedron is positive.
//
//          p           q is the origin. n = (r − q) × (s − q) points towards p, and c is the orthocenter of qrs in its
//        / | \         plane. With u = p − q and D = n·u, six times the volume, the orthocenter of pqrs is
//       /  |  \ .
//      q---|---s         c + t n      t = (|u|² − w_p + w_q − 2 c·u) / (2 D)
//       \  |  /
//        \ | /         Over the face of p and edge e = x_j − x_i of qrs, with v = p − x_i and m = v × e, |m| is twice
//          r           the area. Then h |m| = m·(c − x_i) + t m·n, and both products are linear in v.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "base/pack.hpp"
#include "temper/tets/geometry.hpp"
#include "tets/energy/matrix.hpp"

namespace temper::tets {

/// Weights of the two parts. At the regular tetrahedron they are about 4 and 2.5.
inline constexpr double kHeightFactor = 0.2, kShapeFactor = 0.02;
/// ℓ = kLengthOfArea √|m|, where |m| is twice the area.
inline constexpr double kLengthOfArea = 1.074569931823542;  // √(2/√3)

/// The face qrs opposite p, and all that does not depend on p. Seen from p the face is counter-clockwise.
template <class T>
struct LinkFace {
  struct Edge {
    Vector<T> from, along;  ///< x_i − q, e
    Vector<T> plane, turn;  ///< e × (c − x_i) and e × n, the gradients of m·(c − x_i) and m·n
    T length2;              ///< |e|²
  };
  Vector<T> origin;  ///< q
  T weight;          ///< w_q
  Vector<T> normal, center;
  T factor;   ///< √|n| over kLengthOfArea: h/ℓ of the face is t times this
  T length2;  ///< sum of the squared lengths of the three edges
  std::array<Edge, 3> edges;
};

template <class T>
struct PointDerivatives {
  T value;
  PointVector<T> gradient;
  PointMatrix<T> hessian;

  TEMPER_INLINE PointDerivatives& operator+=(const PointDerivatives& b) {
    value = value + b.value;
    gradient = gradient + b.gradient;
    hessian += b.hessian;
    return *this;
  }
  friend PointDerivatives operator*(const T& s, const PointDerivatives& d) {
    return {s * d.value, s * d.gradient, s * d.hessian};
  }
};

template <class T>
TEMPER_INLINE LinkFace<T> link_face_of(const PointVector<T>& q, const PointVector<T>& r, const PointVector<T>& s) {
  const Vector<T> a = r.at - q.at, b = s.at - q.at;
  LinkFace<T> face;
  face.origin = q.at;
  face.weight = q.w;
  face.normal = cross(a, b);
  const T n2 = dot(face.normal, face.normal), half = 0.5 / n2;
  const T at_r = dot(a, a) - (r.w - q.w), at_s = dot(b, b) - (s.w - q.w);
  face.center = half * (at_r * cross(b, face.normal) + at_s * cross(face.normal, a));
  face.factor = 1 / kLengthOfArea * square_root(square_root(n2));
  const std::array<Vector<T>, 3> from = {Vector<T>{all<T>(0), all<T>(0), all<T>(0)}, a, b};
  const std::array<Vector<T>, 3> along = {a, s.at - r.at, q.at - s.at};
  face.length2 = all<T>(0);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector<T>& e = along[i];
    face.edges[i] = {from[i], e, cross(e, face.center - from[i]), cross(e, face.normal), dot(e, e)};
    face.length2 = face.length2 + face.edges[i].length2;
  }
  return face;
}
template <class T>
LinkFace<T> link_face(const WeightedPoint& q, const WeightedPoint& r, const WeightedPoint& s) {
  const auto in = [](const WeightedPoint& p) { return PointVector<T>{{T(p.x), T(p.y), T(p.z)}, T(p.w)}; };
  return link_face_of(in(q), in(r), in(s));
}

/// 1/φ_γ(y) and its derivatives: with R = √(y² + γ²) they are −1/(φ R) and 2/R³.
template <class T>
struct SoftBarrier {
  T value, slope, curvature;
};
template <class T>
TEMPER_INLINE SoftBarrier<T> soft_barrier(const T& y, const T& gamma) {
  const T root = square_root(y * y + gamma * gamma);
  // For y < 0 the sum would cancel: 2/(y + R) = 2 (R − y)/γ².
  const auto positive = y > 0;
  const T value = 2 * select(positive, all<T>(1), root - y) / select(positive, root + y, gamma * gamma);
  const T inverse = 1 / root;
  return {value, -value * inverse, 2 * inverse * inverse * inverse};
}

/// Terms that value and derivatives share.
template <class T>
struct Apex {
  Vector<T> u;
  T volume6, along_normal, length2;  ///< D, t, Σ length²

  TEMPER_INLINE Apex(const LinkFace<T>& face, const Vector<T>& p, const T& w) : u(p - face.origin) {
    const T u2 = dot(u, u);
    volume6 = dot(face.normal, u);
    along_normal = (u2 - (w - face.weight) - 2 * dot(face.center, u)) / (2 * volume6);
    length2 = face.length2;
    for (const auto& e : face.edges) length2 = length2 + dot(u - e.from, u - e.from);
  }
};

template <class T>
TEMPER_INLINE T tet_energy(const LinkFace<T>& face, const Apex<T>& apex, const T& gamma) {
  T barriers = soft_barrier(face.factor * apex.along_normal, gamma).value;
  for (const auto& e : face.edges) {
    const Vector<T> v = apex.u - e.from;
    const T along = dot(v, e.along), m = square_root(dot(v, v) * e.length2 - along * along);
    const T height = dot(v, e.plane) + apex.along_normal * dot(v, e.turn);
    barriers = barriers + soft_barrier(height / (kLengthOfArea * m * square_root(m)), gamma).value;
  }
  const T shape = 6 * kShapeFactor * apex.length2 * square_root(apex.length2) / apex.volume6;
  return select(apex.volume6 > 0, kHeightFactor * barriers + shape, all<T>(HUGE_VAL));
}
template <class T>
TEMPER_INLINE T tet_energy(const LinkFace<T>& face, const Vector<T>& p, const T& w, const T& gamma) {
  return tet_energy(face, Apex<T>(face, p, w), gamma);
}

/// The face of p over an edge: what its derivatives need of roots and quotients.
template <class T>
struct ApexFace {
  Vector<T> v;
  T along, turn;  ///< v·e and m·n
  T height;       ///< h |m|
  T inverse_m2;   ///< |m|⁻²
  T scale;        ///< of h |m| in h/ℓ
  SoftBarrier<T> barrier;
};
template <class T>
TEMPER_INLINE ApexFace<T> apex_face(const typename LinkFace<T>::Edge& e, const Apex<T>& apex, const T& gamma) {
  const Vector<T> v = apex.u - e.from;
  const T along = dot(v, e.along), m2 = dot(v, v) * e.length2 - along * along;
  const T turn = dot(v, e.turn), height = dot(v, e.plane) + apex.along_normal * turn;
  const T inverse_root = 1 / square_root(square_root(m2)), inverse_m = inverse_root * inverse_root;
  const T scale = 1 / kLengthOfArea * inverse_m * inverse_root;
  return {v, along, turn, height, inverse_m * inverse_m, scale, soft_barrier(height * scale, gamma)};
}

/// The same value, with gradient and Hessian. Let g = h |m| and S = |m|², so that h/ℓ = g S^(−3/4)/kLengthOfArea. By
/// the product rule all second derivatives are products of vectors, but for those of t, which all faces share.
template <class T>
TEMPER_INLINE PointDerivatives<T> tet_derivatives(const LinkFace<T>& face, const Apex<T>& apex, const T& gamma) {
  PointDerivatives<T> d = {};
  const T& t = apex.along_normal;
  const T inverse = 1 / apex.volume6;
  const PointVector<T> dt = {inverse * (apex.u - face.center - t * face.normal), -0.5 * inverse};
  const auto plus = [&](const SoftBarrier<T>& b, const PointVector<T>& dy) {
    d.value = d.value + kHeightFactor * b.value;
    d.gradient = d.gradient + kHeightFactor * b.slope * dy;
    d.hessian.add_square(kHeightFactor * b.curvature, dy);
    return kHeightFactor * b.slope;
  };
  T of_ddt = face.factor * plus(soft_barrier(face.factor * t, gamma), face.factor * dt);  // factor of the Hessian of t
  Vector<T> with_dt = {all<T>(0), all<T>(0), all<T>(0)};
  // Roots and quotients of all three faces come first: they take long, and so run at once.
  std::array<ApexFace<T>, 3> faces;
  for (std::size_t i = 0; i < 3; ++i) faces[i] = apex_face(face.edges[i], apex, gamma);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& e = face.edges[i];
    const auto& [v, along, turn, height, inverse_m2, scale, barrier] = faces[i];
    const Vector<T> dm2 = all<T>(2) * (e.length2 * v - along * e.along);
    const PointVector<T> dheight = {e.plane + t * e.turn + turn * dt.at, turn * dt.w};
    const T per_m2 = -0.75 * scale * inverse_m2;  // of scale by m2
    const PointVector<T> dy = {scale * dheight.at + height * per_m2 * dm2, scale * dheight.w};
    const T slope = plus(barrier, dy);
    of_ddt = of_ddt + slope * scale * turn;
    with_dt = with_dt + slope * scale * e.turn;
    d.hessian.add_both(slope * per_m2 * dm2, dheight);
    d.hessian.add_square(-1.75 * slope * height * per_m2 * inverse_m2, dm2);
    const T bend = 2 * slope * height * per_m2;  // of the Hessian of m2, over 2
    d.hessian.add_in_space(bend * e.length2);
    d.hessian.add_square(-bend, e.along);
  }
  with_dt = with_dt - of_ddt * inverse * face.normal;
  d.hessian.add_both(with_dt, dt);
  d.hessian.add_in_space(of_ddt * inverse);

  const T root = square_root(apex.length2), shape = 6 * kShapeFactor * apex.length2 * root * inverse;
  Vector<T> dlength2 = {all<T>(0), all<T>(0), all<T>(0)};
  for (const auto& e : face.edges) dlength2 = dlength2 + all<T>(2) * (apex.u - e.from);
  const Vector<T> to_length = 1 / apex.length2 * dlength2, to_volume = inverse * face.normal;
  const Vector<T> relative = all<T>(1.5) * to_length - to_volume;
  d.value = select(apex.volume6 > 0, d.value + shape, all<T>(HUGE_VAL));
  d.gradient.at = d.gradient.at + shape * relative;
  d.hessian.add_square(shape, relative);
  d.hessian.add_square(shape, to_volume);
  d.hessian.add_square(-1.5 * shape, to_length);
  d.hessian.add_in_space(9 * shape / apex.length2);
  return d;
}
template <class T>
TEMPER_INLINE PointDerivatives<T> tet_derivatives(const LinkFace<T>& face, const Vector<T>& p, const T& w,
                                                  const T& gamma) {
  return tet_derivatives(face, Apex<T>(face, p, w), gamma);
}

}  // namespace temper::tets
