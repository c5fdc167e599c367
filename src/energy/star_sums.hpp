// The energy of triangles pqr as a function of their corner p, eight triangles at a time: value, gradient, Hessian.
//
// The energy of a triangle is F(pq) + F(qr) + F(rp), each a function of (ℓ², Δw, g). The chain rule uses the
// derivatives of g from geometry/height_derivatives.hpp. Edge pq has a = q − p, ∇ℓ² = (−2a, 0) and ∇Δw = (0, 0, 1).
// Edge rp is likewise with b = r − p; both gradients are zero for qr.
#pragma once

#include "energy/star_kernels.hpp"
#include "geometry/height_derivatives.hpp"

namespace temper::TEMPER_INSTRUCTION_SET {

using InPlane = InPlaneOf<Pack>;
using OnSphere = OnSphereOf<Pack>;

template <class In>
TEMPER_INLINE typename In::Point load(const LanePoints& p) {
  return {Pack::load(p.x), Pack::load(p.y), Pack::load(p.w)};
}

TEMPER_INLINE Pack::Mask load(const LaneMask& m) { return Pack::Mask::load(m); }

using PackShape = TriangleShapeOf<Pack>;
using PackTerm = EdgeTerm<Pack>;

/// Sums over triangles, lane by lane.
struct StarSums {
  Pack value = {};
  CornerDerivatives<Pack> derivatives = {};
};

/// An edge at p, with what its two triangles have in common.
template <class In, class Kernel>
struct SpokeOf {
  typename In::Spoke to;
  typename Kernel::template Base<Pack> base;
};

template <class In, class Kernel>
TEMPER_INLINE SpokeOf<In, Kernel> spoke_of(const Kernel& kernel, const typename In::Center& p,
                                           const typename In::Point& q) {
  const typename In::Spoke to = spoke(p, q);
  return {to, kernel.base(to.l2, to.dw)};
}

/// Gradient and Hessian of one triangle, edge by edge, so that few numbers are kept at a time.
template <class In>
struct TriangleDerivatives {
  typename In::Heights g;
  CornerVector<Pack> gradient;
  CornerMatrix<Pack> hessian;

