#include "optimize/loop/resizing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "geometry/surface.hpp"
#include "mesh/predicates.hpp"
#include "regularity/lawson.hpp"
#include "size/star_area.hpp"
#include "temper/topology.hpp"

namespace temper {
namespace {

// Size over field: half and double the wanted density of vertices.
constexpr double kLargest = std::numbers::sqrt2, kLeast = 1 / std::numbers::sqrt2;

class Resizing {
 public:
  Resizing(Mesh& mesh, const SizeField& field, std::size_t first_kept)
      : mesh_(mesh), field_(field), first_kept_(first_kept), n_given_(mesh.n_vertices()) {
    for (const VertexId v : mesh.vertices()) wanted_.push_back(wanted_at(mesh.point(v)));
  }

  bool run() {
    bool has_removed = remove_all();
    if (insert_all()) has_removed = remove_all() || has_removed;
    return has_removed;
  }

 private:
  template <class Id>
  using Ranked = std::vector<std::pair<double, Id>>;  // size over field first; ties by number

  [[nodiscard]] double wanted_at(const WeightedPoint& p) {
    const SizeField::Sample sample = field_.at(p, hint_);
    hint_ = sample.triangle;
    return sample.size;
  }
  [[nodiscard]] double size_over_field(TriangleId t) const { return size_over_field(mesh_.corners(t)); }
  [[nodiscard]] double size_over_field(const std::array<VertexId, 3>& corners) const {
    const auto [a, b, c] = corners;
    const auto [p, q, r] = mesh_.points(a, b, c);
    const double squared = 2 * std::numbers::inv_sqrt3 * unsigned_doubled_area(mesh_.space(), p, q, r);
    return 3 * std::sqrt(squared) / (wanted_[a] + wanted_[b] + wanted_[c]);
  }
  [[nodiscard]] double length_over_field(VertexId a, VertexId b) const {
    const double length = distance(mesh_.space(), mesh_.point(a), mesh_.point(b, mesh_.point(a)));
    return 2 * length / (wanted_[a] + wanted_[b]);
  }
  [[nodiscard]] double length_over_field(HalfedgeId h) const {
    return length_over_field(mesh_.origin(h), mesh_.target(h));
  }
  [[nodiscard]] bool may_split(HalfedgeId h) const {
    return !mesh_.is_frozen(mesh_.origin(h)) && !mesh_.is_frozen(mesh_.target(h));
  }

  [[nodiscard]] bool stays(VertexId v) const {
    return mesh_.is_isolated(v) || (v.index >= first_kept_ && v.index < n_given_);
  }
  bool remove_all() {
    bool some = false;
    while (remove_some()) some = true;
    return some;
  }
  bool insert_all() {
    bool some = false;
    for (std::size_t n = 1; n > 0;) {
      n = split_lines();
      n += insert_some();
      some = some || n > 0;
    }
    return some;
  }
  bool remove_some();
  [[nodiscard]] bool joins_long_lines(VertexId v) const;
  bool remove(VertexId v);
  std::size_t split_lines();
  std::size_t insert_some();
  bool insert_in(TriangleId t);
  bool split(HalfedgeId h);
  bool insert_planned();

