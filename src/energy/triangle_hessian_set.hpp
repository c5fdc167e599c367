// Included by one source for each instruction set, compiled for that set.
//
// With a = q − p, b = r − p, S = a × b, and u_a, u_b as in geometry/triangle_kernel.hpp, the energy is
//
//   F(|a|², w_a, g_a) + F(|b|², w_b, g_b) + F(|b − a|², w_a − w_b, g_c)
//   g_a = N_a/S,  N_a = u_b |a|² − u_a a·b,    g_b = N_b/S,  N_b = u_a |b|² − u_b a·b,    g_c = S − g_a − g_b
//
// and its Hessian the sum over edges of F″ between the gradients of (ℓ², w, g), and of F_ℓ ∇²ℓ² + F_g ∇²g. What stands
// beside ∇²g_a is k_a = (F_g,a − F_g,c)/S, by S ∇²g_a = ∇²N_a − ∇g_a⊗∇S − ∇S⊗∇g_a − g_a ∇²S, and so for g_b.
#pragma once

#include "energy/star_sums.hpp"
#include "energy/triangle_hessian.hpp"

namespace temper::TEMPER_INSTRUCTION_SET {
namespace {

/// A gradient in u.
struct Pack6 {
  Pack v[6];
  TEMPER_INLINE Pack& operator[](std::size_t i) { return v[i]; }
  TEMPER_INLINE const Pack& operator[](std::size_t i) const { return v[i]; }
};

/// A symmetric matrix in u: its lower triangle.
struct SymmetricPack6 {
  Pack v[21];
  TEMPER_INLINE Pack& operator()(std::size_t i, std::size_t j) {
    return v[i < j ? hessian_entry(j, i) : hessian_entry(i, j)];
  }
  /// x⊗y + y⊗x, where x has just the entries first … first + n − 1. An entry on the diagonal gets both.
  TEMPER_INLINE void add_sum_of_products(const Pack* x, std::size_t first, std::size_t n, const Pack6& y) {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < 6; ++j) {
        const Pack product = x[i] * y[j];
        (*this)(first + i, j) = (*this)(first + i, j) + (j == first + i ? 2 * product : product);
      }
    }
  }
};

/// a and b, and all that depends on them but the terms of the edges.
struct TriangleParts {
  Pack ax, ay, aw, bx, by, bw, cx, cy;
  Pack la, lb, ab, ua, ub, s, inverse_s;
  EdgeShapeOf<Pack> a, b, c;
  Pack6 ds, dga, dgb, dgc;  // ∇S, ∇g
};

TEMPER_INLINE void add_heights(TriangleParts& t) {
  const auto& [ax, ay, aw, bx, by, bw, cx, cy, la, lb, ab, ua, ub, s, inverse_s, a, b, c, ds, dga, dgb, dgc] = t;
  t.ds = {{by, -bx, Pack::all(0), -ay, ax, Pack::all(0)}};
  // ∇N_a, ∇N_b
  const Pack6 na = {{2 * ub * ax - ab * ax - ua * bx, 2 * ub * ay - ab * ay - ua * by, 0.5 * ab, la * bx - ua * ax,
                     la * by - ua * ay, -0.5 * la}};
  const Pack6 nb = {{lb * ax - ub * bx, lb * ay - ub * by, -0.5 * lb, 2 * ua * bx - ab * bx - ub * ax,
                     2 * ua * by - ab * by - ub * ay, 0.5 * ab}};
  for (std::size_t i = 0; i < 6; ++i) {
    t.dga[i] = (na[i] - a.g * ds[i]) * inverse_s;
    t.dgb[i] = (nb[i] - b.g * ds[i]) * inverse_s;
    t.dgc[i] = ds[i] - dga[i] - dgb[i];
  }
}

TEMPER_INLINE TriangleParts triangle_parts(const PackPoint& p, const PackPoint& q, const PackPoint& r) {
  TriangleParts t;
  t.ax = q.x - p.x, t.ay = q.y - p.y, t.aw = q.w - p.w;
  t.bx = r.x - p.x, t.by = r.y - p.y, t.bw = r.w - p.w;
  t.cx = r.x - q.x, t.cy = r.y - q.y;
  t.s = t.ax * t.by - t.ay * t.bx, t.inverse_s = 1.0 / t.s;
  t.la = t.ax * t.ax + t.ay * t.ay, t.lb = t.bx * t.bx + t.by * t.by, t.ab = t.ax * t.bx + t.ay * t.by;
  t.ua = 0.5 * (t.la - t.aw), t.ub = 0.5 * (t.lb - t.bw);
  t.a = {t.la, t.aw, (t.ub * t.la - t.ua * t.ab) * t.inverse_s};
  t.b = {t.lb, t.bw, (t.ua * t.lb - t.ub * t.ab) * t.inverse_s};
  t.c = {t.cx * t.cx + t.cy * t.cy, t.aw - t.bw, t.s - t.a.g - t.b.g};
  add_heights(t);
  return t;
}

