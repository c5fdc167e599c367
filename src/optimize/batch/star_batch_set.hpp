// One source per instruction set includes this file, and is compiled for that set.
#pragma once

#include "energy/accuracy_star.hpp"
#include "energy/star_sums.hpp"
#include "geometry/predicates_inline.hpp"
#include "optimize/batch/star_batch.hpp"
#include "optimize/step/search.hpp"

namespace temper::TEMPER_INSTRUCTION_SET {
namespace {

using Mask = Pack::Mask;

TEMPER_INLINE Mask has_triangle(const Pack& triangles, std::size_t i) { return triangles > static_cast<double>(i); }

/// Value, gradient and Hessian of all stars, and the squares of their radii.
struct Derivatives {
  StarSums sums;
  Pack squared_radius;
  Mask feasible;
};

/// Calls visit(i, here, a, b, q, r) for triangle i of all stars with their centers at p. `here` are the lanes that have
/// this triangle, a = pq and b = pr are its spokes, and qr is its link edge.
template <class In, class Kernel, class Visit>
TEMPER_INLINE void for_triangles(const Kernel& kernel, const StarBatch& batch, const typename In::Center& p,
                                 Visit visit) {
  const Pack triangles = Pack::load(batch.triangles);
  typename In::Point q = load<In>(batch.link[0]);
  SpokeOf<In, Kernel> a = spoke_of<In>(kernel, p, q);
  for (std::size_t i = 0; i < batch.most_triangles; ++i) {
    const typename In::Point r = load<In>(batch.link[i + 1]);
    const SpokeOf<In, Kernel> b = spoke_of<In>(kernel, p, r);
    visit(i, has_triangle(triangles, i), a, b, q, r);
    q = r;
    a = b;
  }
}

template <class In, class Kernel>
requires(Kernel::kBarrier) TEMPER_INLINE Derivatives
    derivatives(const Kernel& kernel, const StarBatch& batch, const typename In::Center& p) {
  const Pack triangles = Pack::load(batch.triangles);
  const Mask open = load(batch.open);
  Derivatives d;
  Pack squares = Pack::all(0);
  Mask outside = triangles < 0;
  for_triangles<In>(kernel, batch, p,
                    [&](auto i, Mask here, const auto& a, const auto& b, const auto& q, const auto& r) {
                      outside = outside | (here & ~add_barrier<In>(kernel, a, b, q, r, here, d.sums));
                      squares = squares + select(here, a.to.l2, Pack::all(0));
                      const Mask last = open & here & ~has_triangle(triangles, i + 1);
                      squares = squares + select(last, b.to.l2, Pack::all(0));
                    });
  bend(p, d.sums.derivatives);
  d.squared_radius = squares / (triangles + select(open, Pack::all(1), Pack::all(0)));
  d.feasible = ~outside;
  return d;
}

/// The derivatives of the accuracy energy, with the length of the shortest spoke as the radius.
template <class In>
TEMPER_INLINE Derivatives derivatives(const AccuracyStarOf<In>& star, const StarBatch&, const typename In::Center& p) {
  Derivatives d;
  d.sums.value = accuracy_value(star, p);
  d.feasible = d.sums.value < kInfinity;
  d.sums.derivatives = accuracy_derivatives(star, p);
  d.squared_radius = Pack::all(kInfinity);
  for (std::size_t i = 0; i <= star.most; ++i) {
    const Pack l2 = star.spokes[i].to.l2;
    d.squared_radius = select(star.has_spoke(i) & (l2 < d.squared_radius), l2, d.squared_radius);
  }
  return d;
}

using PackStep = NewtonStepOf<Pack>;

/// The newton_step of optimize/step/descent.hpp, for a positive definite Hessian.
TEMPER_INLINE PackStep newton_step(const Derivatives& d, Mask moves, Mask changes_weight) {
  const Pack zero = Pack::all(0), r2 = d.squared_radius, r = square_root(r2);
  const auto& [gradient, hessian] = d.sums.derivatives;
  const Mask both = moves & changes_weight;
  // Scaled by (R, R, R²). A coordinate that is no unknown gets the curvature of one that is, and no slope.
  const Pack xx = hessian.xx * r2, yy = hessian.yy * r2, ww = hessian.ww * (r2 * r2);
  const CornerMatrix<Pack> h = {
      select(moves, xx, ww), select(moves, hessian.xy * r2, zero),      select(both, hessian.xw * (r * r2), zero),
      select(moves, yy, ww), select(both, hessian.yw * (r * r2), zero), select(changes_weight, ww, xx)};
  const CornerVector<Pack> g = {select(moves, -gradient.x * r, zero), select(moves, -gradient.y * r, zero),
                                select(changes_weight, -gradient.w * r2, zero)};
  const PackStep step = scaled_newton_step(h, g);
  return {step.x * r, step.y * r, step.w * r2, step.predicted, step.definite};
}

/// The direction from p to q in the plane of steps: direction_to() of geometry/triangle_kernel.hpp.
struct PackDirection {
  Pack x, y;
};
TEMPER_INLINE PackDirection direction_to(const PointOf<Pack>& p, const PointOf<Pack>& q) {
  return {q.x - p.x, q.y - p.y};
}
TEMPER_INLINE PackDirection direction_to(const Chart<Pack>& p, const WeightedVectorOf<Pack>& q) {
  const SphereSpoke<Pack> a = spoke(p, q);
  const Pack projected = a.rho / (a.rho + a.z);
  return {projected * a.x, projected * a.y};
}

/// The inversion_limit of optimize/step/descent.hpp.
template <class In>
TEMPER_INLINE Pack inversion_limit(const StarBatch& batch, const typename In::Center& p, const PackStep& step) {
  const Pack triangles = Pack::load(batch.triangles);
  Pack limit = Pack::all(1);
  PackDirection a = direction_to(p, load<In>(batch.link[0]));
  for (std::size_t i = 0; i < batch.most_triangles; ++i) {
    const PackDirection b = direction_to(p, load<In>(batch.link[i + 1]));
    limit = before_inversion(limit, {a.x, a.y}, {b.x, b.y}, {step.x, step.y}, has_triangle(triangles, i));
    a = b;
  }
  return limit;
}

/// Returns the place after t times a step. In the plane, new positions are rounded to the user's grid.
TEMPER_INLINE PointOf<Pack> moved(const PointOf<Pack>& p, const PackStep& step, const Pack& t, Mask moves,
                                  const StepParameters& parameters) {
  const Pack cx = Pack::all(parameters.rounding_x), cy = Pack::all(parameters.rounding_y);
  return {select(moves, (p.x + t * step.x + cx) - cx, p.x), select(moves, (p.y + t * step.y + cy) - cy, p.y),
          p.w + t * step.w};
}
TEMPER_INLINE WeightedVectorOf<Pack> moved(const Chart<Pack>& p, const PackStep& step, const Pack& t, Mask,
                                           const StepParameters&) {
  return p.moved(t * step.x, t * step.y, t * step.w);
}

/// Returns `there` in lanes in which the mask is set, else `here`.
template <class Point>
TEMPER_INLINE Point select(Mask m, const Point& there, const Point& here) {
  const auto& [x, y, third] = there;
  const auto& [x_here, y_here, third_here] = here;
  return {select(m, x, x_here), select(m, y, y_here), select(m, third, third_here)};
}

/// The energy of all stars with their centers at p. `certain`: p is in the domain and inverts no triangle.
struct Trial {
  Pack value;
  Mask feasible, certain;
};

template <class In, class Kernel>
requires(Kernel::kBarrier) TEMPER_INLINE Trial
    energy_at(const Kernel& kernel, const StarBatch& batch, const typename In::Point& p) {
  Trial trial = {Pack::all(0), {}, {}};
  Mask outside = Pack::load(batch.triangles) < 0, uncertain = outside;
  const typename In::Center center = seen_from(p);
  for_triangles<In>(kernel, batch, center,
                    [&](auto, Mask here, const auto& a, const auto& b, const auto& q, const auto& r) {
                      outside = outside | (here & ~add_barrier_value<In>(kernel, a, b, q, r, here, trial.value));
                      const auto [area, bound] = inlined::filtered_orientation(q, r, p);
                      uncertain = uncertain | (here & ~(area > bound));
                    });
  trial.feasible = ~outside;
  trial.certain = ~uncertain;
  return trial;
}

/// Returns the accuracy energy of all stars with their centers at p. well_centered_at() decides later what is certain.
template <class In>
TEMPER_INLINE Trial energy_at(const AccuracyStarOf<In>& star, const StarBatch&, const typename In::Point& p) {
  const Pack value = accuracy_value(star, seen_from(p));
  return {value, value<kInfinity, value> - kInfinity};
}

/// The lanes in which a triangle's heights over a = pq, b = pr and qr are certainly positive: on that side the triangle
/// reaches beyond its orthocenter.
struct CertainHeights {
  Mask over_a, over_b, over_qr;
};

/// h ℓ S over pq is N = u_b |a|² − u_a a·b, and so on (geometry/triangle_kernel.hpp). Let m = |a|² + |b|² + |w_p − w_q|
/// + |w_p − w_r|. Then S² and all products are at most m²/2. The last of the three, S² − N_a − N_b, takes at most 35
/// roundings.
TEMPER_INLINE CertainHeights certain_heights(const Spoke<Pack>& a, const Spoke<Pack>& b) {
  constexpr double kBound = 64 * inlined::kUnitRoundoff;
  const Pack s = a.x * b.y - a.y * b.x, ab = a.x * b.x + a.y * b.y;
  const Pack na = b.u * a.l2 - a.u * ab, nb = a.u * b.l2 - b.u * ab;
  const Pack m = a.l2 + b.l2 + absolute(a.dw) + absolute(b.dw), bound = kBound * (m * m);
  const Mask oriented = s > 0;
  return {oriented & (na > bound), oriented & (nb > bound), oriented & (s * s - na - nb > bound)};
}

/// Returns the lanes in which edge ab, between triangles abc and adb, certainly is regular.
template <class Point>
TEMPER_INLINE Mask certainly_regular(const Point& a, const Point& b, const Point& c, const Point& d) {
  const auto [determinant, bound] = inlined::filtered_power_test(a, b, c, d);
  return determinant < -bound;
}

/// Returns the point before q_0 on a closed link: q_{n−1}, with n different from lane to lane.
template <class In>
TEMPER_INLINE typename In::Point before_first(const StarBatch& batch) {
  const Pack triangles = Pack::load(batch.triangles);
  typename In::Point before = load<In>(batch.link[0]);
  for (std::size_t i = 1; i < batch.most_triangles; ++i) {
    const Mask last = has_triangle(triangles, i) & ~has_triangle(triangles, i + 1);
    before = select(last, load<In>(batch.link[i]), before);
  }
  return before;
}

/// Returns the lanes in which all edges that may flip are certainly regular. On the sphere a power test is cheap.
TEMPER_INLINE Mask regular_at(const StarBatch& batch, const OnSphere::Point& p) {
  using Point = OnSphere::Point;
  const Pack triangles = Pack::load(batch.triangles);
  Mask flips = triangles < 0;
  Point before = before_first<OnSphere>(batch), q = load<OnSphere>(batch.link[0]);
  for (std::size_t i = 0; i < batch.most_triangles; ++i) {
    const Point r = load<OnSphere>(batch.link[i + 1]), o = load<OnSphere>(batch.across[i]);
    const Mask here = has_triangle(triangles, i);
    const Mask link = load(batch.link_flips[i]) & here, spokes = load(batch.spoke_flips[i]) & here;
    flips = flips | (spokes & ~certainly_regular(p, q, r, before)) | (link & ~certainly_regular(q, r, p, o));
    before = q;
    q = r;
  }
  return ~flips;
}

/// In the plane, an edge with two positive heights is regular. The power test decides about other edges.
TEMPER_INLINE Mask regular_at(const StarBatch& batch, const InPlane::Point& p) {
  using PackPoint = InPlane::Point;
  const Pack triangles = Pack::load(batch.triangles);
  Mask flips = triangles < 0;
  PackPoint before = before_first<InPlane>(batch), q = load<InPlane>(batch.link[0]);
  Spoke<Pack> a = spoke(p, q);
  Mask over_a_before = certain_heights(spoke(p, before), a).over_b;
  for (std::size_t i = 0; i < batch.most_triangles; ++i) {
    const PackPoint r = load<InPlane>(batch.link[i + 1]), o = load<InPlane>(batch.across[i]);
    const Spoke<Pack> b = spoke(p, r);
    const CertainHeights heights = certain_heights(a, b);
    const Mask here = has_triangle(triangles, i);
    const Mask link =
        load(batch.link_flips[i]) & here & ~(heights.over_qr & certain_heights(spoke(q, o), spoke(q, r)).over_b);
    const Mask spokes = load(batch.spoke_flips[i]) & here & ~(heights.over_a & over_a_before);
    if ((link | spokes).bits() != 0)
      flips = flips | (spokes & ~certainly_regular(p, q, r, before)) | (link & ~certainly_regular(q, r, p, o));
    before = q;
    q = r;
    a = b;
    over_a_before = heights.over_b;
  }
  return ~flips;
}

/// Returns the lanes in which all triangles are certainly well-centered. Duals cross link edges as before.
TEMPER_INLINE Mask well_centered_at(const StarBatch& batch, const InPlane::Point& p) {
  const Pack triangles = Pack::load(batch.triangles);
  const auto crossed = [](const Spoke<Pack>& a) {
    const Pack dw = absolute(a.dw);
    return a.l2 - dw > inlined::kDualCrossingBound * (a.l2 + dw);
  };
  Mask uncertain = triangles < 0;
  Spoke<Pack> a = spoke(p, load<InPlane>(batch.link[0]));
  for (std::size_t i = 0; i < batch.most_triangles; ++i) {
    const Spoke<Pack> b = spoke(p, load<InPlane>(batch.link[i + 1]));
    const auto [over_a, over_b, over_qr] = certain_heights(a, b);
    uncertain = uncertain | (has_triangle(triangles, i) & ~(over_a & over_b & over_qr & crossed(a) & crossed(b)));
    a = b;
  }
  return ~uncertain;
}

TEMPER_INLINE Mask well_centered_at(const StarBatch& batch, const OnSphere::Point& p) {
  using Point = OnSphere::Point;
  const Pack triangles = Pack::load(batch.triangles);
  const auto positive = [](const inlined::Filtered<Pack>& x) { return x.value > x.bound; };
  const auto crossed = [&](const Point& q) {
    return positive(inlined::filtered_dual_crossing(p, q)) & positive(inlined::filtered_dual_crossing(q, p));
  };
  Mask uncertain = triangles < 0;
  Point q = load<OnSphere>(batch.link[0]);
  for (std::size_t i = 0; i < batch.most_triangles; ++i) {
    const Point r = load<OnSphere>(batch.link[i + 1]);
    const Mask certain = positive(inlined::filtered_orientation(p, q, r)) & crossed(q) & crossed(r) &
                         positive(inlined::filtered_height_numerator(p, q, r)) &
                         positive(inlined::filtered_height_numerator(q, r, p)) &
                         positive(inlined::filtered_height_numerator(r, p, q));
    uncertain = uncertain | (has_triangle(triangles, i) & ~certain);
    q = r;
  }
  return ~uncertain;
}

template <class Point>
TEMPER_INLINE void store(const Point& p, LanePoints& to) {
  const auto& [x, y, third] = p;
  x.store(to.x);
  y.store(to.y);
  third.store(to.w);
}

/// The outcome of a search.
template <class In>
struct Found {
  typename In::Point to;
  Mask stepped, alone;
};

/// VertexStep::newton_search for all stars. `energy`: a barrier's kernel, or the stars of the accuracy objective.
template <class In, class Energy>
TEMPER_INLINE Found<In> newton_search(const Energy& energy, int trials, const StepParameters& parameters,
                                      StarBatch& batch) {
  const typename In::Point at = load<In>(batch.p);
  const typename In::Center p = seen_from(at);
  const Mask moves = load(batch.moves), changes_weight = load(batch.changes_weight);
  const Derivatives d = derivatives<In>(energy, batch, p);
  const PackStep newton = newton_step(d, moves, changes_weight);
  const Mask usable = d.feasible & newton.definite & (moves | changes_weight);
  const double relaxation = parameters.relaxation;
  const PackStep step = {relaxation * newton.x, relaxation * newton.y, relaxation * newton.w, {}, {}};

  typename In::Point to = at;
  Pack after = d.sums.value;
  const Mask promising = usable & (newton.predicted > kNoGain * absolute(d.sums.value));
  Mask stepped = promising & ~promising, uncertain = stepped;
  const auto attempt = [&](Pack& t, double shorter, Mask searching) {
    const typename In::Point there = moved(p, step, t, moves, parameters);
    const Trial e = energy_at<In>(energy, batch, there);
    const Mask lower = searching & e.feasible & (e.value < d.sums.value);
    to = select(lower, there, to);
    after = select(lower, e.value, after);
    stepped = stepped | lower;
    uncertain = uncertain | (lower & ~e.certain);
    t = shorter * t;
    return searching & ~lower;
  };
  damped_search(relaxation, trials, inversion_limit<In>(batch, p, step), promising, attempt);
  store(to, batch.to);
  d.sums.value.store(batch.before);
  after.store(batch.after);
  const Mask alone = (uncertain | ~usable) & (moves | changes_weight);
  return {to, stepped & ~alone, alone};
}

template <class In>
StepOutcome barrier_step(const StepParameters& parameters, StarBatch& batch) {
  return with_barrier(parameters.formula, [&](const auto& kernel) {
    const auto [to, stepped, alone] = newton_search<In>(kernel, kTrials, parameters, batch);
    const unsigned used = (1U << batch.lanes) - 1, done = stepped.bits() & used;
    return StepOutcome{done, done != 0 ? regular_at(batch, to).bits() & done : 0, alone.bits() & used};
  });
}

TEMPER_INLINE LengthBarrier<Pack> load_lengths(const AccuracyLanes::Lengths& of) {
  return {Pack::load(of.factor), Pack::load(of.l2), Pack::load(of.dual2)};
}

template <class In>
StepOutcome accuracy_step(const StepParameters& parameters, const AccuracyModel& model, const AccuracyLanes& lanes,
                          StarBatch& batch) {
  AccuracySpoke<In> spokes[StarBatch::kMostTriangles + 1];
  AccuracyTriangle<In> triangles[StarBatch::kMostTriangles];
  const Pack n = Pack::load(batch.triangles), size = Pack::load(lanes.size);
  const Mask open = load(batch.open);
  const AccuracyStarOf<In> star = {
      model, spokes, triangles, batch.most_triangles, n, n + select(open, Pack::all(1), Pack::all(0)), open};
  SizedPoint<In> q = {load<In>(batch.link[0]), Pack::load(lanes.link_size[0])};
  set_spoke(star, 0, size, q);
  for (std::size_t i = 0; i < star.most; ++i) {
    const SizedPoint<In> r = {load<In>(batch.link[i + 1]), Pack::load(lanes.link_size[i + 1])};
    set_triangle(star, i, size, q, r, Pack::load(lanes.floor[i]), load(lanes.inner[i]), load<In>(batch.across[i]));
    set_spoke(star, i + 1, size, r);
    q = r;
  }
  if (model.keeps_lengths()) {
    for (std::size_t i = 0; i < star.most; ++i) triangles[i].link_lengths = load_lengths(lanes.link[i]);
    for (std::size_t i = 0; i <= star.most; ++i) spokes[i].lengths = load_lengths(lanes.spoke[i]);
  }
  const auto [to, stepped, alone] = newton_search<In>(star, kTrialsWithMargins, parameters, batch);
  const Mask certain = well_centered_at(batch, to);
  const unsigned used = (1U << batch.lanes) - 1, done = (stepped & certain).bits() & used;
  return {done, done, (alone | (stepped & ~certain)).bits() & used};
}

}  // namespace

template <class In>
constexpr BatchSteps kStepsOf = {barrier_step<In>, accuracy_step<In>};

const BatchSteps kPlaneSteps = kStepsOf<InPlane>;
const BatchSteps kSphereSteps = kStepsOf<OnSphere>;

}  // namespace temper::TEMPER_INSTRUCTION_SET
