// Energy and barrier of the accuracy objective on whole meshes. Triangles and edges are computed eight at a time; the
// sum adds their terms in the order of their numbers.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <tuple>

#include "base/loops.hpp"
#include "base/sum.hpp"
#include "energy/accuracy_energy.hpp"
#include "energy/star_kernels.hpp"
#include "geometry/triangle_kernel.hpp"

namespace temper {
namespace {

/// Some consecutive triangles, as many as fit into the nearest cache with all their edges. All lanes are filled before
/// the first computation: reading eight numbers at once waits long for a number that has just been written.
class Triangles {
 public:
  static constexpr std::size_t kMost = 4 * kLanes;

  Triangles(const Mesh& mesh, std::size_t first, std::size_t end) : mesh_(mesh), first_(first), size_(end - first) {
    for (std::size_t i = 0; i < size_; ++i) lanes_[i / kLanes].set(i % kLanes, mesh.points((*this)[i]));
    const StarKernels& kernels = star_kernels(mesh.space());
    for (std::size_t k = 0; k * kLanes < size_; ++k) kernels.triangle_shapes(lanes_[k], shapes_[k]);
  }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] TriangleId operator[](std::size_t i) const { return TriangleId(first_ + i); }
  /// The edge k of triangle i.
  [[nodiscard]] EdgeShape edge(std::size_t i, int k) const {
    return shapes_[i / kLanes].edges[static_cast<std::size_t>(k)].at(i % kLanes);
  }

  /// Calls visit(i, logarithm) for each triangle that has a floor: its barrier, without sign and factor.
  template <class Visit>
  void for_logarithms(const AccuracyFloors& floors, Visit&& visit) const {
    const StarKernels& kernels = star_kernels(mesh_.space());
    alignas(64) std::array<Lane, kMost / kLanes> floor = {}, logarithm;
    for (std::size_t i = 0; i < size_; ++i) floor[i / kLanes][i % kLanes] = floors[(*this)[i]];
    for (std::size_t k = 0; k * kLanes < size_; ++k) kernels.accuracy_logarithms(shapes_[k], floor[k], logarithm[k]);
    for (std::size_t i = 0; i < size_; ++i) {
      if (floors.has((*this)[i])) visit(i, logarithm[i / kLanes][i % kLanes]);
    }
  }

  /// Calls visit(i, energy) for each edge that a halfedge of triangle i stands for.
  template <class Visit>
  void for_edges(const VertexSizes& sizes, const AccuracyModel& model, Visit&& visit) const {
    std::array<EdgeLanes, 3 * kMost / kLanes> edges;
    std::array<std::size_t, 3 * kMost> sides;  // k of triangle i as 3 i + k
    std::size_t n = 0;
    const HalfedgeId first = Mesh::halfedge((*this)[0], 0);
    // About every other halfedge stands for its edge, at random: a branch would often be predicted wrong.
    for (std::size_t i = 0; i < 3 * size_; ++i) {
      sides[n] = i;
      n += mesh_.is_edge_representative(HalfedgeId(first.index + i)) ? 1 : 0;
    }
    for (std::size_t i = 0; i < n; ++i) set(edges[i / kLanes], i % kLanes, sides[i], sizes, model);
    const StarKernels& kernels = star_kernels(mesh_.space());
    alignas(64) std::array<Lane, 3 * kMost / kLanes> energy;
    for (std::size_t k = 0; k * kLanes < n; ++k) kernels.accuracy_edges(model, edges[k], energy[k]);
    for (std::size_t i = 0; i < n; ++i) visit(sides[i] / 3, energy[i / kLanes][i % kLanes]);
  }

 private:
  void set(EdgeLanes& edges, std::size_t lane, std::size_t side, const VertexSizes& sizes,
           const AccuracyModel& model) const {
    const HalfedgeId h(std::size_t{Mesh::halfedge((*this)[0], 0).index} + side);
    const EdgeShape inner = edge(side / 3, static_cast<int>(side % 3));
    const VertexId a = mesh_.origin(h), b = mesh_.target(h);
    const HalfedgeId twin = mesh_.twin(h);
    const bool is_inner = twin.valid();
    const auto points = mesh_.points(b, a, is_inner ? mesh_.opposite(twin) : b);
    edges.height[lane] = is_inner ? model.height : model.boundary_height;
    edges.l2[lane] = inner.l2, edges.dw[lane] = inner.dw, edges.left[lane] = inner.g;
    edges.size_a[lane] = sizes[a], edges.size_b[lane] = sizes[b];
    edges.inner[lane] = is_inner ? -1 : 0;
    edges.b.set(lane, points[0]);
    edges.a.set(lane, points[1]);
    edges.d.set(lane, points[2]);
  }

