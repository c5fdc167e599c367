// The derivatives of a triangle's scaled heights, for one triangle (T = double) or for eight at once (T = Pack).
//
// Let a, b, S, u_a, u_b be as in triangle_kernel.hpp, c = b − a, and the orthocenter at p + ω. Then
//
//   a·ω = u_a    b·ω = u_b    g_pq = a × ω    g_rp = ω × b    g_qr = S − g_pq − g_rp
//
// so that all derivatives follow from derivatives of ω. A step of the differences moves ω by dω with
//
//   a·dω = α = (a − ω)·da + dw_a/2    b·dω = β = (b − ω)·db + dw_b/2        w_a = w_p − w_q, w_b = w_p − w_r
//   a × dω = (|a|² β − a·b α)/S       dω × b = (|b|² α − a·b β)/S
#pragma once

#include <cstddef>

#include "base/pack.hpp"
#include "geometry/triangle_kernel.hpp"

namespace temper {

// Vectors and matrices in (x, y, w) of one corner, on the sphere in its chart. A PlaneVector is one whose part in w is
// zero, so that zeros cost no operations.

template <class T>
struct PlaneVector {
  T x, y;
};

template <class T>
struct CornerVector {
  T x, y, w;
};
template <class T>
TEMPER_INLINE CornerVector<T> operator+(const CornerVector<T>& u, const CornerVector<T>& v) {
  return {u.x + v.x, u.y + v.y, u.w + v.w};
}
template <class T>
TEMPER_INLINE CornerVector<T> operator*(const T& f, const CornerVector<T>& v) {
  return {f * v.x, f * v.y, f * v.w};
}
template <class Mask, class T>
TEMPER_INLINE CornerVector<T> select(Mask m, const CornerVector<T>& u, const CornerVector<T>& v) {
  return {select(m, u.x, v.x), select(m, u.y, v.y), select(m, u.w, v.w)};
}

/// The upper half of a matrix that becomes symmetric when all terms are added.
template <class T>
struct CornerMatrix {
  T xx, xy, xw, yy, yw, ww;

  /// u⊗v.
  TEMPER_INLINE static CornerMatrix product(const CornerVector<T>& u, const CornerVector<T>& v) {
    return {u.x * v.x, u.x * v.y, u.x * v.w, u.y * v.y, u.y * v.w, u.w * v.w};
  }
  TEMPER_INLINE void add(const CornerVector<T>& u, const CornerVector<T>& v) {
    add(PlaneVector<T>{u.x, u.y}, v);
    ww = ww + u.w * v.w;
  }
  TEMPER_INLINE void add(const PlaneVector<T>& u, const CornerVector<T>& v) {
    xx = xx + u.x * v.x, xy = xy + u.x * v.y, xw = xw + u.x * v.w;
    yy = yy + u.y * v.y, yw = yw + u.y * v.w;
  }
  /// u⊗v + v⊗u + f u⊗u.
  TEMPER_INLINE void add_both(const CornerVector<T>& u, const CornerVector<T>& v, const T& f) {
    add(u, v + f * u);
    add(v, u);
  }
  /// f I in the plane.
  TEMPER_INLINE void add_in_plane(const T& f) { xx = xx + f, yy = yy + f; }
};

/// Gradient and Hessian in (x, y, w) of the corner.
template <class T>
struct CornerDerivatives {
  CornerVector<T> gradient;
  CornerMatrix<T> hessian;

