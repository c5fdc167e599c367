// The triangle pqr as a function of (x, y, w) of its corner p, for energies and their derivatives. It is one triangle
// (T = double), or eight at once (T = Pack).
//
// Let a = q − p, b = r − p and S = a × b. Let u_a = (|a|² + w_p − w_q)/2, u_b = (|b|² + w_p − w_r)/2. The scaled
// heights g = h ℓ are rational:
//
//   g_pq = (u_b |a|² − u_a a·b)/S     g_rp = (u_a |b|² − u_b a·b)/S     g_qr = S − g_pq − g_rp
//
// h is positive on the left of the directed edges pq, qr, rp, whatever the orientation of the triangle.
//
// On the sphere (temper/detail/space.hpp) this holds for the flat triangle PQR with the weights |P|², |Q|², |R|². There
// u_a = P·(P − Q), and S has the sign of P·(a × b). Seen from P, in its chart:
//
//        up = P/ρ       ρ = |P|. A step (x, y, w) takes P to the direction of P + x e₁ + y e₂ and the length √(ρ² + w):
//          |            x and y change its place alone, and w its weight, as in the plane.
//        P +--- e₂      To first order P moves by x e₁ + y e₂ + w/(2ρ) up. Results in the chart, derivatives too, have
//         /             the plane's units, and the plane's formulas with a few terms more.
//        e₁
#pragma once

#include <array>

#include "base/pack.hpp"
#include "temper/detail/space.hpp"
#include "temper/detail/vec.hpp"

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

/// The weighted vector of a vertex on the sphere.
template <class T>
struct WeightedVectorOf {
  T x, y, z;
};

/// From p to another corner.
template <class T>
struct Spoke {
  T x, y;  ///< a
  T l2;    ///< |a|²
  T dw;    ///< w_p − w_q
  T u;     ///< u_a
};

/// Point: PointOf<T>, or any type with x, y, w.
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

/// A vertex that triangles are seen from: in the plane the point itself.
template <class T>
TEMPER_INLINE PointOf<T> seen_from(const PointOf<T>& p) {
  return p;
}

/// P with its chart: unit vectors e₁, e₂ and up, and σ = 1/(2ρ).
template <class T>
struct Chart {
  WeightedVectorOf<T> at;
  WeightedVectorOf<T> e1, e2, up;
  T rho, sigma;

  /// The point after a step; a step of zero gives P itself, bit for bit.
  TEMPER_INLINE WeightedVectorOf<T> moved(const T& x, const T& y, const T& w) const {
    // 1 + f is √((ρ² + w)/(ρ² + x² + y²)).
    const T rho2 = rho * rho, s2 = x * x + y * y, root = square_root((rho2 + w) / (rho2 + s2));
    const T f = (w - s2) / ((rho2 + s2) * (root + 1)), g = 1 + f;
    return {at.x + (f * at.x + g * (x * e1.x + y * e2.x)), at.y + (f * at.y + g * (x * e1.y + y * e2.y)),
            at.z + (f * at.z + g * (x * e1.z + y * e2.z))};
  }
};

/// e₁ and e₂ without a branch (Duff et al., Building an orthonormal basis, revisited, JCGT 6, 2017).
template <class T>
TEMPER_INLINE Chart<T> seen_from(const WeightedVectorOf<T>& p) {
  const T rho = square_root(p.x * p.x + p.y * p.y + p.z * p.z), inverse = 1.0 / rho;
  const T x = p.x * inverse, y = p.y * inverse, z = p.z * inverse;
  const T sign = select(z < all<T>(0), all<T>(-1), all<T>(1)), a = all<T>(-1) / (sign + z), b = x * y * a;
  return {p, {1 + sign * (x * x * a), sign * b, -sign * x}, {b, sign + y * y * a, -y}, {x, y, z}, rho, 0.5 * inverse};
}

/// From P to another corner, in the chart of P.
template <class T>
struct SphereSpoke {
  T x, y, z;     ///< a
  T l2;          ///< |a|²
  T dw;          ///< |P|² − |Q|²
  T u;           ///< u_a
  T rho, sigma;  ///< of the chart
};

template <class T>
TEMPER_INLINE SphereSpoke<T> spoke(const Chart<T>& p, const WeightedVectorOf<T>& q) {
  const T dx = q.x - p.at.x, dy = q.y - p.at.y, dz = q.z - p.at.z;
  const T x = dx * p.e1.x + dy * p.e1.y + dz * p.e1.z, y = dx * p.e2.x + dy * p.e2.y + dz * p.e2.z;
  const T z = dx * p.up.x + dy * p.up.y + dz * p.up.z;
  const T l2 = dx * dx + dy * dy + dz * dz, u = -(p.rho * z);
  return {x, y, z, l2, 2 * u - l2, u, p.rho, p.sigma};
}

