#include "energy/accuracy_energy.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/assert.hpp"
#include "base/sum.hpp"
#include "energy/accuracy_star.hpp"
#include "geometry/triangle_kernel.hpp"
#include "mesh/blocks.hpp"
#include "mesh/edge_lengths.hpp"
#include "mesh/predicates.hpp"

namespace temper {
namespace {

// An edge that is shorter than its floor stays longer than this part of its length.
constexpr double kKeptLength = 0.9;
// The barrier of such an edge rises by this factor with each sweep, up to a limit. A smaller factor leaves it where the
// energy holds it; a larger factor pushes its neighbors below their floors.
constexpr double kUrgency = 2, kMostUrgent = 100;
// The aim is this factor times the requested length, since the last sweep changes local sizes once more.
constexpr double kAim = 1.08;
// An edge that has become longer by this part has gained.
constexpr double kGain = 1e-3;

double squared(double x) { return x * x; }

// Below this part of ℓ a height is mostly rounding, and its logarithm, too.
constexpr double kLeastMargin = 1e-9;

template <class In>
typename In::Point point_of(const WeightedPoint& p) {
  return {p.x, p.y, p.w};
}
WeightedPoint as_vertex(const PointOf<double>& p) { return {p.x, p.y, p.w}; }
WeightedPoint as_vertex(const WeightedVectorOf<double>& p) { return {p.x, p.y, p.z}; }

}  // namespace

std::size_t LengthFloors::raise(const Mesh& mesh, const IdVector<VertexId, double>& sizes, const AccuracyModel& model,
                                Executor* executor) {
  if (floors_.empty()) floors_.resize(mesh.n_halfedges());
  const auto raise_one = [&](HalfedgeId h) {
    const double s = sizes[mesh.origin(h)], t = sizes[mesh.target(h)], aim = kAim * 0.5 * (s + t);
    const double least_edge = aim * model.min_edge, least_dual = aim * model.min_dual;
    const auto [edge, dual] = edge_lengths(mesh, h);
    const bool lacks = edge <= least_edge || dual <= least_dual;
    const double usual = model.barrier / edge_scale(s, t);
    LengthBarrier<double>& floor = floors_[h];
    const LengthBarrier<double> before = floor;
    floor.factor = lacks ? std::min(kUrgency * std::max(before.factor, usual), kMostUrgent * usual) : usual;
    floor.l2 = std::max(before.l2, squared(std::min(least_edge, kKeptLength * edge)));
    floor.dual2 = std::max(before.dual2, squared(std::clamp(kKeptLength * dual, 0.0, least_dual)));
    return lacks && (floor.l2 > (1 + kGain) * before.l2 || floor.dual2 > (1 + kGain) * before.dual2);
  };
  return static_cast<std::size_t>(blockwise_sum(mesh.n_halfedges(), executor, [&](std::size_t i) {
    const HalfedgeId h(i);
    return mesh.is_edge_representative(h) && !mesh.is_boundary(h) && raise_one(h) ? 1.0 : 0.0;
  }));
}

AccuracyModel AccuracyModel::of(double alpha, double beta, double offset, double boundary_offset) {
  AccuracyModel model;
  model.length = 0.25 * alpha, model.dual = 0.25 * beta;
  model.crossing = 0.75 * offset * alpha;
  model.height = 0.75 * offset * beta, model.boundary_height = 0.75 * boundary_offset * beta;
  return model;
}

double triangle_margin(const Mesh& mesh, TriangleId t) {
  const auto [p, q, r] = mesh.points(t);
  const TriangleShape shape = triangle_shape(mesh.space(), p, q, r);
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
  TEMPER_ASSERT(first || margin == margin_);
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
    return now > margin_ ? margin_ : std::max(before, kept_margin(now, margin_));
  };
  std::vector<double>& floors = blocks_[block];
  if (first) floors.assign(std::min(kBlock, size_ - block * kBlock), 0.0);
  std::size_t count = 0;
  for (std::size_t i = 0; i < floors.size(); ++i) {
    const double before = std::exchange(floors[i], raised(TriangleId(block * kBlock + i), floors[i]));
    count += floors[i] > before ? 1 : 0;
  }
  if (std::all_of(floors.begin(), floors.end(), [&](double floor) { return floor == margin_; })) {
    floors = std::vector<double>();  // {} would keep its room
  }
  return count;
}

std::size_t AccuracyFloors::memory_bytes() const {
  std::size_t bytes = blocks_.size() * sizeof(std::vector<double>);
  for (const std::vector<double>& block : blocks_) bytes += block.capacity() * sizeof(double);
  return bytes;
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
