// Included by one source for each instruction set, compiled for that set.
#pragma once

#include "energy/star_kernels.hpp"
#include "energy/star_sums.hpp"
#include "energy/triangle_hessian_set.hpp"
#include "geometry/predicates_inline.hpp"

namespace temper::TEMPER_INSTRUCTION_SET {
namespace {

// A mask of the first n < kLanes lanes: loaded from kFirstLanes + kLanes − n.
constexpr std::int64_t kFirstLanes[2 * kLanes] = {-1, -1, -1, -1, -1, -1, -1, -1};

TEMPER_INLINE Pack::Mask first_lanes(std::size_t n) {
  return Pack::Mask::load(kFirstLanes + (n < kLanes ? kLanes - n : 0));
}

TEMPER_INLINE PackPoint load_link(const LinkArrays& link, std::size_t i) {
  return {Pack::load(link.x + i), Pack::load(link.y + i), Pack::load(link.w + i)};
}

TEMPER_INLINE PackPoint everywhere(const WeightedPoint& p) { return {Pack::all(p.x), Pack::all(p.y), Pack::all(p.w)}; }

constexpr unsigned kAllLanes = (1U << kLanes) - 1;

TEMPER_INLINE void store(const StarSums& sums, double* out) {
  const auto& [g, h] = sums.derivatives;
  const Pack packs[kStarSums] = {sums.value, g.x, g.y, g.w, h.xx, h.xy, h.xw, h.yy, h.yw, h.ww};
  for (std::size_t k = 0; k < kStarSums; ++k) out[k] = sum(packs[k]);
}

template <class Kernel>
TEMPER_INLINE bool star_derivatives(const Kernel& kernel, const LinkArrays& link, const WeightedPoint& at,
                                    double* out) {
  const PackPoint p = everywhere(at);
  StarSums sums;
  for (std::size_t i = 0; i < link.size; i += kLanes) {
    const Pack::Mask where = first_lanes(link.size - i);
    const PackPoint q = load_link(link, i), r = load_link(link, i + 1);
    const Pack::Mask inside = add_barrier(kernel, spoke_of(kernel, p, q), spoke_of(kernel, p, r), q, r, where, sums);
    if ((inside | ~where).bits() != kAllLanes) return false;
  }
  store(sums, out);
  return true;
}

template <class Kernel>
TEMPER_INLINE double star_value(const Kernel& kernel, const LinkArrays& link, const WeightedPoint& at) {
  const PackPoint p = everywhere(at);
  Pack total = Pack::all(0);
  for (std::size_t i = 0; i < link.size; i += kLanes) {
    const Pack::Mask where = first_lanes(link.size - i);
    const PackPoint q = load_link(link, i), r = load_link(link, i + 1);
    const Pack::Mask inside =
        add_barrier_value(kernel, spoke_of(kernel, p, q), spoke_of(kernel, p, r), q, r, where, total);
    if ((inside | ~where).bits() != kAllLanes) return kInfinity;
  }
  return sum(total);
}

bool barrier_derivatives(const EdgeFormula& f, const LinkArrays& link, const WeightedPoint& p, double* sums) {
  return with_barrier(f, [&](const auto& kernel) { return star_derivatives(kernel, link, p, sums); });
}

double barrier_value(const EdgeFormula& f, const LinkArrays& link, const WeightedPoint& p) {
  return with_barrier(f, [&](const auto& kernel) { return star_value(kernel, link, p); });
}

void hot_edges(const EdgeFormula& f, const LinkArrays& link, const WeightedPoint& at, const HotEdges& edges) {
  const HotKernel kernel = hot_kernel(f);
  const PackPoint p = everywhere(at);
  for (std::size_t i = 0; i < link.size; i += kLanes) {
    const PackPoint q = load_link(link, i), r = load_link(link, i + 1);
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

void hot_derivatives(const EdgeFormula& f, const LinkArrays& link, const EdgeFactors& factors, const WeightedPoint& at,
                     double* out) {
  const HotKernel kernel = hot_kernel(f);
  const PackPoint p = everywhere(at);
  StarSums sums;
  for (std::size_t i = 0; i < link.size; i += kLanes) {
    add_hot(kernel, p, load_link(link, i), load_link(link, i + 1), Pack::load(factors.pq + i),
            Pack::load(factors.qr + i), Pack::load(factors.rp + i), first_lanes(link.size - i), sums);
  }
  store(sums, out);
}

double barrier_sum(const EdgeFormula& f, const TriangleLanes& triangles, std::size_t n) {
  const PackPoint p = load(triangles.p), q = load(triangles.q), r = load(triangles.r);
  return with_barrier(f, [&](const auto& kernel) {
    const auto a = spoke_of(kernel, p, q), b = spoke_of(kernel, p, r);
    const TriangleValue t = triangle_value(kernel, a, b, triangle_shape(a.to, b.to, q, r));
    return sum(select(first_lanes(n), select(t.inside, t.value, Pack::all(kInfinity)), Pack::all(0)));
  });
}

WellCentered well_centered(const TriangleLanes& triangles) {
  const PackPoint p = load(triangles.p), q = load(triangles.q), r = load(triangles.r);
  Pack::Mask yes = Pack::all(0) > -1.0, no = ~yes;
  const auto must_be_positive = [&](const inlined::Filtered<Pack>& x) {
    yes = yes & (x.value > x.bound);
    no = no | (x.value < -x.bound);
  };
  must_be_positive(inlined::filtered_orient2d(p, q, r));
  const auto edge_must_be_crossed = [&](const PackPoint& a, const PackPoint& b, const PackPoint& c) {
    must_be_positive(inlined::filtered_height_numerator(a, b, c));
    must_be_positive(inlined::filtered_edge_split(a, b));
    must_be_positive(inlined::filtered_edge_split(b, a));
  };
  edge_must_be_crossed(p, q, r);
  edge_must_be_crossed(q, r, p);
  edge_must_be_crossed(r, p, q);
  return {yes.bits(), no.bits()};
}

}  // namespace

const StarKernels kStarKernels = {barrier_derivatives, barrier_value, hot_edges,        hot_derivatives,
                                  barrier_sum,         well_centered, triangle_hessians};

}  // namespace temper::TEMPER_INSTRUCTION_SET