template <class T>
TEMPER_INLINE TriangleShapeOf<T> triangle_shape(const SphereSpoke<T>& a, const SphereSpoke<T>& b,
                                                const WeightedVectorOf<T>& q, const WeightedVectorOf<T>& r) {
  const T nx = a.y * b.z - a.z * b.y, ny = a.z * b.x - a.x * b.z, nz = a.x * b.y - a.y * b.x;
  const T area = square_root(nx * nx + ny * ny + nz * nz), s = select(nz < all<T>(0), -area, area);
  const T ab = a.x * b.x + a.y * b.y + a.z * b.z, inverse = 1.0 / s;
  const T cx = r.x - q.x, cy = r.y - q.y, cz = r.z - q.z;
  const T ga = (b.u * a.l2 - a.u * ab) * inverse;
  const T gb = (a.u * b.l2 - b.u * ab) * inverse;
  const T dw = -(cx * (q.x + r.x) + cy * (q.y + r.y) + cz * (q.z + r.z));
  return {{a.l2, a.dw, ga}, {cx * cx + cy * cy + cz * cz, dw, s - ga - gb}, {b.l2, b.dw, gb}, s, inverse};
}

[[gnu::always_inline]] inline TriangleShape triangle_shape(const WeightedPoint& p, const WeightedPoint& q,
                                                           const WeightedPoint& r) {
  const TriangleShapeOf<double> s = triangle_shape(spoke(p, q), spoke(p, r), q, r);
  return {{s.pq, s.qr, s.rp}, s.doubled_area};
}

[[nodiscard]] TEMPER_INLINE WeightedVectorOf<double> weighted_vector(const WeightedPoint& p) { return {p.x, p.y, p.w}; }

/// ℓ² and Δw of an edge in the space of its mesh.
struct EdgeMeasures {
  double l2, dw;
};
// The case of the sphere is behind a call, with points by value: in the plane they stay in registers.
[[gnu::noinline]] inline EdgeMeasures edge_measures_on_sphere(WeightedPoint p, WeightedPoint q) {
  const Vec3 c = as_vector(q) - as_vector(p);
  return {squared_length(c), -dot(c, as_vector(p) + as_vector(q))};
}
[[nodiscard]] TEMPER_INLINE EdgeMeasures edge_measures(const Space& space, const WeightedPoint& p,
                                                       const WeightedPoint& q) {
  if (space.is_plane()) [[likely]]
    return {squared_length(q.position() - p.position()), p.w - q.w};
  return edge_measures_on_sphere(p, q);
}

[[gnu::noinline]] inline TriangleShape triangle_shape_on_sphere(WeightedPoint p, WeightedPoint q, WeightedPoint r) {
  const Chart<double> from = seen_from(weighted_vector(p));
  const WeightedVectorOf<double> to_q = weighted_vector(q), to_r = weighted_vector(r);
  const TriangleShapeOf<double> s = triangle_shape(spoke(from, to_q), spoke(from, to_r), to_q, to_r);
  return {{s.pq, s.qr, s.rp}, s.doubled_area};
}

/// The triangle in the space of its mesh.
[[gnu::always_inline]] inline TriangleShape triangle_shape(const Space& space, const WeightedPoint& p,
                                                           const WeightedPoint& q, const WeightedPoint& r) {
  if (space.is_plane()) [[likely]]
    return triangle_shape(p, q, r);
  return triangle_shape_on_sphere(p, q, r);
}

/// The vertex at the end of t times a step (x, y, w), in the space of its mesh.
[[nodiscard]] inline WeightedPoint along(const Space& space, const WeightedPoint& p, const std::array<double, 3>& step,
                                         double t) {
  if (space.is_plane()) [[likely]]
    return {p.x + t * step[0], p.y + t * step[1], p.w + t * step[2]};
  const WeightedVectorOf<double> q = seen_from(weighted_vector(p)).moved(t * step[0], t * step[1], t * step[2]);
  return {q.x, q.y, q.z};
}

/// The direction from p to a vertex, in the plane of steps. The sphere is projected from its center, so that arcs are
/// straight, and p moves along a straight line.
[[nodiscard]] inline Vec2 direction_to(const Space& space, const WeightedPoint& p, const WeightedPoint& q) {
  if (space.is_plane()) [[likely]]
    return q.position() - p.position();
  const SphereSpoke<double> a = spoke(seen_from(weighted_vector(p)), weighted_vector(q));
  return a.rho / (a.rho + a.z) * Vec2{a.x, a.y};
}

}  // namespace temper
