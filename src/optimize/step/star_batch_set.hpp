// Included by one source for each instruction set, compiled for that set.
#pragma once

#include "energy/star_sums.hpp"
#include "geometry/predicates_inline.hpp"
#include "optimize/step/newton_constants.hpp"
#include "optimize/step/search.hpp"
#include "optimize/step/star_batch.hpp"

namespace temper::TEMPER_INSTRUCTION_SET {
namespace {

using Mask = Pack::Mask;

TEMPER_INLINE Mask has_triangle(const Pack& triangles, std::size_t i) { return triangles > static_cast<double>(i); }
TEMPER_INLINE Pack larger(Pack a, Pack b) { return select(a > b, a, b); }

/// Value, gradient and Hessian of all stars, and the squares of their radii.
struct Derivatives {
  StarSums sums;
  Pack squared_radius;
  Mask feasible;
};

template <class Kernel>
TEMPER_INLINE Derivatives derivatives(const Kernel& kernel, const StarBatch& batch, const PackPoint& p) {
  const Pack triangles = Pack::load(batch.triangles);
  const Mask open = load(batch.open);
  Derivatives d;
  Pack squares = Pack::all(0);
  Mask outside = triangles < 0;
  PackPoint q = load(batch.link[0]);
  SpokeOf<Kernel> a = spoke_of(kernel, p, q);
  for (std::size_t i = 0; i < batch.most_triangles; ++i) {
    const PackPoint r = load(batch.link[i + 1]);
    const SpokeOf<Kernel> b = spoke_of(kernel, p, r);
    const Mask here = has_triangle(triangles, i);
    outside = outside | (here & ~add_barrier(kernel, a, b, q, r, here, d.sums));
    squares = squares + select(here, a.to.l2, Pack::all(0));
    const Mask last = open & here & ~has_triangle(triangles, i + 1);
    squares = squares + select(last, b.to.l2, Pack::all(0));
    q = r;
    a = b;
  }
  d.squared_radius = squares / (triangles + select(open, Pack::all(1), Pack::all(0)));
  d.feasible = ~outside;
  return d;
}

struct PackStep {
  Pack x, y, w;
  Pack predicted;  ///< twice the decrease of the quadratic model
  Mask definite;   ///< the Hessian is: elsewhere this is no step
};

/// newton_step of optimize/step/newton.hpp, for a positive definite Hessian.
TEMPER_INLINE PackStep newton_step(const Derivatives& d, Mask moves, Mask weighs) {
  const Pack zero = Pack::all(0), r2 = d.squared_radius, r = square_root(r2);
  const StarSums& s = d.sums;
  const Mask both = moves & weighs;
  // Scaled by (R, R, R²). What is no unknown gets the curvature of what is, and no slope.
  Pack xx = s.xx * r2, yy = s.yy * r2, ww = s.ww * (r2 * r2);
  const Pack xy = select(moves, s.xy * r2, zero);
  const Pack xw = select(both, s.xw * (r * r2), zero), yw = select(both, s.yw * (r * r2), zero);
  xx = select(moves, xx, ww), yy = select(moves, yy, ww), ww = select(weighs, ww, xx);
  const Pack gx = select(moves, -s.x * r, zero), gy = select(moves, -s.y * r, zero);
  const Pack gw = select(weighs, -s.w * r2, zero);

  // LDLᵀ.
  const Pack floor = kEigenvalueFloor * larger(larger(absolute(xx), absolute(yy)), absolute(ww));
  const Pack inverse_0 = 1.0 / xx;
  const Pack l10 = xy * inverse_0, l20 = xw * inverse_0;
  const Pack pivot_1 = yy - l10 * xy, inverse_1 = 1.0 / pivot_1;
  const Pack below = yw - l20 * xy;
  const Pack l21 = below * inverse_1;
  const Pack pivot_2 = ww - l20 * xw - l21 * below, inverse_2 = 1.0 / pivot_2;
  const Pack b1 = gy - l10 * gx, b2 = gw - l20 * gx - l21 * b1;
  const Pack w = b2 * inverse_2, y = b1 * inverse_1 - l21 * w, x = gx * inverse_0 - l10 * y - l20 * w;

  const Pack norm2 = x * x + y * y + w * w;
  const Pack shrink = select(norm2 > kTrustRadius * kTrustRadius, kTrustRadius / square_root(norm2), Pack::all(1));
  PackStep step;
  step.predicted = shrink * (x * gx + y * gy + w * gw);
  step.x = shrink * x * r, step.y = shrink * y * r, step.w = shrink * w * r2;
  step.definite = (xx > floor) & (pivot_1 > floor) & (pivot_2 > floor);
  return step;
}

/// inversion_limit of optimize/step/line_search.hpp.
TEMPER_INLINE Pack inversion_limit(const StarBatch& batch, const PackPoint& p, const PackStep& step) {
  const Pack triangles = Pack::load(batch.triangles);
  Pack limit = Pack::all(1);
  PackPoint q = load(batch.link[0]);
  for (std::size_t i = 0; i < batch.most_triangles; ++i) {
    const PackPoint r = load(batch.link[i + 1]);
    const Pack ax = q.x - p.x, ay = q.y - p.y, bx = r.x - p.x, by = r.y - p.y;
    const Pack area = ax * by - ay * bx;
    const Pack slope = step.x * (ay - by) + step.y * (bx - ax);
    const Mask cut = has_triangle(triangles, i) & (area + limit * slope < (1 - kInversionFraction) * area);
    limit = select(cut, -kInversionFraction * area / slope, limit);
    q = r;
  }
  return limit;
}

/// The energy of all stars with their centers at p; `certain`: in the domain, and no triangle is inverted there.
struct Trial {
  Pack value;
  Mask feasible, certain;
};

template <class Kernel>
TEMPER_INLINE Trial energy_at(const Kernel& kernel, const StarBatch& batch, const PackPoint& p) {
  const Pack triangles = Pack::load(batch.triangles);
  Trial trial = {Pack::all(0), {}, {}};
  Mask outside = triangles < 0, uncertain = outside;
  PackPoint q = load(batch.link[0]);
  SpokeOf<Kernel> a = spoke_of(kernel, p, q);
  for (std::size_t i = 0; i < batch.most_triangles; ++i) {
    const PackPoint r = load(batch.link[i + 1]);
    const SpokeOf<Kernel> b = spoke_of(kernel, p, r);
    const Mask here = has_triangle(triangles, i);
    outside = outside | (here & ~add_barrier_value(kernel, a, b, q, r, here, trial.value));
    const auto [doubled_area, bound] = inlined::filtered_orient2d(q, r, p);
    uncertain = uncertain | (here & ~(doubled_area > bound));
    q = r;
    a = b;
  }
  trial.feasible = ~outside;
  trial.certain = ~uncertain;
  return trial;
}

/// A triangle's heights over a = pq, b = pr and qr are certainly positive: the triangle reaches to its orthocenter and
/// beyond on that side.
struct CertainHeights {
  Mask over_a, over_b, over_qr;
};

/// h ℓ S over pq is N = u_b |a|² − u_a a·b, and so on (geometry/triangle_kernel.hpp). With m = |a|² + |b|² + |w_p −
/// w_q| + |w_p − w_r|, none of its products is larger than m²/2, nor is S²; 35 roundings at most lie on the way to the
/// last of the three, S² − N_a − N_b.
TEMPER_INLINE CertainHeights certain_heights(const Spoke<Pack>& a, const Spoke<Pack>& b) {
  constexpr double kBound = 64 * inlined::kUnitRoundoff;
  const Pack s = a.x * b.y - a.y * b.x, ab = a.x * b.x + a.y * b.y;
  const Pack na = b.u * a.l2 - a.u * ab, nb = a.u * b.l2 - b.u * ab;
  const Pack m = a.l2 + b.l2 + absolute(a.dw) + absolute(b.dw), bound = kBound * (m * m);
  const Mask oriented = s > 0;
  return {oriented & (na > bound), oriented & (nb > bound), oriented & (s * s - na - nb > bound)};
}

/// The lanes where all spokes and link edges that may flip are certainly regular with the centers at p. An edge is
/// whose two heights are positive; where they are not, the power test decides.
TEMPER_INLINE Mask regular_at(const StarBatch& batch, const PackPoint& p) {
  const Pack triangles = Pack::load(batch.triangles);
  Mask flips = triangles < 0;
  const auto tested = [](const PackPoint& a, const PackPoint& b, const PackPoint& c, const PackPoint& d) {
    const auto [determinant, bound] = inlined::filtered_power_test(a, b, c, d);
    return determinant < -bound;
  };
  // The point before q_0 on a closed link: q_{n−1}, different from lane to lane.
  PackPoint before = load(batch.link[0]), q = before;
  for (std::size_t i = 1; i < batch.most_triangles; ++i) {
    const Mask last = has_triangle(triangles, i) & ~has_triangle(triangles, i + 1);
    const PackPoint here = load(batch.link[i]);
    before = {select(last, here.x, before.x), select(last, here.y, before.y), select(last, here.w, before.w)};
  }
  Spoke<Pack> a = spoke(p, q);
  Mask over_a_before = certain_heights(spoke(p, before), a).over_b;
  for (std::size_t i = 0; i < batch.most_triangles; ++i) {
    const PackPoint r = load(batch.link[i + 1]), o = load(batch.across[i]);
    const Spoke<Pack> b = spoke(p, r);
    const CertainHeights heights = certain_heights(a, b);
    const Mask here = has_triangle(triangles, i);
    const Mask link =
        load(batch.link_flips[i]) & here & ~(heights.over_qr & certain_heights(spoke(q, o), spoke(q, r)).over_b);
    const Mask spokes = load(batch.spoke_flips[i]) & here & ~(heights.over_a & over_a_before);
    if ((link | spokes).bits() != 0) flips = flips | (spokes & ~tested(p, q, r, before)) | (link & ~tested(q, r, p, o));
    before = q;
    q = r;
    a = b;
    over_a_before = heights.over_b;
  }
  return ~flips;
}

TEMPER_INLINE void store(const PackPoint& p, LanePoints& to) {
  p.x.store(to.x);
  p.y.store(to.y);
  p.w.store(to.w);
}

/// VertexStep::newton_search.
template <class Kernel>
TEMPER_INLINE StepOutcome step(const Kernel& kernel, const StepParameters& parameters, StarBatch& batch) {
  const PackPoint p = load(batch.p);
  const Mask moves = load(batch.moves), weighs = load(batch.weighs);
  const Derivatives d = derivatives(kernel, batch, p);
  const PackStep newton = newton_step(d, moves, weighs);
  const Mask usable = d.feasible & newton.definite & (moves | weighs);
  const double relaxation = parameters.relaxation;
  const PackStep step = {relaxation * newton.x, relaxation * newton.y, relaxation * newton.w, {}, {}};
  Pack t = inversion_limit(batch, p, step);

  const Pack cx = Pack::all(parameters.center_x), cy = Pack::all(parameters.center_y);
  PackPoint to = p;
  Pack after = d.sums.value;
  Mask searching = usable & (newton.predicted > kNoGain * absolute(d.sums.value));
  Mask stepped = searching & ~searching, uncertain = stepped;
  for (int trial = 0; trial < kTrials && searching.bits() != 0; ++trial) {
    const PackPoint there = {select(moves, (p.x + t * step.x + cx) - cx, p.x),
                             select(moves, (p.y + t * step.y + cy) - cy, p.y), p.w + t * step.w};
    const Trial e = energy_at(kernel, batch, there);
    const Mask lower = searching & e.feasible & (e.value < d.sums.value);
    to = {select(lower, there.x, to.x), select(lower, there.y, to.y), select(lower, there.w, to.w)};
    after = select(lower, e.value, after);
    stepped = stepped | lower;
    uncertain = uncertain | (lower & ~e.certain);
    searching = searching & ~lower;
    t = (trial == 0 && relaxation > 1 ? 1 / relaxation : 0.5) * t;
  }
  store(to, batch.to);
  d.sums.value.store(batch.before);
  after.store(batch.after);
  const unsigned used = (1U << batch.lanes) - 1;
  const unsigned alone = (uncertain | ~usable).bits() & (moves | weighs).bits() & used;
  const unsigned done = stepped.bits() & ~alone & used;
  return {done, done != 0 ? regular_at(batch, to).bits() & done : 0, alone};
}

}  // namespace

StepOutcome step_batch(const StepParameters& parameters, StarBatch& batch) {
  return with_barrier(parameters.formula, [&](const auto& kernel) { return step(kernel, parameters, batch); });
}

}  // namespace temper::TEMPER_INSTRUCTION_SET