  /// Adds both where a mask is set.
  template <class Mask>
  TEMPER_INLINE void add(Mask where, const CornerVector<T>& g, const CornerMatrix<T>& h) {
    const auto sum = [&](T& to, const T& x) { to = to + select(where, x, all<T>(0)); };
    sum(gradient.x, g.x), sum(gradient.y, g.y), sum(gradient.w, g.w);
    sum(hessian.xx, h.xx), sum(hessian.xy, h.xy), sum(hessian.xw, h.xw);
    sum(hessian.yy, h.yy), sum(hessian.yw, h.yw), sum(hessian.ww, h.ww);
  }
};

/// The orthocenter, seen from p: ω.
template <class T>
TEMPER_INLINE PlaneVector<T> orthocenter(const Spoke<T>& a, const Spoke<T>& b, const T& inverse_area) {
  return {(a.u * b.y - b.u * a.y) * inverse_area, (b.u * a.x - a.u * b.x) * inverse_area};
}

/// The derivatives in p alone, where da = db = −dp and dw_a = dw_b = dw_p. Let m = ∇S = (−c_y, c_x),
/// ω̂ = (ω_x, ω_y, ½), k = a·c/S and κ = |c|²/S. Then
///
///   ∇g_pq = (a_y − ω_y, ω_x − a_x, 0) − k ω̂    ∇²g_pq = k I + ω̂⊗(c + k m)/S + (c + k m)⊗ω̂/S
///   ∇g_qr = − κ ω̂                              ∇²g_qr = κ (I + ω̂⊗m/S + m⊗ω̂/S)
///   ∇g_rp = m − ∇g_pq − ∇g_qr                  ∇²g_rp = − ∇²g_pq − ∇²g_qr
template <class T>
struct HeightsAtCorner {
  CornerVector<T> pq, qr, rp;  ///< gradients
  PlaneVector<T> center;       ///< ω
  PlaneVector<T> c_over_s;     ///< c/S
  T k, kappa;

