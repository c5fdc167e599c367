// The energy of triangles pqr as a function of their corner p, eight triangles at a time: value, gradient, Hessian.
//
// The energy of a triangle is F(pq) + F(qr) + F(rp), each a function of (ℓ², Δw, g). With a = q − p, b = r − p, S twice
// the area: ∇ℓ² = (−2a, 0) and ∇Δw = (0, 0, 1) for pq, and with b for rp; both zero for qr. g_pq = N/S with
// ∇²N = (ℓ_a² + 2 u_b − a·b − 2 u_a) I + a⊗b + b⊗a − 2 a⊗a in x and y, (b − a)/2 with w; S is linear in p; and
// g_qr = S − g_pq − g_rp. The Hessian is gathered by what stands beside I, a⊗a, b⊗b and a⊗b + b⊗a.
#pragma once

#include "energy/lanes.hpp"

namespace temper::TEMPER_INSTRUCTION_SET {

struct PackPoint {
  Pack x, y, w;
};

TEMPER_INLINE PackPoint load(const LanePoints& p) { return {Pack::load(p.x), Pack::load(p.y), Pack::load(p.w)}; }

TEMPER_INLINE Pack::Mask load(const LaneMask& m) { return Pack::Mask::load(m); }

using PackShape = TriangleShapeOf<Pack>;
using PackTerm = EdgeTerm<Pack>;

/// Sums over triangles, lane by lane.
struct StarSums {
  Pack value = Pack::all(0);
  Pack x = Pack::all(0), y = Pack::all(0), w = Pack::all(0);
  Pack xx = Pack::all(0), xy = Pack::all(0), xw = Pack::all(0), yy = Pack::all(0), yw = Pack::all(0), ww = Pack::all(0);
};

/// The terms of the three edges, and the gradients of their heights.
struct TriangleTerms {
  PackShape shape;
  TriangleVectors<Pack> v;
  PackTerm pq, qr, rp;
};

/// An edge at p, with what its two triangles have in common.
template <class Kernel>
struct SpokeOf {
  Spoke<Pack> to;
  typename Kernel::template Base<Pack> base;
};

template <class Kernel>
TEMPER_INLINE SpokeOf<Kernel> spoke_of(const Kernel& kernel, const PackPoint& p, const PackPoint& q) {
  const Spoke<Pack> to = spoke(p, q);
  return {to, kernel.base(to.l2, to.dw)};
}

template <class Kernel>
TEMPER_INLINE TriangleTerms triangle_terms(const Kernel& kernel, const SpokeOf<Kernel>& a, const SpokeOf<Kernel>& b,
                                           const PackPoint& q, const PackPoint& r) {
  TriangleTerms t;
  t.shape = triangle_shape(a.to, b.to, q, r, t.v);
  t.pq = kernel.term(a.base, t.shape.pq.g);
  t.qr = kernel.term(t.shape.qr);
  t.rp = kernel.term(b.base, t.shape.rp.g);
  return t;
}

/// Adds gradient and Hessian of the terms where `where` is set.
template <class Mask>
TEMPER_INLINE void add_derivatives(const TriangleTerms& t, Mask where, StarSums& sum) {
  const auto& [ax, ay, bx, by, la, lb, ab, ua, ub, inverse_s] = t.v;
  const PackTerm &a = t.pq, &b = t.rp, &c = t.qr;
  const Pack sx = ay - by, sy = bx - ax;  // ∇S
  const Pack& ga = t.shape.pq.g;
  const Pack& gb = t.shape.rp.g;
  const Pack gax = (ub * (-2 * ax) - bx * la + ax * ab + ua * (ax + bx) - ga * sx) * inverse_s;
  const Pack gay = (ub * (-2 * ay) - by * la + ay * ab + ua * (ay + by) - ga * sy) * inverse_s;
  const Pack gaw = 0.5 * (la - ab) * inverse_s;
  const Pack gbx = (ua * (-2 * bx) - ax * lb + bx * ab + ub * (ax + bx) - gb * sx) * inverse_s;
  const Pack gby = (ua * (-2 * by) - ay * lb + by * ab + ub * (ay + by) - gb * sy) * inverse_s;
  const Pack gbw = 0.5 * (lb - ab) * inverse_s;
  const Pack gcx = sx - gax - gbx, gcy = sy - gay - gby, gcw = -1.0 * (gaw + gbw);

  const Pack fa = a.f_g - c.f_g, fb = b.f_g - c.f_g;
  const auto add = [&](Pack& to, Pack x) { to = to + select(where, x, Pack::all(0)); };
  add(sum.x, fa * gax + fb * gbx + c.f_g * sx - 2 * (a.f_l * ax + b.f_l * bx));
  add(sum.y, fa * gay + fb * gby + c.f_g * sy - 2 * (a.f_l * ay + b.f_l * by));
  add(sum.w, fa * gaw + fb * gbw + a.f_w + b.f_w);

  // From here on over S, where the second derivatives of heights are.
  const Pack ca = fa * inverse_s, cb = fb * inverse_s;
  const Pack ux = ca * gax + cb * gbx, uy = ca * gay + cb * gby, uw = ca * gaw + cb * gbw;
  const Pack i = ca * (la + 2 * (ub - ua) - ab) + cb * (lb + 2 * (ua - ub) - ab) + 2 * (a.f_l + b.f_l);
  const Pack aa = 4 * a.f_ll - 2 * ca, bb = 4 * b.f_ll - 2 * cb, cc = ca + cb;
  // f_gg ∇g⊗∇g − 2 f_lg (a⊗∇g + ∇g⊗a), with n = −2 f_lg a and m = f_gg ∇g + n.
  const Pack na = -2 * a.f_lg, nb = -2 * b.f_lg;
  const Pack nax = na * ax, nay = na * ay, nbx = nb * bx, nby = nb * by;
  const Pack max = a.f_gg * gax + nax, may = a.f_gg * gay + nay, mbx = b.f_gg * gbx + nbx, mby = b.f_gg * gby + nby;
  const Pack cx = c.f_gg * gcx, cy = c.f_gg * gcy, cw = c.f_gg * gcw;
  add(sum.xx, i + aa * (ax * ax) + bb * (bx * bx) + 2 * (cc * (ax * bx) - ux * sx) + gax * (max + nax) +
                  gbx * (mbx + nbx) + cx * gcx);
  add(sum.xy, aa * (ax * ay) + bb * (bx * by) + cc * (ax * by + ay * bx) - (ux * sy + uy * sx) +
                  (gay * max + gax * nay) + (gby * mbx + gbx * nby) + cx * gcy);
  add(sum.yy, i + aa * (ay * ay) + bb * (by * by) + 2 * (cc * (ay * by) - uy * sy) + gay * (may + nay) +
                  gby * (mby + nby) + cy * gcy);
  const Pack half = 0.5 * (ca - cb), la_w = -2 * a.f_lw, lb_w = -2 * b.f_lw;
  add(sum.xw, half * (bx - ax) - uw * sx + gaw * max + gbw * mbx + a.f_wg * gax + b.f_wg * gbx + la_w * ax + lb_w * bx +
                  cw * gcx);
  add(sum.yw, half * (by - ay) - uw * sy + gaw * may + gbw * mby + a.f_wg * gay + b.f_wg * gby + la_w * ay + lb_w * by +
                  cw * gcy);
  add(sum.ww, a.f_ww + b.f_ww + gaw * (2 * a.f_wg + a.f_gg * gaw) + gbw * (2 * b.f_wg + b.f_gg * gbw) + cw * gcw);
}

/// Adds a barrier. Returns where all is inside its domain: positive and finite terms, S > 0.
template <class Kernel, class Mask>
TEMPER_INLINE Mask add_barrier(const Kernel& kernel, const SpokeOf<Kernel>& a, const SpokeOf<Kernel>& b,
                               const PackPoint& q, const PackPoint& r, Mask where, StarSums& sum) {
  const TriangleTerms t = triangle_terms(kernel, a, b, q, r);
  const auto inside = [](Pack f) { return (f > 0) & (f < kInfinity); };
  const Mask all_inside = inside(t.pq.f) & inside(t.qr.f) & inside(t.rp.f) & (t.shape.doubled_area > 0);
  sum.value = sum.value + select(where, t.pq.f + t.qr.f + t.rp.f, Pack::all(0));
  add_derivatives(t, where, sum);
  return all_inside;
}

/// A term counted `factor` times.
TEMPER_INLINE PackTerm scaled(const PackTerm& t, Pack factor) {
  return {factor * t.f,    factor * t.f_l,  factor * t.f_w,  factor * t.f_g,  factor * t.f_ll,
          factor * t.f_lw, factor * t.f_lg, factor * t.f_ww, factor * t.f_wg, factor * t.f_gg};
}

/// Adds HOT energies, each edge with its factor.
template <class Mask>
TEMPER_INLINE void add_hot(const HotKernel& kernel, const PackPoint& p, const PackPoint& q, const PackPoint& r,
                           Pack factor_pq, Pack factor_qr, Pack factor_rp, Mask where, StarSums& sum) {
  TriangleTerms t = triangle_terms(kernel, spoke_of(kernel, p, q), spoke_of(kernel, p, r), q, r);
  t.pq = scaled(t.pq, factor_pq);
  t.qr = scaled(t.qr, factor_qr);
  t.rp = scaled(t.rp, factor_rp);
  sum.value = sum.value + select(where, t.pq.f + t.qr.f + t.rp.f, Pack::all(0));
  add_derivatives(t, where, sum);
}

/// A barrier's energy of triangles, whatever their orientation. Outside of the domain of an edge it means nothing, and
/// `inside` is clear.
struct TriangleValue {
  Pack value;
  Pack::Mask inside;
};

template <class Kernel>
TEMPER_INLINE TriangleValue triangle_value(const Kernel& kernel, const SpokeOf<Kernel>& a, const SpokeOf<Kernel>& b,
                                           const PackShape& shape) {
  const auto pq = kernel.fraction(a.base, shape.pq.g), rp = kernel.fraction(b.base, shape.rp.g);
  const auto qr = kernel.fraction(kernel.base(shape.qr.l2, shape.qr.dw), shape.qr.g);
  const Pack value = pq.x / pq.y + qr.x / qr.y + rp.x / rp.y;
  return {value, (pq.y > 0) & (qr.y > 0) & (rp.y > 0) & (value < kInfinity)};
}

/// Adds the value alone. Returns where all is inside its domain.
template <class Kernel, class Mask>
TEMPER_INLINE Mask add_barrier_value(const Kernel& kernel, const SpokeOf<Kernel>& a, const SpokeOf<Kernel>& b,
                                     const PackPoint& q, const PackPoint& r, Mask where, Pack& sum) {
  TriangleVectors<Pack> unused;
  const PackShape shape = triangle_shape(a.to, b.to, q, r, unused);
  const TriangleValue triangle = triangle_value(kernel, a, b, shape);
  sum = sum + select(where, triangle.value, Pack::all(0));
  return triangle.inside & (shape.doubled_area > 0);
}

}  // namespace temper::TEMPER_INSTRUCTION_SET