  const Mesh& mesh_;
  std::size_t first_, size_;
  std::array<TriangleLanes, kMost / kLanes> lanes_;
  std::array<ShapeLanes, kMost / kLanes> shapes_;
};

/// Calls visit with all triangles of a block, some at a time.
template <class Visit>
void for_triangles(const Mesh& mesh, std::size_t block, Visit&& visit) {
  const std::size_t end = std::min(mesh.n_triangles(), (block + 1) * kBlockSize);
  for (std::size_t i = block * kBlockSize; i < end; i += Triangles::kMost) {
    visit(Triangles(mesh, i, std::min(end, i + Triangles::kMost)));
  }
}

/// The edge of h, which is `inner` in its triangle; without scale and q.
AccuracyEdge<double> edge_of(const Mesh& mesh, HalfedgeId h, const EdgeShape& inner) {
  const HalfedgeId twin = mesh.twin(h);
  double outer = 0;
  if (twin.valid()) {
    const auto [b, a, d] = mesh.points(mesh.target(h), mesh.origin(h), mesh.opposite(twin));
    outer = triangle_shape(mesh.space(), b, a, d).edges[0].g;
  }
  return {0, 0, inner.l2, 1 / inner.l2, inner.dw, inner.g, outer};
}

/// The barriers of the edges that a halfedge of triangle i stands for, between triangles that have a floor.
double own_length_barriers(const Mesh& mesh, const AccuracyFloors& floors, const Triangles& triangles, std::size_t i) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const HalfedgeId h = Mesh::halfedge(triangles[i], k), twin = mesh.twin(h);
    if (!twin.valid() || !mesh.is_edge_representative(h)) continue;
    if (!floors.has(triangles[i]) || !floors.has(Mesh::triangle(twin))) continue;
    sum += length_barrier(floors.lengths(mesh, h), edge_of(mesh, h, triangles.edge(i, k)));
  }
  return sum;
}

}  // namespace

double accuracy_energy(const Mesh& mesh, const VertexSizes& sizes, const AccuracyModel& model, Executor* executor) {
  return sum_of_blocks(mesh.n_triangles(), executor, [&](std::size_t block) {
    double sum = 0;
    for_triangles(mesh, block, [&](const Triangles& triangles) {
      std::array<double, Triangles::kMost> of_triangle = {};
      triangles.for_edges(sizes, model, [&](std::size_t i, double energy) { of_triangle[i] += std::abs(energy); });
      for (std::size_t i = 0; i < triangles.size(); ++i) sum += of_triangle[i];
    });
    return sum;
  });
}

AccuracyTotal accuracy_total(const Mesh& mesh, const AccuracyDomain& domain, const AccuracyModel& model,
                             const Engine& engine, bool with_energy) {
  const VertexSizes& sizes = domain.sizes;
  const AccuracyFloors& floors = domain.floors;
  const auto sums = sums_of_blocks(mesh.n_triangles(), 2, engine, [&](std::size_t block, std::span<double> of_block) {
    double energy = 0, barrier = 0, of_lengths = 0;
    for_triangles(mesh, block, [&](const Triangles& triangles) {
      if (with_energy) triangles.for_edges(sizes, model, [&](std::size_t, double of_edge) { energy += of_edge; });
      for (std::size_t i = 0; model.keeps_lengths() && i < triangles.size(); ++i) {
        of_lengths += own_length_barriers(mesh, floors, triangles, i);
      }
      triangles.for_logarithms(floors, [&](std::size_t i, double logarithm) {
        const auto [p, q, r] = mesh.corners(triangles[i]);
        barrier -= barrier_factor(model, sizes[p], sizes[q], sizes[r], floors[triangles[i]]) * logarithm;
      });
    });
    of_block[0] = energy;
    of_block[1] = barrier + of_lengths;
  });
  return {sums[0], sums[1]};
}

namespace {

/// The derivatives of energy and barrier by ℓ² and δw of the edge of a halfedge, and by g in its triangle.
struct HalfedgeSlopes {
  double l = 0, dw = 0, g = 0;
};

/// Each edge and each triangle is visited once; then each vertex collects its derivatives by the chain rule.
class GradientSum {
 public:
  GradientSum(const Mesh& mesh, const AccuracyDomain& domain, const AccuracyModel& model, Executor* executor)
      : mesh_(mesh), domain_(domain), model_(model), heights_(mesh.n_halfedges()), slopes_(mesh.n_halfedges()) {
    sum_of_blocks(mesh.n_triangles(), executor, [&](std::size_t block) {
      for_triangles(mesh, block, [&](const Triangles& triangles) {
        for (std::size_t i = 0; i < triangles.size(); ++i) {
          for (int k = 0; k < 3; ++k) heights_[Mesh::halfedge(triangles[i], k)] = triangles.edge(i, k).g;
        }
      });
      return 0.0;
    });
    for_each_index(mesh.n_halfedges(), executor, [&](std::size_t i) {
      if (mesh.is_edge_representative(HalfedgeId(i))) find_slopes(HalfedgeId(i));
    });
  }