  /// The Hessian of f_pq g_pq + f_qr g_qr + f_rp g_rp.
  TEMPER_INLINE void add_hessian(const T& f_pq, const T& f_qr, const T& f_rp, CornerMatrix<T>& sum) const {
    const T on_c = f_pq - f_rp, round = on_c * k + (f_qr - f_rp) * kappa;
    const T x = on_c * c_over_s.x - round * c_over_s.y, y = on_c * c_over_s.y + round * c_over_s.x;
    const T ox = center.x * x, oy = center.y * y;
    sum.xx = sum.xx + (round + 2 * ox), sum.yy = sum.yy + (round + 2 * oy);
    sum.xy = sum.xy + (center.x * y + center.y * x);
    sum.xw = sum.xw + 0.5 * x, sum.yw = sum.yw + 0.5 * y;
  }
};

template <class T>
TEMPER_INLINE HeightsAtCorner<T> heights_at_corner(const Spoke<T>& a, const Spoke<T>& b, const T& inverse_area) {
  HeightsAtCorner<T> h;
  const T cx = b.x - a.x, cy = b.y - a.y;
  h.center = orthocenter(a, b, inverse_area);
  h.c_over_s = {cx * inverse_area, cy * inverse_area};
  const auto& [ox, oy] = h.center;
  h.k = a.x * h.c_over_s.x + a.y * h.c_over_s.y;
  h.kappa = cx * h.c_over_s.x + cy * h.c_over_s.y;
  h.pq = {(a.y - oy) - h.k * ox, (ox - a.x) - h.k * oy, -0.5 * h.k};
  h.qr = {-h.kappa * ox, -h.kappa * oy, -0.5 * h.kappa};
  h.rp = {-cy - h.pq.x - h.qr.x, cx - h.pq.y - h.qr.y, -h.pq.w - h.qr.w};
  return h;
}

// --- the squared length of an edge and its weight difference, as they depend on p ---------------------------------
//
// In the plane ∇ℓ² = (−2a, 0), ∇²ℓ² = 2 in the plane, and ∇Δw = (0, 0, 1). In a chart of the sphere ℓ² depends on w,
// too. There ∇²ℓ² = ∇²Δw = 2 (1, 1, σ²) on the diagonal.

template <class T>
TEMPER_INLINE PlaneVector<T> gradient_of_l2(const Spoke<T>& a) {
  return {-2.0 * a.x, -2.0 * a.y};
}
template <class T>
TEMPER_INLINE CornerVector<T> gradient_of_l2(const SphereSpoke<T>& a) {
  return {-2.0 * a.x, -2.0 * a.y, -2.0 * (a.sigma * a.z)};
}

/// f_l ∇ℓ² + f_w ∇Δw.
template <class T>
TEMPER_INLINE CornerVector<T> by_l2_and_dw(const T& f_l, const PlaneVector<T>& to_l2, const T& f_w) {
  return {f_l * to_l2.x, f_l * to_l2.y, f_w};
}
template <class T>
TEMPER_INLINE CornerVector<T> by_l2_and_dw(const T& f_l, const CornerVector<T>& to_l2, const T& f_w) {
  return {f_l * to_l2.x, f_l * to_l2.y, f_l * to_l2.w + f_w};
}

/// The contribution of ∇Δw to f_lw (∇Δw⊗∇ℓ² + …) in the upper half: its part in w.
template <class T>
TEMPER_INLINE T along_w(const T& f_lw, const PlaneVector<T>&, const T& rest) {
  static_cast<void>(f_lw);
  return rest;
}
template <class T>
TEMPER_INLINE T along_w(const T& f_lw, const CornerVector<T>& to_l2, const T& rest) {
  return rest + f_lw * to_l2.w;
}

/// f_l ∇²ℓ² + f_w ∇²Δw.
template <class T>
TEMPER_INLINE void add_curvature(const Spoke<T>&, const T& f_l, const T&, CornerMatrix<T>& sum) {
  sum.add_in_plane(2.0 * f_l);
}
template <class T>
TEMPER_INLINE void add_curvature(const SphereSpoke<T>& a, const T& f_l, const T& f_w, CornerMatrix<T>& sum) {
  const T f = 2.0 * (f_l + f_w);
  sum.add_in_plane(f);
  sum.ww = sum.ww + f * (a.sigma * a.sigma);
}

/// Turns derivatives along straight steps of P into derivatives along steps of its chart. The second derivatives of
/// these steps are − up/ρ in x and y, − up/(4ρ³) in w, and e₁/(2ρ²) in x and w.
template <class T>
TEMPER_INLINE void bend(const PointOf<T>&, CornerDerivatives<T>&) {}
template <class T>
TEMPER_INLINE void bend(const Chart<T>& chart, CornerDerivatives<T>& d) {
  const T slope = 2.0 * (chart.sigma * chart.sigma), twice_w = 2.0 * d.gradient.w;
  d.hessian.add_in_plane(-twice_w);
  d.hessian.ww = d.hessian.ww - chart.sigma * chart.sigma * twice_w;
  d.hessian.xw = d.hessian.xw + slope * d.gradient.x;
  d.hessian.yw = d.hessian.yw + slope * d.gradient.y;
}

// --- heights on the sphere -----------------------------------------------------------------------------------------

/// The derivatives in P alone. Let n̂ be the unit normal of the triangle, c = b − a, and g_pq = (P × Q)·n̂. A step dP
/// turns n̂ by − (n̂·dP/S) m, m = n̂ × c = ∇S. With H = n̂·P, k = a·c/S and κ = |c|²/S
///
///   ∇g_pq = − n̂ × Q − k H n̂     ∇²g_pq = (H/S) [c⊗n̂ + k m⊗n̂ + …ᵀ] − [c·Q/S + k (1 − m·P/S)] n̂⊗n̂
///   ∇g_qr = − κ H n̂             ∇²g_qr = (H/S) κ [m⊗n̂ + …ᵀ] − κ (1 − m·P/S) n̂⊗n̂
///   ∇g_rp = m − ∇g_pq − ∇g_qr   ∇²g_rp = κ n̂⊗n̂ − ∇²g_pq − ∇²g_qr
///
/// Below all vectors are in the chart's (x, y, w): their part along up times σ.
template <class T>
struct HeightsAtSphereCorner {
  CornerVector<T> pq, qr, rp;  ///< gradients
  CornerVector<T> area;        ///< m
  CornerVector<T> normal, c;   ///< n̂, c
  T k, kappa, height_over_s;   ///< H/S
  T cq_over_s, turn;           ///< c·Q/S, 1 − m·P/S