/// Of the three edges.
struct EdgeTerms {
  PackTerm a, b, c;
};

TEMPER_INLINE Pack6 gradient(const TriangleParts& t, const EdgeTerms& f) {
  Pack6 g;
  for (std::size_t i = 0; i < 6; ++i) g[i] = f.a.f_g * t.dga[i] + f.b.f_g * t.dgb[i] + f.c.f_g * t.dgc[i];
  g[0] = g[0] + 2 * (f.a.f_l * t.ax - f.c.f_l * t.cx);
  g[1] = g[1] + 2 * (f.a.f_l * t.ay - f.c.f_l * t.cy);
  g[2] = g[2] + f.a.f_w + f.c.f_w;
  g[3] = g[3] + 2 * (f.b.f_l * t.bx + f.c.f_l * t.cx);
  g[4] = g[4] + 2 * (f.b.f_l * t.by + f.c.f_l * t.cy);
  g[5] = g[5] + f.b.f_w - f.c.f_w;
  return g;
}

/// F″ of pq or rp between its gradients: ∇ℓ² = 2 (x, y) and ∇w = 1 stand at `first`.
TEMPER_INLINE void add_spoke(const PackTerm& f, Pack x, Pack y, const Pack6& dg, std::size_t first, SymmetricPack6& h) {
  const Pack dl[2] = {2 * x, 2 * y};
  const Pack beside_dg[3] = {f.f_lg * dl[0], f.f_lg * dl[1], f.f_wg};
  h.add_sum_of_products(beside_dg, first, 3, dg);
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j <= i; ++j) h(first + i, first + j) = h(first + i, first + j) + f.f_ll * dl[i] * dl[j];
    h(first + 2, first + i) = h(first + 2, first + i) + f.f_lw * dl[i];
    h(first + i, first + i) = h(first + i, first + i) + 2 * f.f_l;
  }
  h(first + 2, first + 2) = h(first + 2, first + 2) + f.f_ww;
}

/// F″ of qr, whose ∇ℓ² is 2 (−c, c) and ∇w (1, −1), and F_ℓ ∇²ℓ².
TEMPER_INLINE void add_far_edge(const PackTerm& f, const TriangleParts& t, SymmetricPack6& h) {
  const Pack x = 2 * t.cx, y = 2 * t.cy, zero = Pack::all(0);
  const Pack6 dl = {{-x, -y, zero, x, y, zero}};
  Pack6 of_l;  // f_ll/2 ∇ℓ² + f_lg ∇g, so that ∇ℓ²⊗of_l + of_l⊗∇ℓ² has both parts, and with ∇w
  for (std::size_t i = 0; i < 6; ++i) of_l[i] = 0.5 * f.f_ll * dl[i] + f.f_lg * t.dgc[i];
  h.add_sum_of_products(dl.v, 0, 2, of_l);
  h.add_sum_of_products(dl.v + 3, 3, 2, of_l);
  Pack6 of_w;  // the same with f_ww/2 ∇w + f_wg ∇g + f_lw ∇ℓ²
  for (std::size_t i = 0; i < 6; ++i) of_w[i] = f.f_wg * t.dgc[i] + f.f_lw * dl[i];
  of_w[2] = of_w[2] + 0.5 * f.f_ww;
  of_w[5] = of_w[5] - 0.5 * f.f_ww;
  const Pack one = Pack::all(1), minus_one = Pack::all(-1);
  h.add_sum_of_products(&one, 2, 1, of_w);
  h.add_sum_of_products(&minus_one, 5, 1, of_w);
  for (std::size_t i = 0; i < 2; ++i) {
    h(i, i) = h(i, i) + 2 * f.f_l;
    h(3 + i, 3 + i) = h(3 + i, 3 + i) + 2 * f.f_l;
    h(3 + i, i) = h(3 + i, i) - 2 * f.f_l;
  }
}

