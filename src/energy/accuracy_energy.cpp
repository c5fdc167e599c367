#include "energy/accuracy_energy.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/sum.hpp"
#include "geometry/triangle_kernel.hpp"
#include "mesh/blocks.hpp"
#include "mesh/predicates.hpp"

namespace temper {
namespace {

// The part of its margin that a triangle with less than ε keeps at least: the barrier must be finite where it is.
constexpr double kKept = 0.9;
// Below this part of ℓ a height is mostly rounding, and so would be its logarithm.
constexpr double kLeastMargin = 1e-9;

/// The edge that the halfedge stands for, which is `inner` in its triangle; without scale and q.
AccuracyEdge<double> edge_of(const Mesh& mesh, HalfedgeId h, const EdgeShape& inner) {
  const HalfedgeId twin = mesh.twin(h);
  double outer = 0;
  if (twin.valid()) {
    const auto [b, a, d] = mesh.points(mesh.target(h), mesh.origin(h), mesh.opposite(twin));
    outer = triangle_shape(mesh.space(), b, a, d).edges[0].g;
  }
  return {0, 0, inner.l2, 1 / inner.l2, inner.dw, inner.g, outer};
}

double edge_energy(const Mesh& mesh, const VertexSizes& sizes, const AccuracyModel& model, HalfedgeId h,
                   const EdgeShape& inner) {
  AccuracyEdge<double> edge = edge_of(mesh, h, inner);
  edge.scale = edge_scale(sizes[mesh.origin(h)], sizes[mesh.target(h)]);
  edge.height = mesh.twin(h).valid() ? model.height : model.boundary_height;
  return edge_value(model, edge);
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
  const auto [p, q, r] = mesh.points(t);
  return triangle_shape(mesh.space(), p, q, r);
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

/// Of the edges that a halfedge of t stands for, between triangles that have a floor.
double own_length_barriers(const Mesh& mesh, const AccuracyFloors& floors, TriangleId t, const TriangleShape& shape) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const HalfedgeId h = Mesh::halfedge(t, k), twin = mesh.twin(h);
    if (!twin.valid() || !mesh.is_edge_representative(h)) continue;
    if (!floors.has(t) || !floors.has(Mesh::triangle(twin))) continue;
    const EdgeShape& inner = shape.edges[static_cast<std::size_t>(k)];
    sum += length_barrier(floors.lengths(mesh, h), edge_of(mesh, h, inner));
  }
  return sum;
}

template <class In>
typename In::Point point_of(const WeightedPoint& p) {
  return {p.x, p.y, p.w};
}
WeightedPoint as_vertex(const PointOf<double>& p) { return {p.x, p.y, p.w}; }
WeightedPoint as_vertex(const LiftedPointOf<double>& p) { return {p.x, p.y, p.z}; }

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

double triangle_margin(const Mesh& mesh, TriangleId t) {
  const TriangleShape shape = shape_of(mesh, t);
  double least = shape.doubled_area > 0 ? kInfinity : -kInfinity;
  for (const EdgeShape& e : shape.edges) least = std::min({least, e.g / e.l2, 0.5 * (1 - std::abs(e.dw) / e.l2)});
  return least;
}

bool has_margins(const Mesh& mesh, double margin, Executor* executor) {
  return !first_index(mesh.n_triangles(), executor, [&](std::size_t i) {
    const TriangleId t(i);
    return !(triangle_margin(mesh, t) > margin) || !inlined::is_well_centered(mesh, t);
  });
}

std::size_t AccuracyFloors::raise(const Mesh& mesh, double margin, Executor* executor) {
  static_assert(kBlockSize % kBlock == 0);  // so threads share none
  const bool first = size_ == 0;
  size_ = mesh.n_triangles();
  margin_ = margin;
  blocks_.resize((size_ + kBlock - 1) / kBlock);
  return static_cast<std::size_t>(sum_of_blocks(size_, executor, [&](std::size_t of_sum) {
    constexpr std::size_t kEach = kBlockSize / kBlock;
    std::size_t raised = 0;
    for (std::size_t b = of_sum * kEach; b < std::min(blocks_.size(), (of_sum + 1) * kEach); ++b) {
      if (first || !blocks_[b].empty()) raised += raise_block(mesh, b, first);
    }
    return static_cast<double>(raised);
  }));
}

std::size_t AccuracyFloors::raise_block(const Mesh& mesh, std::size_t block, bool first) {
  const auto raised = [&](TriangleId t, double before) {
    const bool may_have_one = first ? inlined::is_well_centered(mesh, t) : before > 0;
    if (!may_have_one || before == margin_) return before;
    const double now = triangle_margin(mesh, t);
    if (first && now < kLeastMargin) return before;
    return now > margin_ ? margin_ : std::max(before, kKept * now);
  };
  std::vector<double>& floors = blocks_[block];
  if (first) floors.assign(std::min(kBlock, size_ - block * kBlock), 0.0);
  std::size_t count = 0;
  for (std::size_t i = 0; i < floors.size(); ++i) {
    const double before = std::exchange(floors[i], raised(TriangleId(block * kBlock + i), floors[i]));
    count += floors[i] > before ? 1 : 0;
  }
  if (std::all_of(floors.begin(), floors.end(), [&](double floor) { return floor == margin_; })) floors = {};
  return count;
}

void AccuracyFloors::visit(Archive& archive) {
  std::vector<double> all(size_);
  for (std::size_t i = 0; i < size_; ++i) all[i] = (*this)[TriangleId(i)];
  archive(all, lengths);
  if (!archive.reads()) return;
  size_ = all.size();
  blocks_.clear();
  for (std::size_t begin = 0; begin < size_; begin += kBlock) {
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(begin);
    blocks_.emplace_back(first, first + static_cast<std::ptrdiff_t>(std::min(kBlock, size_ - begin)));
  }
}

namespace {

/// The barriers of a block of triangles; visit(t, shape) is told of each.
template <class Visit>
double barriers_of_block(const Mesh& mesh, const VertexSizes& sizes, const AccuracyFloors& floors,
                         const AccuracyModel& model, std::size_t block, Visit&& visit) {
  double barrier = 0, of_lengths = 0;
  const std::size_t end = std::min(mesh.n_triangles(), (block + 1) * kBlockSize);
  for (std::size_t i = block * kBlockSize; i < end; ++i) {
    const TriangleId t(i);
    const TriangleShape shape = shape_of(mesh, t);
    visit(t, shape);
    if (model.keeps_lengths()) of_lengths += own_length_barriers(mesh, floors, t, shape);
    if (!floors.has(t)) continue;
    const auto [p, q, r] = mesh.corners(t);
    barrier -= triangle_scale(sizes[p], sizes[q], sizes[r]) * triangle_logarithm(shape, floors[t]);
  }
  return model.barrier * barrier + of_lengths;
}

}  // namespace

AccuracyTotal accuracy_total(const Mesh& mesh, const VertexSizes& sizes, const AccuracyFloors& floors,
                             const AccuracyModel& model, Executor* executor) {
  const auto sums = sums_of_blocks(mesh.n_triangles(), 2, executor, [&](std::size_t block, std::span<double> of_block) {
    double sum = 0;
    of_block[1] = barriers_of_block(mesh, sizes, floors, model, block, [&](TriangleId t, const TriangleShape& shape) {
      for_own_edges(mesh, sizes, model, t, shape, [&](double of_edge) { sum += of_edge; });
    });
    of_block[0] = sum;
  });
  return {sums[0], sums[1]};
}

double accuracy_barrier(const Mesh& mesh, const VertexSizes& sizes, const AccuracyFloors& floors,
                        const AccuracyModel& model, Executor* executor) {
  const auto sums = sums_of_blocks(mesh.n_triangles(), 1, executor, [&](std::size_t block, std::span<double> of_block) {
    of_block[0] = barriers_of_block(mesh, sizes, floors, model, block, [](TriangleId, const TriangleShape&) {});
  });
  return sums[0];
}

template <class In>
AccuracyStarOf<In> AccuracyPatch::Star<In>::view(const AccuracyModel& model, bool open) {
  const auto n = static_cast<double>(triangles.size());
  return {model, spokes.data(), triangles.data(), triangles.size(), n, n + (open ? 1 : 0), open};
}

bool AccuracyPatch::gather(const Mesh& mesh, const VertexSizes& sizes, const AccuracyFloors& floors,
                           const AccuracyModel& model, VertexId v) {
  space_ = mesh.space();
  model_ = &model;
  open_ = mesh.is_boundary(v);
  std::size_t n = 0;
  for (const HalfedgeId h : mesh.star(v)) {
    const HalfedgeId across = mesh.twin(Mesh::next(h));
    if (!floors.has(Mesh::triangle(h)) || (across.valid() && !floors.has(Mesh::triangle(across)))) return false;
    ++n;
  }
  const auto set = [&]<class In>(Star<In>& storage) {
    storage.triangles.resize(n);
    storage.spokes.resize(n + 1);
    const AccuracyStarOf<In> star = storage.view(model, open_);
    const double own = sizes[v];
    const WeightedPoint center = mesh.point(v);
    const auto at = [&](VertexId u) { return SizedPoint<In>{point_of<In>(mesh.point(u, center)), sizes[u]}; };
    const auto lengths = [&](HalfedgeId h) {
      return model.keeps_lengths() && !mesh.is_boundary(h) ? floors.lengths(mesh, h) : LengthBarrier<double>{};
    };
    std::size_t i = 0;
    for (const HalfedgeId h : mesh.star(v)) {
      const HalfedgeId across = mesh.twin(Mesh::next(h));
      star.spokes[i].lengths = lengths(h);
      star.spokes[i + 1].lengths = lengths(Mesh::prev(h));
      star.triangles[i].link_lengths = lengths(Mesh::next(h));
      const SizedPoint<In> q = at(mesh.target(h)), r = at(mesh.opposite(h));
      const auto o = across.valid() ? point_of<In>(mesh.point(mesh.opposite(across), center)) : typename In::Point{};
      if (i == 0) set_spoke(star, 0, own, q);
      set_triangle(star, i, own, q, r, floors[Mesh::triangle(h)], across.valid(), o);
      set_spoke(star, ++i, own, r);
    }
  };
  space_.is_plane() ? set(in_plane_) : set(on_sphere_);
  return true;
}

double AccuracyPatch::value(const WeightedPoint& p) {
  const auto at = [&]<class In>(Star<In>& star) {
    return accuracy_value(star.view(*model_, open_), seen_from(point_of<In>(p)));
  };
  at_ = p;
  return value_ = space_.is_plane() ? at(in_plane_) : at(on_sphere_);
}

VertexDerivatives AccuracyPatch::derivatives() {
  const auto of = [&]<class In>(Star<In>& star) {
    return accuracy_derivatives(star.view(*model_, open_), seen_from(point_of<In>(at_)));
  };
  const auto [g, h] = space_.is_plane() ? of(in_plane_) : of(on_sphere_);
  return {value_, true, {g.x, g.y, g.w}, {h.xx, h.xy, h.xw, h.yy, h.yw, h.ww}};
}

bool AccuracyPatch::is_well_centered(const WeightedPoint& p) const {
  const auto of = [&](const auto& star) {
    for (std::size_t i = 0; i < star.triangles.size(); ++i) {
      const WeightedPoint q = as_vertex(star.spokes[i].q), r = as_vertex(star.spokes[i + 1].q);
      if (!inlined::is_well_centered(space_, p, q, r)) return false;
    }
    return true;
  };
  return space_.is_plane() ? of(in_plane_) : of(on_sphere_);
}

double AccuracyPatch::shortest_spoke(const WeightedPoint& p) const {
  const auto of = [&](const auto& star) {
    double least = kInfinity;
    for (const auto& s : star.spokes) least = std::min(least, edge_measures(space_, p, as_vertex(s.q)).l2);
    return std::sqrt(least);
  };
  return space_.is_plane() ? of(in_plane_) : of(on_sphere_);
}

}  // namespace temper
