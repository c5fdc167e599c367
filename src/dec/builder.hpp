// The operators: first edges in the order of their vertices, then everything that belongs to a triangle or an edge.
//
// Measures has the lengths, heights and areas of one edge or one triangle:
//   Point, point(v), point(v, near)   a vertex, and its image near another one
//   triangle(c, t), line(c, edge)     area and orthocenter; length, crossing and midpoint
//   height(p, q, r, area, length)     h over pq in pqr
//   end_ratio(p, q, r, area, length)  h/ℓ
//   dual_ratio({p, q, r, s}, {areas of pqr and qps}, length)   (h_k + h_l)/ℓ
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "base/assert.hpp"
#include "dec/joint_polygons.hpp"
#include "geometry/surface.hpp"
#include "temper/dec.hpp"
#include "temper/detail/geometry.hpp"

namespace temper {

/// Half-edges that stand for edges, sorted by (lower vertex, higher vertex): buckets by the lower one, each sorted.
inline std::vector<HalfedgeId> sorted_edges(const Mesh& mesh) {
  const auto low = [&](HalfedgeId h) { return std::min(mesh.origin(h), mesh.target(h)); };
  const auto high = [&](HalfedgeId h) { return std::max(mesh.origin(h), mesh.target(h)); };
  std::vector<std::size_t> starts(mesh.n_vertices() + 1, 0);
  for (const HalfedgeId h : mesh.halfedges()) {
    if (mesh.is_edge_representative(h)) ++starts[low(h).index + 1];
  }
  for (std::size_t v = 0; v < mesh.n_vertices(); ++v) starts[v + 1] += starts[v];
  std::vector<HalfedgeId> sorted(starts.back());
  std::vector<std::size_t> next = starts;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (mesh.is_edge_representative(h)) sorted[next[low(h).index]++] = h;
  }
  const auto at = [&](std::size_t i) { return sorted.begin() + static_cast<std::ptrdiff_t>(i); };
  for (std::size_t v = 0; v < mesh.n_vertices(); ++v) {
    std::sort(at(starts[v]), at(starts[v + 1]), [&](HalfedgeId a, HalfedgeId b) { return high(a) < high(b); });
  }
  return sorted;
}

/// Builds the operators from the measures of one space, or of a surface.
template <class Measures>
class DecBuilder {
 public:
  DecBuilder(const Mesh& mesh, Measures measures) : mesh_(mesh), measures_(std::move(measures)) {}
  DecComplex build();
  /// Builds all but d0 and d1.
  DecComplex build_measures();

 private:
  void add_measures();
  void triangles();
  void add_edge(HalfedgeId h);
  [[nodiscard]] double height(HalfedgeId h, double length) const;
  [[nodiscard]] double star1(HalfedgeId left, HalfedgeId right, double length) const;
  void incidence();
  void dual_areas();

  const Mesh& mesh_;
  const Measures measures_;
  DecComplex c_;
};

template <class Measures>
DecComplex DecBuilder<Measures>::build() {
  add_measures();
  incidence();
  return std::move(c_);
}

template <class Measures>
DecComplex DecBuilder<Measures>::build_measures() {
  add_measures();
  return std::move(c_);
}

template <class Measures>
void DecBuilder<Measures>::add_measures() {
  triangles();
  const std::vector<HalfedgeId> edges = sorted_edges(mesh_);
  c_.edges.reserve(edges.size());
  c_.star1.reserve(edges.size());
  c_.transmissibility.reserve(edges.size());
  c_.edge_of_halfedge.resize(mesh_.n_halfedges());
  for (const HalfedgeId h : edges) add_edge(h);
  dual_areas();
}

template <class Measures>
void DecBuilder<Measures>::triangles() {
  c_.areas.reserve(mesh_.n_triangles());
  c_.star2.reserve(mesh_.n_triangles());
  for (const TriangleId t : mesh_.triangles()) {
    measures_.triangle(c_, t);
    c_.star2.push_back(1 / c_.areas[t]);
  }
  const JointPolygons joints(mesh_);
  for (const TriangleId t : mesh_.triangles()) {
    if (joints.whole(t) == t) continue;
    if (!mesh_.space().is_plane()) {
      c_.sphere_orthocenters[t] = c_.sphere_orthocenters[joints.whole(t)];
      continue;
    }
    const auto [i, j, k] = mesh_.corners(joints.whole(t));
    const WeightedPoint here = mesh_.point(mesh_.corners(t)[0]);
    c_.orthocenters[t] = orthocenter(mesh_.point(i, here), mesh_.point(j, here), mesh_.point(k, here));
  }
}

