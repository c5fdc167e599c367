// Energy and barrier of the accuracy objective in packs of triangles and of edges: part of star_kernels_set.hpp.
#pragma once

#include "energy/accuracy_lanes.hpp"
#include "energy/accuracy_star.hpp"
#include "energy/star_sums.hpp"

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
  Pack heights = Pack::all(1), splits = heights;
  for (const ShapeLanes::Edge& e : shapes.edges) {
    const Pack inverse_l2 = 1.0 / Pack::load(e.l2);
    heights = heights * (Pack::load(e.g) * inverse_l2 - floor);
    splits = splits * split_room(Pack::load(e.dw) * inverse_l2, floor);
  }
  (0.5 * portable_log(heights * heights * splits)).store(result);
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

}  // namespace
}  // namespace temper::TEMPER_INSTRUCTION_SET