  [[nodiscard]] WeightedPoint at(VertexId v) const {
    for (const HalfedgeId h : mesh_.star(v)) {
      const HalfedgeId across = mesh_.twin(Mesh::next(h));
      if (!domain_.floors.has(Mesh::triangle(h))) return {};
      if (across.valid() && !domain_.floors.has(Mesh::triangle(across))) return {};
    }
    const auto plain = [](const WeightedPoint& p) { return PointOf<double>{p.x, p.y, p.w}; };
    return mesh_.space().is_plane() ? collected(v, plain) : collected(v, weighted_vector);
  }

 private:
  [[nodiscard]] TriangleBarrier<double> barrier_at(HalfedgeId h) const {
    if (!h.valid() || !domain_.floors.has(Mesh::triangle(h))) return {0, -1};
    const TriangleId t = Mesh::triangle(h);
    const auto [p, q, r] = mesh_.corners(t);
    const VertexSizes& sizes = domain_.sizes;
    return {barrier_factor(model_, sizes[p], sizes[q], sizes[r], domain_.floors[t]), domain_.floors[t]};
  }

  void find_slopes(HalfedgeId h) {
    const HalfedgeId twin = mesh_.twin(h);
    const VertexId a = mesh_.origin(h), b = mesh_.target(h);
    const WeightedPoint p = mesh_.point(a);
    const auto [l2, dw] = edge_measures(mesh_.space(), p, mesh_.point(b, p));
    const AccuracyEdge<double> edge = {edge_scale(domain_.sizes[a], domain_.sizes[b]),
                                       twin.valid() ? model_.height : model_.boundary_height,
                                       l2,
                                       1 / l2,
                                       dw,
                                       heights_[h],
                                       twin.valid() ? heights_[twin] : 0};
    EdgeSlopes<double> s = edge_slopes(model_, edge);
    for (const auto& [side, g, slopes] : {std::tuple(h, edge.left, &s.left), std::tuple(twin, edge.right, &s.right)}) {
      const TriangleBarrier<double> barrier = barrier_at(side);
      add_height_barrier(barrier, l2, edge.inverse_l2, g, s, *slopes);
      add_crossing_barrier(barrier, l2, edge.inverse_l2, dw, s);
    }
    if (model_.keeps_lengths() && twin.valid()) add_length_barrier(domain_.floors.lengths(mesh_, h), edge, s);
    slopes_[h] = {s.l, s.dw, s.left.g};
    if (twin.valid()) slopes_[twin] = {s.l, -s.dw, s.right.g};
  }

  template <class PointIn>
  [[nodiscard]] WeightedPoint collected(VertexId v, const PointIn& point_in) const {
    const WeightedPoint center = mesh_.point(v);
    const auto from = seen_from(point_in(center));
    CornerVector<double> sum = {0, 0, 0};
    for (const HalfedgeId h : mesh_.star(v)) {
      const HalfedgeId next = Mesh::next(h), last = Mesh::prev(h);
      const auto q = point_in(mesh_.point(mesh_.target(h), center)),
                 r = point_in(mesh_.point(mesh_.origin(last), center));
      const auto a = spoke(from, q), b = spoke(from, r);
      const auto to = heights_at_corner(a, b, triangle_shape(a, b, q, r).inverse_area);
      sum = sum + (slopes_[h].g * to.pq + slopes_[next].g * to.qr + slopes_[last].g * to.rp);
      sum = sum + by_l2_and_dw(slopes_[h].l, gradient_of_l2(a), slopes_[h].dw);
      if (mesh_.is_boundary(last)) sum = sum + by_l2_and_dw(slopes_[last].l, gradient_of_l2(b), -slopes_[last].dw);
    }
    return {sum.x, sum.y, sum.w};
  }

  const Mesh& mesh_;
  const AccuracyDomain& domain_;
  const AccuracyModel& model_;
  IdVector<HalfedgeId, double> heights_;  // g
  IdVector<HalfedgeId, HalfedgeSlopes> slopes_;
};

}  // namespace

IdVector<VertexId, WeightedPoint> accuracy_gradient(const Mesh& mesh, const AccuracyDomain& domain,
                                                    const AccuracyModel& model, Executor* executor) {
  const GradientSum sum(mesh, domain, model, executor);
  IdVector<VertexId, WeightedPoint> gradient(mesh.n_vertices());
  for_each_index(mesh.n_vertices(), executor, [&](std::size_t i) {
    if (!mesh.is_isolated(VertexId(i))) gradient[VertexId(i)] = sum.at(VertexId(i));
  });
  return gradient;
}

}  // namespace temper
