#include "energy/accuracy_energy.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/sum.hpp"
#include "geometry/predicates_inline.hpp"
#include "geometry/triangle_kernel.hpp"
#include "mesh/blocks.hpp"

namespace temper {
namespace {

// The part of its margin that a triangle with less than ε keeps at least: the barrier must be finite where it is.
constexpr double kKept = 0.9;
// Below this part of ℓ a height is mostly rounding, and so would be its logarithm.
constexpr double kLeastMargin = 1e-9;

/// The energy of the edge that the halfedge stands for, which is `inner` in its triangle.
double edge_energy(const Mesh& mesh, const VertexSizes& sizes, const AccuracyModel& model, HalfedgeId h,
                   const EdgeShape& inner) {
  const VertexId a = mesh.origin(h), b = mesh.target(h);
  const HalfedgeId twin = mesh.twin(h);
  const double outer =
      twin.valid() ? triangle_shape(mesh.point(b), mesh.point(a), mesh.point(mesh.opposite(twin))).edges[0].g : 0;
  const double height = twin.valid() ? model.height : model.boundary_height;
  return edge_value<double>(model,
                            {edge_scale(sizes[a], sizes[b]), height, inner.l2, 1 / inner.l2, inner.dw, inner.g, outer});
}

/// Its sign and factor μ s_t² apart: the sum of logarithms is one of a product.
double triangle_logarithm(const TriangleShape& shape, double floor) {
  double heights = 1, splits = 1;
  for (const EdgeShape& e : shape.edges) {
    const double inverse_l2 = 1 / e.l2;
    heights *= e.g * inverse_l2 - floor;
    splits *= split_room(e.dw * inverse_l2, floor);
  }
  return 0.5 * portable_log(heights * heights * splits);
}

TriangleShape shape_of(const Mesh& mesh, TriangleId t) {
  const auto [p, q, r] = mesh.corners(t);
  return triangle_shape(mesh.point(p), mesh.point(q), mesh.point(r));
}

/// Calls visit with the energy of each edge that a halfedge of t stands for.
template <class Visit>
void for_own_edges(const Mesh& mesh, const VertexSizes& sizes, const AccuracyModel& model, TriangleId t,
                   const TriangleShape& shape, Visit&& visit) {
  for (int k = 0; k < 3; ++k) {
    const HalfedgeId h = Mesh::halfedge(t, k);
    if (mesh.is_edge_representative(h)) {
      visit(edge_energy(mesh, sizes, model, h, shape.edges[static_cast<std::size_t>(k)]));
    }
  }
}

PointOf<double> point_of(const WeightedPoint& p) { return {p.x, p.y, p.w}; }

}  // namespace

AccuracyModel AccuracyModel::of(double alpha, double beta, double offset, double boundary_offset) {
  AccuracyModel model;
  model.length = 0.25 * alpha, model.dual = 0.25 * beta;
  model.split = 0.75 * offset * alpha;
  model.height = 0.75 * offset * beta, model.boundary_height = 0.75 * boundary_offset * beta;
  return model;
}

double accuracy_energy(const Mesh& mesh, const VertexSizes& sizes, const AccuracyModel& model, Executor* executor) {
  return blockwise_sum(mesh.n_triangles(), executor, [&](std::size_t i) {
    const TriangleId t(i);
    double sum = 0;
    for_own_edges(mesh, sizes, model, t, shape_of(mesh, t), [&](double energy) { sum += std::abs(energy); });
    return sum;
  });
}

double triangle_margin(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  const TriangleShape shape = triangle_shape(p, q, r);
  double least = shape.doubled_area > 0 ? kInfinity : -kInfinity;
  for (const EdgeShape& e : shape.edges) least = std::min({least, e.g / e.l2, 0.5 * (1 - std::abs(e.dw) / e.l2)});
  return least;
}

double triangle_margin(const Mesh& mesh, TriangleId t) {
  const auto [p, q, r] = mesh.corners(t);
  return triangle_margin(mesh.point(p), mesh.point(q), mesh.point(r));
}

bool has_margins(const Mesh& mesh, double margin, Executor* executor) {
  return !first_index(mesh.n_triangles(), executor, [&](std::size_t i) {
    const auto [p, q, r] = mesh.corners(TriangleId(i));
    return !(triangle_margin(mesh, TriangleId(i)) > margin) ||
           !inlined::is_well_centered(mesh.point(p), mesh.point(q), mesh.point(r));
  });
}

std::size_t AccuracyFloors::raise(const Mesh& mesh, double margin, Executor* executor) {
  const bool first = floor_.empty();
  if (first) floor_.resize(mesh.n_triangles(), 0.0);
  const auto raised = [&](TriangleId t) {
    if (first) {
      const auto [p, q, r] = mesh.corners(t);
      if (!inlined::is_well_centered(mesh.point(p), mesh.point(q), mesh.point(r))) return 0.0;
    } else if (!has(t) || floor_[t] == margin) {
      return floor_[t];
    }
    const double now = triangle_margin(mesh, t);
    if (first && now < kLeastMargin) return 0.0;
    return now > margin ? margin : std::max(floor_[t], kKept * now);
  };
  return static_cast<std::size_t>(blockwise_sum(mesh.n_triangles(), executor, [&](std::size_t i) {
    const TriangleId t(i);
    const double before = std::exchange(floor_[t], raised(t));
    return floor_[t] > before ? 1.0 : 0.0;
  }));
}

AccuracyTotal accuracy_total(const Mesh& mesh, const VertexSizes& sizes, const AccuracyFloors& floors,
                             const AccuracyModel& model, Executor* executor) {
  std::vector<double> barriers((mesh.n_triangles() + kBlockSize - 1) / kBlockSize, 0.0);
  const double energy = sum_of_blocks(mesh.n_triangles(), executor, [&](std::size_t block) {
    double sum = 0, barrier = 0;
    const std::size_t end = std::min(mesh.n_triangles(), (block + 1) * kBlockSize);
    for (std::size_t i = block * kBlockSize; i < end; ++i) {
      const TriangleId t(i);
      const TriangleShape shape = shape_of(mesh, t);
      for_own_edges(mesh, sizes, model, t, shape, [&](double of_edge) { sum += of_edge; });
      if (!floors.has(t)) continue;
      const auto [p, q, r] = mesh.corners(t);
      barrier -= triangle_scale(sizes[p], sizes[q], sizes[r]) * triangle_logarithm(shape, floors[t]);
    }
    barriers[block] = model.barrier * barrier;
    return sum;
  });
  return {energy, pairwise_sum(barriers)};
}

AccuracyStarOf<double> AccuracyPatch::star() {
  const auto n = static_cast<double>(triangles_.size());
  return {*model_, spokes_.data(), triangles_.data(), triangles_.size(), n, n + (open_ ? 1 : 0), open_};
}

bool AccuracyPatch::gather(const Mesh& mesh, const VertexSizes& sizes, const AccuracyFloors& floors,
                           const AccuracyModel& model, VertexId v) {
  model_ = &model;
  open_ = mesh.is_boundary(v);
  std::size_t n = 0;
  for (const HalfedgeId h : mesh.star(v)) {
    const HalfedgeId across = mesh.twin(Mesh::next(h));
    if (!floors.has(Mesh::triangle(h)) || (across.valid() && !floors.has(Mesh::triangle(across)))) return false;
    ++n;
  }
  triangles_.resize(n);
  spokes_.resize(n + 1);
  const AccuracyStarOf<double> star = this->star();
  const double own = sizes[v];
  const auto at = [&](VertexId u) { return SizedPoint<double>{point_of(mesh.point(u)), sizes[u]}; };
  std::size_t i = 0;
  for (const HalfedgeId h : mesh.star(v)) {
    const HalfedgeId across = mesh.twin(Mesh::next(h));
    const SizedPoint<double> q = at(mesh.target(h)), r = at(mesh.opposite(h));
    const PointOf<double> o = across.valid() ? point_of(mesh.point(mesh.opposite(across))) : PointOf<double>{};
    if (i == 0) set_spoke(star, 0, own, q);
    set_triangle(star, i, own, q, r, floors[Mesh::triangle(h)], across.valid(), o);
    set_spoke(star, ++i, own, r);
  }
  return true;
}

double AccuracyPatch::value(const WeightedPoint& p) { return value_ = accuracy_value(star(), point_of(p)); }

VertexDerivatives AccuracyPatch::derivatives() {
  const auto [g, h] = accuracy_derivatives(star());
  return {value_, true, {g.x, g.y, g.w}, {h.xx, h.xy, h.xw, h.yy, h.yw, h.ww}};
}

bool AccuracyPatch::is_well_centered(const WeightedPoint& p) const {
  const auto point = [this](std::size_t i) { return WeightedPoint{spokes_[i].q.x, spokes_[i].q.y, spokes_[i].q.w}; };
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    if (!inlined::is_well_centered(p, point(i), point(i + 1))) return false;
  }
  return true;
}

double AccuracyPatch::shortest_spoke(const WeightedPoint& p) const {
  double least = kInfinity;
  for (const AccuracySpoke<double>& s : spokes_) least = std::min(least, spoke(point_of(p), s.q).l2);
  return std::sqrt(least);
}

}  // namespace temper