  /// The Hessian of f_pq g_pq + f_qr g_qr + f_rp g_rp.
  TEMPER_INLINE void add_hessian(const T& f_pq, const T& f_qr, const T& f_rp, CornerMatrix<T>& sum) const {
    const T on_c = f_pq - f_rp, round = on_c * k + (f_qr - f_rp) * kappa;
    const CornerVector<T> v = height_over_s * (on_c * c + round * area);
    sum.add_both(normal, v, f_rp * kappa - on_c * cq_over_s - round * turn);
  }
};

template <class T>
TEMPER_INLINE HeightsAtSphereCorner<T> heights_at_corner(const SphereSpoke<T>& a, const SphereSpoke<T>& b,
                                                         const T& inverse_area) {
  HeightsAtSphereCorner<T> h;
  const T cx = b.x - a.x, cy = b.y - a.y, cz = b.z - a.z, qz = a.rho + a.z, sigma = a.sigma;
  const T nx = (a.y * b.z - a.z * b.y) * inverse_area, ny = (a.z * b.x - a.x * b.z) * inverse_area;
  const T nz = (a.x * b.y - a.y * b.x) * inverse_area;
  const T mx = ny * cz - nz * cy, my = nz * cx - nx * cz, mz = nx * cy - ny * cx;
  const T above = nz * a.rho;  // H
  h.k = (a.x * cx + a.y * cy + a.z * cz) * inverse_area;
  h.kappa = (cx * cx + cy * cy + cz * cz) * inverse_area;
  h.height_over_s = above * inverse_area;
  h.cq_over_s = (cx * a.x + cy * a.y + cz * qz) * inverse_area;
  h.turn = 1 - mz * a.rho * inverse_area;
  const T kh = h.k * above, kappa_h = h.kappa * above;
  h.normal = {nx, ny, sigma * nz};
  h.c = {cx, cy, sigma * cz};
  h.area = {mx, my, sigma * mz};
  h.pq = {nz * a.y - ny * qz - kh * nx, nx * qz - nz * a.x - kh * ny, sigma * (ny * a.x - nx * a.y - kh * nz)};
  h.qr = -kappa_h * h.normal;
  h.rp = {h.area.x - h.pq.x - h.qr.x, h.area.y - h.pq.y - h.qr.y, h.area.w - h.pq.w - h.qr.w};
  return h;
}

// --- what kernels are compiled for: how a vertex is kept, and what it is as the center of a star -------------------

template <class T>
struct InPlaneOf {
  using Scalar = T;
  using Point = PointOf<T>;
  using Center = PointOf<T>;
  using Spoke = temper::Spoke<T>;
  using Heights = HeightsAtCorner<T>;
};
template <class T>
struct OnSphereOf {
  using Scalar = T;
  using Point = WeightedVectorOf<T>;
  using Center = Chart<T>;
  using Spoke = SphereSpoke<T>;
  using Heights = HeightsAtSphereCorner<T>;
};

// Vectors and matrices in the six differences (q − p, w_q − w_p, r − p, w_r − w_p).

/// The place of the entry of row i and column j ≤ i of a symmetric matrix in its storage.
[[nodiscard]] TEMPER_INLINE constexpr std::size_t hessian_entry(std::size_t i, std::size_t j) {
  return i * (i + 1) / 2 + j;
}

template <class T>
struct Vector6 {
  T v[6];
  TEMPER_INLINE T& operator[](std::size_t i) { return v[i]; }
  TEMPER_INLINE const T& operator[](std::size_t i) const { return v[i]; }
};

/// A symmetric matrix: its lower triangle.
template <class T>
struct Symmetric6 {
  T v[21];
  TEMPER_INLINE void add(std::size_t i, std::size_t j, const T& x) {
    T& entry = v[i < j ? hessian_entry(j, i) : hessian_entry(i, j)];
    entry = entry + x;
  }
  /// x⊗y + y⊗x, where x is zero outside the entries first … first + n − 1. An entry on the diagonal gets both.
  TEMPER_INLINE void add_sum_of_products(const T* x, std::size_t first, std::size_t n, const Vector6<T>& y) {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < 6; ++j) {
        const T product = x[i] * y[j];
        add(first + i, j, j == first + i ? 2 * product : product);
      }
    }
  }
  /// x⊗y + y⊗x, where x is zero outside the entries first … first + 2, and y has no part in a weight.
  TEMPER_INLINE void add_sum_of_products(const T* x, std::size_t first, const PlaneVector<T>& y_a,
                                         const PlaneVector<T>& y_b) {
    const T y[4] = {y_a.x, y_a.y, y_b.x, y_b.y};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t j = k < 2 ? k : k + 1;
        const T product = x[i] * y[k];
        add(first + i, j, j == first + i ? 2 * product : product);
      }
    }
  }
};

