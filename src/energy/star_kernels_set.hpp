// Included by one source for each instruction set, compiled for that set.
#pragma once

#include "energy/accuracy_star.hpp"
#include "energy/star_kernels.hpp"
#include "energy/star_sums.hpp"
#include "geometry/predicates_inline.hpp"

namespace temper::TEMPER_INSTRUCTION_SET {
namespace {

template <class In>
void triangle_shapes(const TriangleLanes& triangles, ShapeLanes& shapes) {
  const typename In::Point q = load<In>(triangles.q), r = load<In>(triangles.r);
  const typename In::Center p = seen_from(load<In>(triangles.p));
  const PackShape s = triangle_shape(spoke(p, q), spoke(p, r), q, r);
  const auto store = [](const EdgeShapeOf<Pack>& from, ShapeLanes::Edge& to) {
    from.l2.store(to.l2);
    from.dw.store(to.dw);
    from.g.store(to.g);
  };
  store(s.pq, shapes.edges[0]);
  store(s.qr, shapes.edges[1]);
  store(s.rp, shapes.edges[2]);
}

/// Σ_edges [ln(h/ℓ − ε) + ½ ln(d_ij/ℓ − ε) + ½ ln(d_ji/ℓ − ε)], as one logarithm of a product.
void accuracy_logarithms(const ShapeLanes& shapes, const Lane& floors, Lane& result) {
  const Pack floor = Pack::load(floors);
  Pack heights = Pack::all(1), crossings = heights;
  for (const ShapeLanes::Edge& e : shapes.edges) {
    const Pack inverse_l2 = 1.0 / Pack::load(e.l2);
    heights = heights * (Pack::load(e.g) * inverse_l2 - floor);
    crossings = crossings * crossing_room(Pack::load(e.dw) * inverse_l2, floor);
  }
  (0.5 * portable_log(heights * heights * crossings)).store(result);
}

template <class In>
void accuracy_edges(const AccuracyModel& model, const EdgeLanes& edges, Lane& result) {
  const typename In::Point a = load<In>(edges.a), d = load<In>(edges.d);
  const typename In::Center b = seen_from(load<In>(edges.b));
  const Pack across = triangle_shape(spoke(b, a), spoke(b, d), a, d).pq.g, l2 = Pack::load(edges.l2);
  const AccuracyEdge<Pack> edge = {edge_scale(Pack::load(edges.size_a), Pack::load(edges.size_b)),
                                   Pack::load(edges.height),
                                   l2,
                                   1.0 / l2,
                                   Pack::load(edges.dw),
                                   Pack::load(edges.left),
                                   select(load(edges.inner), across, Pack::all(0))};
  edge_value(model, edge).store(result);
}

// A mask of the first n < kLanes lanes: loaded from kFirstLanes + kLanes − n.
constexpr std::int64_t kFirstLanes[2 * kLanes] = {-1, -1, -1, -1, -1, -1, -1, -1};

TEMPER_INLINE Pack::Mask first_lanes(std::size_t n) {
  return Pack::Mask::load(kFirstLanes + (n < kLanes ? kLanes - n : 0));
}

template <class In>
TEMPER_INLINE typename In::Point load_link(const LinkArrays& link, std::size_t i) {
  return {Pack::load(link.x + i), Pack::load(link.y + i), Pack::load(link.w + i)};
}

/// p in every lane, as the center of a star.
template <class In>
TEMPER_INLINE typename In::Center everywhere(const WeightedPoint& p) {
  return seen_from(typename In::Point{Pack::all(p.x), Pack::all(p.y), Pack::all(p.w)});
}

constexpr unsigned kAllLanes = (1U << kLanes) - 1;

TEMPER_INLINE void store(const StarSums& sums, double* out) {
  const auto& [g, h] = sums.derivatives;
  const Pack packs[kStarSums] = {sums.value, g.x, g.y, g.w, h.xx, h.xy, h.xw, h.yy, h.yw, h.ww};
  for (std::size_t k = 0; k < kStarSums; ++k) out[k] = sum(packs[k]);
}

template <class In>
bool barrier_derivatives(const EdgeFormula& f, const LinkArrays& link, const WeightedPoint& at, double* out) {
  const typename In::Center p = everywhere<In>(at);
  return with_barrier(f, [&](const auto& kernel) {
    StarSums sums;
    for (std::size_t i = 0; i < link.size; i += kLanes) {
      const Pack::Mask where = first_lanes(link.size - i);
      const typename In::Point q = load_link<In>(link, i), r = load_link<In>(link, i + 1);
      const auto a = spoke_of<In>(kernel, p, q), b = spoke_of<In>(kernel, p, r);
      const Pack::Mask inside = add_barrier<In>(kernel, a, b, q, r, where, sums);
      if ((inside | ~where).bits() != kAllLanes) return false;
    }
    bend(p, sums.derivatives);
    store(sums, out);
    return true;
  });
}

template <class In>
double barrier_value(const EdgeFormula& f, const LinkArrays& link, const WeightedPoint& at) {
  const typename In::Center p = everywhere<In>(at);
  return with_barrier(f, [&](const auto& kernel) {
    Pack total = Pack::all(0);
    for (std::size_t i = 0; i < link.size; i += kLanes) {
      const Pack::Mask where = first_lanes(link.size - i);
      const typename In::Point q = load_link<In>(link, i), r = load_link<In>(link, i + 1);
      const auto a = spoke_of<In>(kernel, p, q), b = spoke_of<In>(kernel, p, r);
      const Pack::Mask inside = add_barrier_value<In>(kernel, a, b, q, r, where, total);
      if ((inside | ~where).bits() != kAllLanes) return kInfinity;
    }
    return sum(total);
  });
}

template <class In>
void hot_edges(const EdgeFormula& f, const LinkArrays& link, const WeightedPoint& at, const HotEdges& edges) {
  const HotKernel kernel = hot_kernel(f);
  const typename In::Center p = everywhere<In>(at);
  for (std::size_t i = 0; i < link.size; i += kLanes) {
    const typename In::Point q = load_link<In>(link, i), r = load_link<In>(link, i + 1);
    const PackShape s = triangle_shape(spoke(p, q), spoke(p, r), q, r);
    const EdgeShapeOf<Pack> shapes[3] = {s.pq, s.qr, s.rp};
    const Pack per_area = kernel.per_area(s.doubled_area);
    for (std::size_t k = 0; k < 3; ++k) {
      shapes[k].g.store(edges.g[k] + i);
      (kernel.value(shapes[k]) * per_area).store(edges.value[k] + i);
    }
    s.doubled_area.store(edges.doubled_area + i);
  }
}

template <class In>
void hot_derivatives(const EdgeFormula& f, const LinkArrays& link, const EdgeFactors& factors, const WeightedPoint& at,
                     double* out) {
  const HotKernel kernel = hot_kernel(f);
  const typename In::Center p = everywhere<In>(at);
  StarSums sums;
  for (std::size_t i = 0; i < link.size; i += kLanes) {
    add_hot<In>(kernel, p, load_link<In>(link, i), load_link<In>(link, i + 1), Pack::load(factors.pq + i),
                Pack::load(factors.qr + i), Pack::load(factors.rp + i), first_lanes(link.size - i), sums);
  }
  bend(p, sums.derivatives);
  store(sums, out);
}

template <class In>
double barrier_sum(const EdgeFormula& f, const TriangleLanes& triangles, std::size_t n) {
  const typename In::Point q = load<In>(triangles.q), r = load<In>(triangles.r);
  const typename In::Center p = seen_from(load<In>(triangles.p));
  return with_barrier(f, [&](const auto& kernel) {
    const auto a = spoke_of<In>(kernel, p, q), b = spoke_of<In>(kernel, p, r);
    const TriangleValue t = triangle_value<In>(kernel, a, b, triangle_shape(a.to, b.to, q, r));
    return sum(select(first_lanes(n), select(t.inside, t.value, Pack::all(kInfinity)), Pack::all(0)));
  });
}

template <class In>
WellCentered well_centered(const TriangleLanes& triangles) {
  using Point = typename In::Point;
  const Point p = load<In>(triangles.p), q = load<In>(triangles.q), r = load<In>(triangles.r);
  Pack::Mask yes = Pack::all(0) > -1.0, no = ~yes;
  const auto must_be_positive = [&](const inlined::Filtered<Pack>& x) {
    yes = yes & (x.value > x.bound);
    no = no | (x.value < -x.bound);
  };
  must_be_positive(inlined::filtered_orientation(p, q, r));
  const auto edge_must_be_crossed = [&](const Point& a, const Point& b, const Point& c) {
    must_be_positive(inlined::filtered_height_numerator(a, b, c));
    must_be_positive(inlined::filtered_dual_crossing(a, b));
    must_be_positive(inlined::filtered_dual_crossing(b, a));
  };
  edge_must_be_crossed(p, q, r);
  edge_must_be_crossed(q, r, p);
  edge_must_be_crossed(r, p, q);
  return {yes.bits(), no.bits()};
}

}  // namespace

template <class In>
constexpr StarKernels kKernelsOf = {barrier_derivatives<In>, barrier_value<In>,   hot_edges<In>,
                                    hot_derivatives<In>,     barrier_sum<In>,     well_centered<In>,
                                    triangle_shapes<In>,     accuracy_logarithms, accuracy_edges<In>};

const StarKernels kPlaneKernels = kKernelsOf<InPlane>;
const StarKernels kSphereKernels = kKernelsOf<OnSphere>;

}  // namespace temper::TEMPER_INSTRUCTION_SET