/// k_a ∇²N_a + k_b ∇²N_b. With N_a = u_b |a|² − u_a a·b: ∇²N_a is ∇|a|² ∇u_b − ∇u_a ∇(a·b), symmetrised, and
/// u_b ∇²|a|² + |a|² ∇²u_b − a·b ∇²u_a − u_a ∇²(a·b).
TEMPER_INLINE void add_numerators(const TriangleParts& t, Pack ka, Pack kb, SymmetricPack6& h) {
  const Pack zero = Pack::all(0), minus_half = Pack::all(-0.5);
  const Pack dua[3] = {t.ax, t.ay, minus_half}, dub[3] = {t.bx, t.by, minus_half};
  Pack6 of_ua, of_ub;  // what is beside ∇u_a: k_b ∇|b|² − k_a ∇(a·b), and beside ∇u_b
  const Pack dab[6] = {t.bx, t.by, zero, t.ax, t.ay, zero};
  for (std::size_t i = 0; i < 6; ++i) of_ua[i] = -ka * dab[i], of_ub[i] = -kb * dab[i];
  of_ua[3] = of_ua[3] + 2 * kb * t.bx, of_ua[4] = of_ua[4] + 2 * kb * t.by;
  of_ub[0] = of_ub[0] + 2 * ka * t.ax, of_ub[1] = of_ub[1] + 2 * ka * t.ay;
  h.add_sum_of_products(dua, 0, 3, of_ua);
  h.add_sum_of_products(dub, 3, 3, of_ub);
  const Pack aa = ka * (2 * t.ub - t.ab) + kb * t.lb, bb = kb * (2 * t.ua - t.ab) + ka * t.la;
  const Pack ab = ka * t.ua + kb * t.ub;
  for (std::size_t i = 0; i < 2; ++i) {
    h(i, i) = h(i, i) + aa;
    h(3 + i, 3 + i) = h(3 + i, 3 + i) + bb;
    h(3 + i, i) = h(3 + i, i) - ab;
  }
}

TEMPER_INLINE SymmetricPack6 hessian(const TriangleParts& t, const EdgeTerms& f) {
  const Pack ka = (f.a.f_g - f.c.f_g) * t.inverse_s, kb = (f.b.f_g - f.c.f_g) * t.inverse_s;
  SymmetricPack6 h;
  Pack6 beside_ds;  // −k_a ∇g_a − k_b ∇g_b
  for (std::size_t i = 0; i < 6; ++i) beside_ds[i] = -(ka * t.dga[i] + kb * t.dgb[i]);
  for (std::size_t i = 0; i < 6; ++i) {
    const Pack a = f.a.f_gg * t.dga[i], b = f.b.f_gg * t.dgb[i], c = f.c.f_gg * t.dgc[i];
    for (std::size_t j = 0; j <= i; ++j) {
      h(i, j) = a * t.dga[j] + b * t.dgb[j] + c * t.dgc[j] + beside_ds[i] * t.ds[j] + t.ds[i] * beside_ds[j];
    }
  }
  const Pack ks = f.c.f_g - ka * t.a.g - kb * t.b.g;  // beside ∇²S
  h(4, 0) = h(4, 0) + ks;
  h(3, 1) = h(3, 1) - ks;
  add_spoke(f.a, t.ax, t.ay, t.dga, 0, h);
  add_spoke(f.b, t.bx, t.by, t.dgb, 3, h);
  add_far_edge(f.c, t, h);
  add_numerators(t, ka, kb, h);
  return h;
}

template <class Kernel>
TEMPER_INLINE unsigned hessians(const Kernel& kernel, const TriangleLanes& lanes, TriangleHessians& result) {
  const TriangleParts t = triangle_parts(load(lanes.p), load(lanes.q), load(lanes.r));
  const EdgeTerms f = {kernel.term(t.a), kernel.term(t.b), kernel.term(t.c)};
  (f.a.f + f.c.f + f.b.f).store(&result.value[0]);
  t.s.store(&result.doubled_area[0]);
  const Pack6 g = gradient(t, f);
  for (std::size_t i = 0; i < 6; ++i) g[i].store(&result.gradient[i][0]);
  const SymmetricPack6 h = hessian(t, f);
  for (std::size_t i = 0; i < 21; ++i) h.v[i].store(&result.hessian[i][0]);
  const auto inside = [](Pack x) { return (x > 0) & (x < kInfinity); };
  return (inside(f.a.f) & inside(f.b.f) & inside(f.c.f) & (t.s > 0)).bits();
}

}  // namespace

unsigned triangle_hessians(const EdgeFormula& formula, const TriangleLanes& triangles, TriangleHessians& result) {
  return with_barrier(formula, [&](const auto& kernel) { return hessians(kernel, triangles, result); });
}

}  // namespace temper::TEMPER_INSTRUCTION_SET