  /// The edge qr, which comes first: only its g changes.
  TEMPER_INLINE void begin(const PackTerm& f) {
    gradient = f.f_g * g.qr;
    hessian = CornerMatrix<Pack>::product(g.qr, f.f_gg * g.qr);
  }
  /// The edge at p to which `to` leads.
  TEMPER_INLINE void add(const PackTerm& f, const typename In::Spoke& to, const CornerVector<Pack>& dg) {
    const auto dl = gradient_of_l2(to);
    gradient = gradient + by_l2_and_dw(f.f_l, dl, f.f_w) + f.f_g * dg;
    hessian.add(dl, by_l2_and_dw(f.f_ll, dl, f.f_lw) + f.f_lg * dg);
    hessian.add(dg, by_l2_and_dw(f.f_lg, dl, f.f_wg) + f.f_gg * dg);
    hessian.ww = hessian.ww + along_w(f.f_lw, dl, f.f_wg * dg.w + f.f_ww);
    add_curvature(to, f.f_l, f.f_w, hessian);
  }
  /// The derivatives of 4 F/S², by the derivatives of F and m = ∇S. In the plane ∇²S = 0, on the sphere ∇²S = κ n̂⊗n̂.
  ///
  ///   4/S² (∇F − 2 F m/S)      4/S² (∇²F − 2 (∇F⊗m + m⊗∇F)/S + 6 F m⊗m/S² − 2 F ∇²S/S)
  TEMPER_INLINE void divide_by_area2(const Pack& f, const SphereSpoke<Pack>&, const SphereSpoke<Pack>&,
                                     const Pack& inverse_area) {
    const CornerVector<Pack> u = -2.0 * inverse_area * g.area;
    hessian.add(u, gradient + (1.5 * f) * u);
    hessian.add(gradient, u);
    hessian.add(g.normal, (-2.0 * f * inverse_area * g.kappa) * g.normal);
    gradient = gradient + f * u;
    scale(4.0 * (inverse_area * inverse_area));
  }
  TEMPER_INLINE void divide_by_area2(const Pack& f, const Spoke<Pack>& a, const Spoke<Pack>& b,
                                     const Pack& inverse_area) {
    const PlaneVector<Pack> m = {a.y - b.y, b.x - a.x};
    const PlaneVector<Pack> u = {-2.0 * inverse_area * m.x, -2.0 * inverse_area * m.y};
    hessian.add(u, gradient);  // the upper half of u⊗∇F …
    const PlaneVector<Pack> slope = {gradient.x, gradient.y};
    const Pack f_u = 1.5 * f;
    hessian.add(slope, {u.x, u.y, Pack::all(0)});  // … and of ∇F⊗u
    hessian.add(u, {f_u * u.x, f_u * u.y, Pack::all(0)});
    gradient = gradient + f * CornerVector<Pack>{u.x, u.y, Pack::all(0)};
    scale(4.0 * (inverse_area * inverse_area));
  }
  TEMPER_INLINE void scale(const Pack& factor) {
    gradient = factor * gradient;
    for (Pack* h : {&hessian.xx, &hessian.xy, &hessian.xw, &hessian.yy, &hessian.yw, &hessian.ww}) *h = factor * *h;
  }
};

/// Adds a triangle where `where` is set. The terms of its edges are evaluated one after the other. With `over_area2`
/// all of it is divided by the squared area.
template <class In, class Mask, class OfQr, class OfPq, class OfRp>
TEMPER_INLINE void add_triangle(const typename In::Spoke& a, const typename In::Spoke& b, const PackShape& shape,
                                Mask where, OfQr&& of_qr, OfPq&& of_pq, OfRp&& of_rp, StarSums& sum,
                                bool over_area2 = false) {
  TriangleDerivatives<In> d;
  d.g = heights_at_corner(a, b, shape.inverse_area);
  const PackTerm qr = of_qr();
  d.begin(qr);
  const PackTerm pq = of_pq();
  d.add(pq, a, d.g.pq);
  const PackTerm rp = of_rp();
  d.add(rp, b, d.g.rp);
  d.g.add_hessian(pq.f_g, qr.f_g, rp.f_g, d.hessian);
  Pack value = pq.f + qr.f + rp.f;
  if (over_area2) {
    d.divide_by_area2(value, a, b, shape.inverse_area);
    value = 4.0 * (shape.inverse_area * shape.inverse_area) * value;
  }
  sum.value = sum.value + select(where, value, Pack::all(0));
  sum.derivatives.add(where, d.gradient, d.hessian);
}

/// The lanes where the term of a barrier is inside its domain: positive and finite.
TEMPER_INLINE Pack::Mask is_inside(const PackTerm& t) { return (t.f > 0) & (t.f < kInfinity); }

/// Adds a barrier. Returns the lanes where all is inside its domain, behind the wall if it has one.
template <class In, class Kernel, class Mask>
TEMPER_INLINE Mask add_barrier(const Kernel& kernel, const SpokeOf<In, Kernel>& a, const SpokeOf<In, Kernel>& b,
                               const typename In::Point& q, const typename In::Point& r, Mask where, StarSums& sum) {
  const PackShape s = triangle_shape(a.to, b.to, q, r);
  Mask inside = s.doubled_area > kernel.least_area;
  const auto checked = [&inside](const PackTerm& t) {
    inside = inside & is_inside(t);
    return t;
  };
  add_triangle<In>(
      a.to, b.to, s, where, [&] { return checked(kernel.term(s.qr)); },
      [&] { return checked(kernel.term(a.base, s.pq.g)); }, [&] { return checked(kernel.term(b.base, s.rp.g)); }, sum);
  return inside;
}

/// A term times a factor.
TEMPER_INLINE PackTerm scaled(const PackTerm& t, Pack factor) {
  return {factor * t.f,    factor * t.f_l,  factor * t.f_w,  factor * t.f_g,  factor * t.f_ll,
          factor * t.f_lw, factor * t.f_lg, factor * t.f_ww, factor * t.f_wg, factor * t.f_gg};
}

/// Adds HOT energies, each edge with its factor.
template <class In, class Mask>
TEMPER_INLINE void add_hot(const HotKernel& kernel, const typename In::Center& p, const typename In::Point& q,
                           const typename In::Point& r, Pack factor_pq, Pack factor_qr, Pack factor_rp, Mask where,
                           StarSums& sum) {
  const typename In::Spoke a = spoke(p, q), b = spoke(p, r);
  const PackShape s = triangle_shape(a, b, q, r);
  add_triangle<In>(
      a, b, s, where, [&] { return scaled(kernel.term(s.qr), factor_qr); },
      [&] { return scaled(kernel.term(s.pq), factor_pq); }, [&] { return scaled(kernel.term(s.rp), factor_rp); }, sum,
      kernel.normalized);
}

struct TriangleValue {
  Pack value;
  Pack::Mask inside;
};

template <class In, class Kernel>
TEMPER_INLINE TriangleValue triangle_value(const Kernel& kernel, const SpokeOf<In, Kernel>& a,
                                           const SpokeOf<In, Kernel>& b, const PackShape& shape) {
  const auto pq = kernel.fraction(a.base, shape.pq.g), rp = kernel.fraction(b.base, shape.rp.g);
  const auto qr = kernel.fraction(kernel.base(shape.qr.l2, shape.qr.dw), shape.qr.g);
  const Pack value = pq.x / pq.y + qr.x / qr.y + rp.x / rp.y;
  const Pack::Mask upright = shape.doubled_area > kernel.least_area;
  return {value, upright & (pq.y > 0) & (qr.y > 0) & (rp.y > 0) & (value < kInfinity)};
}

/// Adds the value alone. Returns the lanes where all is inside its domain.
template <class In, class Kernel, class Mask>
TEMPER_INLINE Mask add_barrier_value(const Kernel& kernel, const SpokeOf<In, Kernel>& a, const SpokeOf<In, Kernel>& b,
                                     const typename In::Point& q, const typename In::Point& r, Mask where, Pack& sum) {
  const PackShape shape = triangle_shape(a.to, b.to, q, r);
  const TriangleValue triangle = triangle_value(kernel, a, b, shape);
  sum = sum + select(where, triangle.value, Pack::all(0));
  return triangle.inside;
}

}  // namespace temper::TEMPER_INSTRUCTION_SET
