// Whole triangles in packs: part of star_kernels_set.hpp.
//
// With a = q − p, b = r − p, c = b − a, the energy is
//
//   F(|a|², w_a, g_pq) + F(|b|², w_b, g_rp) + F(|c|², w_a − w_b, g_qr),    w_a = w_q − w_p, w_b = w_r − w_p
//
// and its Hessian the sum over edges of F″ between the gradients of (ℓ², w, g), of F_ℓ ∇²ℓ², and of F_g ∇²g, which is
// in geometry/height_derivatives.hpp.
#pragma once

#include "energy/star_sums.hpp"
#include "energy/triangle_hessian.hpp"

namespace temper::TEMPER_INSTRUCTION_SET {
namespace {

/// Gradient and Hessian of one triangle, edge by edge, so that little has to be kept at a time.
struct AllDerivatives {
  Vector6<Pack> gradient;
  Symmetric6<Pack> hessian;

  /// The edge qr, which comes first: ∇ℓ² is 2 (−c, c) and ∇Δw (1, −1).
  TEMPER_INLINE void begin(const PackTerm& f, Pack cx, Pack cy, const Vector6<Pack>& dg) {
    const Pack x = 2 * cx, y = 2 * cy, zero = Pack::all(0);
    const Vector6<Pack> dl = {{-x, -y, zero, x, y, zero}};
    Vector6<Pack> of_l, of_w;  // beside ∇ℓ² and ∇Δw, with half of f_ll ∇ℓ² and f_ww ∇Δw, since both orders are added
    for (std::size_t i = 0; i < 6; ++i) {
      of_l[i] = 0.5 * f.f_ll * dl[i] + f.f_lg * dg[i];
      of_w[i] = f.f_wg * dg[i] + f.f_lw * dl[i];
      gradient[i] = f.f_g * dg[i] + f.f_l * dl[i];
      const Pack by_g = f.f_gg * dg[i];
      for (std::size_t j = 0; j <= i; ++j) hessian.v[hessian_entry(i, j)] = by_g * dg[j];
    }
    gradient[2] = gradient[2] + f.f_w, gradient[5] = gradient[5] - f.f_w;
    of_w[2] = of_w[2] + 0.5 * f.f_ww, of_w[5] = of_w[5] - 0.5 * f.f_ww;
    hessian.add_sum_of_products(dl.v, 0, 2, of_l);
    hessian.add_sum_of_products(dl.v + 3, 3, 2, of_l);
    const Pack one = Pack::all(1), minus_one = Pack::all(-1);
    hessian.add_sum_of_products(&one, 2, 1, of_w);
    hessian.add_sum_of_products(&minus_one, 5, 1, of_w);
    for (std::size_t i = 0; i < 2; ++i) {
      hessian.add(i, i, 2 * f.f_l);
      hessian.add(3 + i, 3 + i, 2 * f.f_l);
      hessian.add(3 + i, i, -2 * f.f_l);
    }
  }

  /// The edge pq or rp: ∇ℓ² = 2 (x, y) and ∇Δw = −1 stand at `first`.
  TEMPER_INLINE void add(const PackTerm& f, const Spoke<Pack>& to, const Vector6<Pack>& dg, std::size_t first) {
    const Pack dl[2] = {2 * to.x, 2 * to.y};
    const Pack beside_dg[3] = {f.f_lg * dl[0], f.f_lg * dl[1], -f.f_wg};
    for (std::size_t i = 0; i < 6; ++i) {
      gradient[i] = gradient[i] + f.f_g * dg[i];
      const Pack by_g = f.f_gg * dg[i];
      for (std::size_t j = 0; j <= i; ++j) hessian.add(i, j, by_g * dg[j]);
    }
    hessian.add_sum_of_products(beside_dg, first, 3, dg);
    for (std::size_t i = 0; i < 2; ++i) {
      gradient[first + i] = gradient[first + i] + f.f_l * dl[i];
      for (std::size_t j = 0; j <= i; ++j) hessian.add(first + i, first + j, f.f_ll * dl[i] * dl[j]);
      hessian.add(first + 2, first + i, -f.f_lw * dl[i]);
      hessian.add(first + i, first + i, 2 * f.f_l);
    }
    gradient[first + 2] = gradient[first + 2] - f.f_w;
    hessian.add(first + 2, first + 2, f.f_ww);
  }
};

template <class Kernel>
TEMPER_INLINE unsigned hessians(const Kernel& kernel, const TriangleLanes& lanes, TriangleHessians& result) {
  using Point = InPlane::Point;
  const Point p = load<InPlane>(lanes.p), q = load<InPlane>(lanes.q), r = load<InPlane>(lanes.r);
  const Spoke<Pack> a = spoke(p, q), b = spoke(p, r);
  const PackShape s = triangle_shape(a, b, q, r);
  const HeightsOfTriangle<Pack> dg = heights_of_triangle(a, b, s.inverse_area);
  AllDerivatives d;
  const PackTerm qr = kernel.term(s.qr);
  d.begin(qr, r.x - q.x, r.y - q.y, dg.qr);
  const PackTerm pq = kernel.term(s.pq);
  d.add(pq, a, dg.pq, 0);
  const PackTerm rp = kernel.term(s.rp);
  d.add(rp, b, dg.rp, 3);
  dg.add_hessian(pq.f_g, qr.f_g, rp.f_g, d.hessian);
  (pq.f + qr.f + rp.f).store(&result.value[0]);
  s.doubled_area.store(&result.doubled_area[0]);
  for (std::size_t i = 0; i < 6; ++i) d.gradient[i].store(&result.gradient[i][0]);
  for (std::size_t i = 0; i < 21; ++i) d.hessian.v[i].store(&result.hessian[i][0]);
  return (is_inside(pq) & is_inside(qr) & is_inside(rp) & (s.doubled_area > kernel.least_area)).bits();
}

unsigned triangle_hessians(const EdgeFormula& formula, const TriangleLanes& triangles, TriangleHessians& result) {
  return with_barrier(formula, [&](const auto& kernel) { return hessians(kernel, triangles, result); });
}

}  // namespace
}  // namespace temper::TEMPER_INSTRUCTION_SET