template <class Measures>
void DecBuilder<Measures>::add_edge(HalfedgeId h) {
  const bool upwards = mesh_.origin(h) < mesh_.target(h);
  const HalfedgeId left = upwards ? h : mesh_.twin(h), right = upwards ? mesh_.twin(h) : h;
  const EdgeId e(c_.edges.size());
  c_.edge_of_halfedge[h] = e;
  if (mesh_.twin(h).valid()) c_.edge_of_halfedge[mesh_.twin(h)] = e;
  DecEdge edge;
  edge.from = upwards ? mesh_.origin(h) : mesh_.target(h);
  edge.to = upwards ? mesh_.target(h) : mesh_.origin(h);
  measures_.line(c_, edge);
  if (left.valid()) edge.left = Mesh::triangle(left), edge.left_height = height(left, edge.length);
  if (right.valid()) edge.right = Mesh::triangle(right), edge.right_height = height(right, edge.length);
  double ratio = 0;
  if (!mesh_.is_joint(h))
    ratio = star1(left, right, edge.length);
  else if (!edge.is_boundary())
    edge.right_height = -edge.left_height;  // both are to one orthocenter
  else
    edge.left_height = edge.right_height = 0;  // the orthocenter is on the edge
  edge.dual_length = ratio * edge.length;
  c_.edges.push_back(edge);
  c_.star1.push_back(ratio);
  c_.transmissibility.push_back(ratio == 0 ? std::numeric_limits<double>::infinity() : 1 / ratio);
}

template <class Measures>
double DecBuilder<Measures>::height(HalfedgeId h, double length) const {
  const auto p = measures_.point(mesh_.origin(h));
  return measures_.height(p, measures_.point(mesh_.target(h), p), measures_.point(mesh_.opposite(h), p),
                          c_.areas[Mesh::triangle(h)], length);
}

template <class Measures>
double DecBuilder<Measures>::star1(HalfedgeId left, HalfedgeId right, double length) const {
  const HalfedgeId h = left.valid() ? left : right;
  const auto p = measures_.point(mesh_.origin(h)), q = measures_.point(mesh_.target(h), p);
  const auto r = measures_.point(mesh_.opposite(h), p);
  const double here = c_.areas[Mesh::triangle(h)];
  if (!left.valid() || !right.valid()) return measures_.end_ratio(p, q, r, here, length);
  const auto s = measures_.point(mesh_.opposite(right), p);
  return measures_.dual_ratio({p, q, r, s}, {here, c_.areas[Mesh::triangle(right)]}, length);
}

template <class Measures>
void DecBuilder<Measures>::incidence() {
  const std::size_t n_edges = c_.edges.size(), n_triangles = mesh_.n_triangles();
  TEMPER_ASSERT(n_edges < std::size_t{1} << 31);
  c_.d0 = {mesh_.n_vertices(), std::vector<std::int64_t>(n_edges + 1), {}, {}};
  c_.d0.columns.reserve(2 * n_edges);
  c_.d0.signs.reserve(2 * n_edges);
  for (std::size_t e = 0; e < n_edges; ++e) {
    const DecEdge& edge = c_.edges[EdgeId(e)];
    c_.d0.columns.push_back(static_cast<std::int32_t>(edge.from.index));
    c_.d0.columns.push_back(static_cast<std::int32_t>(edge.to.index));
    c_.d0.signs.push_back(-1);
    c_.d0.signs.push_back(1);
    c_.d0.starts[e + 1] = static_cast<std::int64_t>(2 * (e + 1));
  }
  c_.d1 = {n_edges, std::vector<std::int64_t>(n_triangles + 1), {}, {}};
  c_.d1.columns.reserve(3 * n_triangles);
  c_.d1.signs.reserve(3 * n_triangles);
  for (const TriangleId t : mesh_.triangles()) {
    std::array<HalfedgeId, 3> sides = {Mesh::halfedge(t, 0), Mesh::halfedge(t, 1), Mesh::halfedge(t, 2)};
    std::sort(sides.begin(), sides.end(),
              [&](HalfedgeId a, HalfedgeId b) { return c_.edge_of_halfedge[a] < c_.edge_of_halfedge[b]; });
    for (const HalfedgeId h : sides) {
      c_.d1.columns.push_back(static_cast<std::int32_t>(c_.edge_of_halfedge[h].index));
      c_.d1.signs.push_back(mesh_.origin(h) < mesh_.target(h) ? 1 : -1);
    }
    c_.d1.starts[t.index + 1] = 3 * (std::int64_t{t.index} + 1);
  }
}

// Each edge has its two half-edges' heights, and its two ends' shares of the length.
template <class Measures>
void DecBuilder<Measures>::dual_areas() {
  c_.star0.resize(mesh_.n_vertices(), 0.0);
  for (const DecEdge& edge : c_.edges) {
    const double left = edge.left_height, right = edge.right_height;
    c_.star0[edge.from] += right_triangle_areas(mesh_.space(), edge.crossing, left, right);
    c_.star0[edge.to] += right_triangle_areas(mesh_.space(), edge.length - edge.crossing, left, right);
  }
}

}  // namespace temper
