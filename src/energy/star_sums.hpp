// The energy of triangles pqr as a function of their corner p, eight triangles at a time: value, gradient, Hessian.
//
// The energy of a triangle is F(pq) + F(qr) + F(rp), each a function of (ℓ², Δw, g): the chain rule, with the
// derivatives of g from geometry/height_derivatives.hpp. With a = q − p, ∇ℓ² = (−2a, 0) and ∇Δw = (0, 0, 1) for pq, and
// with b = r − p for rp; both are zero for qr.
#pragma once

#include "energy/lanes.hpp"
#include "geometry/height_derivatives.hpp"

namespace temper::TEMPER_INSTRUCTION_SET {

using PackPoint = PointOf<Pack>;

TEMPER_INLINE PackPoint load(const LanePoints& p) { return {Pack::load(p.x), Pack::load(p.y), Pack::load(p.w)}; }

TEMPER_INLINE Pack::Mask load(const LaneMask& m) { return Pack::Mask::load(m); }

using PackShape = TriangleShapeOf<Pack>;
using PackTerm = EdgeTerm<Pack>;

/// Sums over triangles, lane by lane.
struct StarSums {
  Pack value = {};
  CornerDerivatives<Pack> derivatives = {};
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

/// Gradient and Hessian of one triangle, edge by edge, so that little has to be kept at a time.
struct TriangleDerivatives {
  HeightsAtCorner<Pack> g;
  CornerVector<Pack> gradient;
  CornerMatrix<Pack> hessian;

  /// The edge qr, which comes first: only its g changes.
  TEMPER_INLINE void begin(const PackTerm& f) {
    gradient = f.f_g * g.qr;
    hessian = CornerMatrix<Pack>::product(g.qr, f.f_gg * g.qr);
  }
  /// The edge at p to which `to` leads.
  TEMPER_INLINE void add(const PackTerm& f, const Spoke<Pack>& to, const CornerVector<Pack>& dg) {
    const PlaneVector<Pack> dl = {-2 * to.x, -2 * to.y};
    gradient = gradient + CornerVector<Pack>{f.f_l * dl.x, f.f_l * dl.y, f.f_w} + f.f_g * dg;
    hessian.add(dl, CornerVector<Pack>{f.f_ll * dl.x, f.f_ll * dl.y, f.f_lw} + f.f_lg * dg);
    hessian.add(dg, CornerVector<Pack>{f.f_lg * dl.x, f.f_lg * dl.y, f.f_wg} + f.f_gg * dg);
    hessian.ww = hessian.ww + (f.f_wg * dg.w + f.f_ww);
    hessian.add_in_plane(2 * f.f_l);
  }
  /// The derivatives of 4 F/S² from those of F, with m = ∇S; S is linear in p:
  ///
  ///   4/S² (∇F − 2 F m/S)      4/S² (∇²F − 2 (∇F⊗m + m⊗∇F)/S + 6 F m⊗m/S²)
  TEMPER_INLINE void divide_by_area2(const Pack& f, const PlaneVector<Pack>& m, const Pack& inverse_area) {
    const Pack factor = 4.0 * (inverse_area * inverse_area);
    const PlaneVector<Pack> u = {-2.0 * inverse_area * m.x, -2.0 * inverse_area * m.y};
    hessian.add(u, gradient);  // the upper half of u⊗∇F …
    const PlaneVector<Pack> slope = {gradient.x, gradient.y};
    const Pack f_u = 1.5 * f;
    hessian.add(slope, {u.x, u.y, Pack::all(0)});  // … and of ∇F⊗u
    hessian.add(u, {f_u * u.x, f_u * u.y, Pack::all(0)});
    gradient = gradient + f * CornerVector<Pack>{u.x, u.y, Pack::all(0)};
    gradient = factor * gradient;
    for (Pack* h : {&hessian.xx, &hessian.xy, &hessian.xw, &hessian.yy, &hessian.yw, &hessian.ww}) *h = factor * *h;
  }
};

/// Adds a triangle where `where` is set. The terms of its edges are asked for one after the other. With `over_area2`
/// all of it is divided by the squared area.
template <class Mask, class OfQr, class OfPq, class OfRp>
TEMPER_INLINE void add_triangle(const Spoke<Pack>& a, const Spoke<Pack>& b, const PackShape& shape, Mask where,
                                OfQr&& of_qr, OfPq&& of_pq, OfRp&& of_rp, StarSums& sum, bool over_area2 = false) {
  TriangleDerivatives d;
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
    d.divide_by_area2(value, {a.y - b.y, b.x - a.x}, shape.inverse_area);
    value = 4.0 * (shape.inverse_area * shape.inverse_area) * value;
  }
  sum.value = sum.value + select(where, value, Pack::all(0));
  sum.derivatives.add(where, d.gradient, d.hessian);
}

/// The lanes where the term of a barrier is inside its domain: positive and finite.
TEMPER_INLINE Pack::Mask is_inside(const PackTerm& t) { return (t.f > 0) & (t.f < kInfinity); }

/// Adds a barrier. Returns where all is inside its domain, behind the wall if it has one.
template <class Kernel, class Mask>
TEMPER_INLINE Mask add_barrier(const Kernel& kernel, const SpokeOf<Kernel>& a, const SpokeOf<Kernel>& b,
                               const PackPoint& q, const PackPoint& r, Mask where, StarSums& sum) {
  const PackShape s = triangle_shape(a.to, b.to, q, r);
  Mask inside = s.doubled_area > kernel.least_area;
  const auto checked = [&inside](const PackTerm& t) {
    inside = inside & is_inside(t);
    return t;
  };
  add_triangle(
      a.to, b.to, s, where, [&] { return checked(kernel.term(s.qr)); },
      [&] { return checked(kernel.term(a.base, s.pq.g)); }, [&] { return checked(kernel.term(b.base, s.rp.g)); }, sum);
  return inside;
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
  const Spoke<Pack> a = spoke(p, q), b = spoke(p, r);
  const PackShape s = triangle_shape(a, b, q, r);
  add_triangle(
      a, b, s, where, [&] { return scaled(kernel.term(s.qr), factor_qr); },
      [&] { return scaled(kernel.term(s.pq), factor_pq); }, [&] { return scaled(kernel.term(s.rp), factor_rp); }, sum,
      kernel.normalized);
}

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
  const Pack::Mask upright = shape.doubled_area > kernel.least_area;
  return {value, upright & (pq.y > 0) & (qr.y > 0) & (rp.y > 0) & (value < kInfinity)};
}

/// Adds the value alone. Returns where all is inside its domain.
template <class Kernel, class Mask>
TEMPER_INLINE Mask add_barrier_value(const Kernel& kernel, const SpokeOf<Kernel>& a, const SpokeOf<Kernel>& b,
                                     const PackPoint& q, const PackPoint& r, Mask where, Pack& sum) {
  const PackShape shape = triangle_shape(a.to, b.to, q, r);
  const TriangleValue triangle = triangle_value(kernel, a, b, shape);
  sum = sum + select(where, triangle.value, Pack::all(0));
  return triangle.inside;
}

}  // namespace temper::TEMPER_INSTRUCTION_SET