  Mesh& mesh_;
  const SizeField& field_;
  std::size_t first_kept_, n_given_;
  IdVector<VertexId, double> wanted_;
  TriangleId hint_;
  Lawson lawson_;
  RemovalPlan removal_;
  InsertionPlan insertion_;
};

/// Removes vertices that share no edge, so that the density falls evenly. The next round finds the rest.
bool Resizing::remove_some() {
  Ranked<VertexId> dense;
  for (const VertexId v : mesh_.vertices()) {
    if (stays(v)) continue;
    const double ratio = star_area(mesh_, v).size() / wanted_[v];
    if (ratio < kLeast) dense.emplace_back(ratio, v);
  }
  std::ranges::sort(dense);
  IdVector<VertexId, std::uint8_t> is_neighbor(mesh_.n_vertices(), 0);
  bool some = false;
  for (const auto& [ratio, v] : dense) {
    if (is_neighbor[v] != 0 || joins_long_lines(v) || !remove(v)) continue;
    for (const VertexId u : removal_.link) is_neighbor[u] = 1;
    some = true;
  }
  return some;
}

/// Says whether the removal of a vertex on a line would make an edge there that is split again.
bool Resizing::joins_long_lines(VertexId v) const {
  std::vector<VertexId> ends;
  for (const HalfedgeId h : mesh_.star(v)) {
    if (mesh_.is_unflippable(h)) ends.push_back(mesh_.target(h));
    const HalfedgeId before = Mesh::prev(h);
    if (mesh_.is_boundary(before)) ends.push_back(mesh_.origin(before));
  }
  return ends.size() == 2 && length_over_field(ends[0], ends[1]) > kLargest;
}

bool Resizing::remove(VertexId v) {
  removal_ = plan_removal(mesh_, v, std::move(removal_));
  const auto is_large = [&](const std::array<VertexId, 3>& corners) { return size_over_field(corners) > kLargest; };
  if (removal_.status != RemovalStatus::possible || std::ranges::any_of(removal_.triangles, is_large)) return false;
  remove_vertex(mesh_, removal_);
  lawson_.clear();
  lawson_.push_removal(mesh_, removal_);
  lawson_.run(mesh_);
  return true;
}

std::size_t Resizing::split_lines() {
  Ranked<HalfedgeId> long_ones;
  for (const HalfedgeId h : mesh_.halfedges()) {
    if (mesh_.is_erased(Mesh::triangle(h)) || !mesh_.is_edge_representative(h) || !mesh_.is_unflippable(h)) continue;
    const double ratio = length_over_field(h);
    if (ratio > kLargest && may_split(h)) long_ones.emplace_back(-ratio, h);
  }
  std::ranges::sort(long_ones);
  std::size_t n = 0;
  for (const auto& [ratio, h] : long_ones) {
    // An insertion may have put another edge into the slot.
    if (mesh_.is_unflippable(h) && length_over_field(h) > kLargest && split(h)) ++n;
  }
  return n;
}

std::size_t Resizing::insert_some() {
  Ranked<TriangleId> large;
  for (const TriangleId t : mesh_.triangles()) {
    if (mesh_.is_erased(t)) continue;
    const double ratio = size_over_field(t);
    if (ratio > kLargest) large.emplace_back(-ratio, t);
  }
  std::ranges::sort(large);
  std::size_t n = 0;
  for (const auto& [ratio, t] : large) {
    if (size_over_field(t) > kLargest && insert_in(t)) ++n;
  }
  return n;
}

/// Inserts a vertex at the center of the circle through the corners, as in Delaunay refinement. If the center is
/// outside, or the longest edge is on a line, it goes on the longest edge.
bool Resizing::insert_in(TriangleId t) {
  const Space& space = mesh_.space();
  const auto [a, b, c] = mesh_.points(t);
  const auto bare = [&](const WeightedPoint& p) { return space.with_weight(p, 0); };
  const WeightedPoint center = orthocenter(space, bare(a), bare(b), bare(c));
  const auto is_left = [&](const WeightedPoint& p, const WeightedPoint& q) {
    return orientation(space, p, q, center) == Sign::positive;
  };
  HalfedgeId longest = Mesh::halfedge(t, 0);
  for (int k = 1; k < 3; ++k) {
    if (length_over_field(Mesh::halfedge(t, k)) > length_over_field(longest)) longest = Mesh::halfedge(t, k);
  }
  const bool is_inside = is_left(a, b) && is_left(b, c) && is_left(c, a);
  if (!is_inside || mesh_.is_unflippable(longest)) return may_split(longest) && split(longest);
  const WeightedPoint p = with_interpolated_weight(space, center, a, b, c);
  insertion_ = plan_insertion(mesh_, p, t, std::move(insertion_));
  return insert_planned();
}

bool Resizing::split(HalfedgeId h) {
  insertion_ = plan_split(mesh_, h, 0.5, std::move(insertion_));
  return insert_planned();
}

bool Resizing::insert_planned() {
  if (insertion_.status != InsertionStatus::possible) return false;
  const VertexId v = insert_vertex(mesh_, insertion_);
  mesh_.set_point(v, mesh_.space().in_domain(mesh_.point(v)));
  wanted_.push_back(wanted_at(mesh_.point(v)));
  return true;
}

}  // namespace

bool resize(Mesh& mesh, const SizeField& field, std::size_t first_kept) {
  return Resizing(mesh, field, first_kept).run();
}

}  // namespace temper