/// The derivatives in all three corners. Let J (x, y) = (y, −x), A = (a − ω, −½) and B = (b − ω, −½). Then α is
/// A·(da, dδ_a) for δ_a = w_q − w_p, and β likewise with B. The gradients in (da, dδ_a) and (db, dδ_b) are
///
///   ∇g_pq = (Jω − (a·b/S) A, (|a|²/S) B)    ∇g_rp = ((|b|²/S) A, − Jω − (a·b/S) B)    ∇S = (Jb, − Ja)
///
/// Let k_a = (f_pq − f_qr)/S, k_b = (f_rp − f_qr)/S, m_a = k_b |b|² − k_a a·b, m_b = k_a |a|² − k_b a·b. The Hessian of
/// f_pq g_pq + f_qr g_qr + f_rp g_rp is then f_qr ∇²S + m_a I_a + m_b I_b + A⊗P + P⊗A + B⊗Q + Q⊗B where
///
///   P = (− (k_a + m_a J/S) b, (k_b − m_b J/S) b)    Q = ((k_a + m_a J/S) a, − (k_b − m_b J/S) a)
template <class T>
struct HeightsOfTriangle {
  Vector6<T> pq, qr, rp;  ///< gradients
  Spoke<T> a, b;
  T to_a[3], to_b[3];  ///< A, B
  T ab, inverse_area;

  TEMPER_INLINE void add_hessian(const T& f_pq, const T& f_qr, const T& f_rp, Symmetric6<T>& sum) const {
    const T ka = (f_pq - f_qr) * inverse_area, kb = (f_rp - f_qr) * inverse_area;
    const T ma = kb * b.l2 - ka * ab, mb = ka * a.l2 - kb * ab, ja = ma * inverse_area, jb = mb * inverse_area;
    sum.add_sum_of_products(to_a, 0, {-(ka * b.x + ja * b.y), ja * b.x - ka * b.y},
                            {kb * b.x - jb * b.y, kb * b.y + jb * b.x});
    sum.add_sum_of_products(to_b, 3, {ka * a.x + ja * a.y, ka * a.y - ja * a.x},
                            {jb * a.y - kb * a.x, -(kb * a.y + jb * a.x)});
    for (std::size_t i = 0; i < 2; ++i) sum.add(i, i, ma), sum.add(3 + i, 3 + i, mb);
    sum.add(4, 0, f_qr), sum.add(3, 1, -f_qr);
  }
};

template <class T>
TEMPER_INLINE HeightsOfTriangle<T> heights_of_triangle(const Spoke<T>& a, const Spoke<T>& b, const T& inverse_area) {
  HeightsOfTriangle<T> h;
  const auto [ox, oy] = orthocenter(a, b, inverse_area);
  const T ab = a.x * b.x + a.y * b.y, la = a.l2 * inverse_area, lb = b.l2 * inverse_area, both = ab * inverse_area;
  const T zero = all<T>(0);
  const T ds[6] = {b.y, -b.x, zero, -a.y, a.x, zero}, at_a[3] = {oy, -ox, zero}, minus_half = all<T>(-0.5);
  h.a = a, h.b = b, h.ab = ab, h.inverse_area = inverse_area;
  h.to_a[0] = a.x - ox, h.to_a[1] = a.y - oy, h.to_a[2] = minus_half;
  h.to_b[0] = b.x - ox, h.to_b[1] = b.y - oy, h.to_b[2] = minus_half;
  for (std::size_t i = 0; i < 3; ++i) {
    h.pq[i] = at_a[i] - both * h.to_a[i], h.pq[3 + i] = la * h.to_b[i];
    h.rp[i] = lb * h.to_a[i], h.rp[3 + i] = -at_a[i] - both * h.to_b[i];
  }
  for (std::size_t i = 0; i < 6; ++i) h.qr[i] = ds[i] - h.pq[i] - h.rp[i];
  return h;
}

}  // namespace temper
