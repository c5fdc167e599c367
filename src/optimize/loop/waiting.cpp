// A vertex that moves far meets the opposite side of a triangle. The side flips on the way, since the edges around the
// vertex stop being regular no later than the triangle turns over, unless a line is there.
//
//          c                      c
//        / | \                  /   \          v moves to the right, to a place beyond bc: half of the way, and half of
//       v -|-> *      →        v -----> *      the rest, until bc has flipped
//        \ | /                  \   /
//          b                      b
#include "optimize/loop/waiting.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "base/sort_unique.hpp"
#include "base/text.hpp"
#include "geometry/surface.hpp"
#include "optimize/loop/resizing.hpp"
#include "regularity/hidden.hpp"
#include "regularity/lawson.hpp"
#include "temper/topology.hpp"

namespace temper {
namespace {

// A vertex that has moved so often ends with an error, and one whose way is cut so often.
constexpr int kMostSteps = 10'000, kMostHalvings = 40;
// Rounds in which hidden vertices get more weight, before all weights become 0.
constexpr int kRoundsOfWeights = 32;

bool is_upright(const Mesh& mesh, TriangleId t) {
  const auto [a, b, c] = mesh.corners(t);
  return inlined::orientation(mesh, a, b, c) == Sign::positive;
}
bool is_upright(const Mesh& mesh, VertexId v) {
  for (const HalfedgeId h : mesh.star(v)) {
    if (!is_upright(mesh, Mesh::triangle(h))) return false;
  }
  return true;
}

class Changing {
 public:
  Changing(Mesh mesh, const InputNames* names)
      : mesh_(std::move(mesh)), n_before_(mesh_.n_vertices()), names_(names != nullptr ? *names : from_0_) {}

  std::optional<InputError> make(const WaitingChanges& waiting) {
    if (auto error = check(waiting)) return error;
    if (auto error = move(waiting)) return error;
    for (const auto& [v, w] : waiting.weighed) mesh_.set_weight(v, w);
    for (const auto& [v, w] : waiting.weighed) flip_around(v);
    for (const VertexId v : waiting.removed) {
      if (auto error = remove(v)) return error;
    }
    for (const Vec3 place : waiting.inserted) {
      if (auto error = insert(place)) return error;
    }
    if (waiting.sizes) has_removed_ = resize(mesh_, *waiting.sizes, n_before_) || has_removed_;
    return std::nullopt;
  }

  ChangedTriangles take() {
    ChangedTriangles result;
    const bool changes_numbers = has_removed_ || mesh_.n_vertices() > n_before_;
    if (changes_numbers) {
      result.numbers = has_removed_ ? mesh_.compact().vertices : all_vertices();
      for (VertexId& v : result.numbers) {
        if (v.index >= n_before_) v = VertexId();
      }
    }
    result.mesh = std::move(mesh_);
    return result;
  }

 private:
  [[nodiscard]] InputError error(ErrorCode code, VertexId v, const std::string& message) const {
    return {code, names_.point_where(v.index), names_.point(v.index) + " " + message};
  }
  [[nodiscard]] std::string shown(Vec3 place) const {
    const Vec2 p = mesh_.space().as_shown(place);
    return "(" + to_text(p.x) + ", " + to_text(p.y) + ")";
  }
  /// As for OptimizeOptions::size_field.
  [[nodiscard]] bool has_space_of(const Mesh& field) const {
    if (mesh_.space().kind() != field.space().kind()) return false;
    return !mesh_.space().is_periodic() || mesh_.space() == field.space();
  }
  [[nodiscard]] static bool is_exact(Vec3 p) {
    return is_exact_coordinate(p.x) && is_exact_coordinate(p.y) && is_exact_coordinate(p.z);
  }
  [[nodiscard]] WeightedPoint at(Vec3 place, double w) const {
    return mesh_.space().in_domain(mesh_.space().vertex_at(place, w));
  }

  [[nodiscard]] std::optional<InputError> check(const WaitingChanges& waiting) const;
  std::optional<InputError> move(const WaitingChanges& waiting);
  std::vector<VertexId> move_at_once(const std::map<VertexId, Vec3>& places);
  bool walk(VertexId v, Vec3 place);
  void flip_around(VertexId v);
  void show_hidden();
  std::optional<InputError> remove(VertexId v);
  std::optional<InputError> insert(Vec3 place);
  [[nodiscard]] IdVector<VertexId, VertexId> all_vertices() const {
    IdVector<VertexId, VertexId> all;
    for (const VertexId v : mesh_.vertices()) all.push_back(v);
    return all;
  }

  Mesh mesh_;
  std::size_t n_before_;
  InputNames from_0_;
  const InputNames& names_;
  Lawson lawson_;
  RemovalPlan removal_;
  InsertionPlan insertion_;
  bool has_removed_ = false;
};

std::optional<InputError> Changing::check(const WaitingChanges& waiting) const {
  const auto is_there = [&](VertexId v) { return v.index < mesh_.n_vertices(); };
  const auto refused = [&](VertexId v) -> std::optional<InputError> {
    if (!is_there(v))
      return InputError{ErrorCode::index_out_of_range,
                        {},
                        "vertex " + std::to_string(v.index) + " is not in the mesh; expected numbers below " +
                            std::to_string(mesh_.n_vertices())};
    if (!mesh_.is_frozen(v)) return std::nullopt;
    return error(ErrorCode::invalid_option, v, "keeps its place and weight, since a face depends on them");
  };
  const auto not_finite = [&](const std::string& what) {
    return InputError{ErrorCode::not_finite, {}, what + "; expected finite numbers in the range of exact arithmetic"};
  };
  for (const auto& [v, place] : waiting.moved) {
    if (auto e = refused(v)) return e;
    if (!is_exact(place)) return not_finite(names_.point(v.index) + " moves to " + shown(place));
  }
  for (const auto& [v, w] : waiting.weighed) {
    if (auto e = refused(v)) return e;
    if (!is_exact_weight(w)) return not_finite(names_.point(v.index) + " gets the weight " + to_text(w));
  }
  for (const VertexId v : waiting.removed) {
    if (auto e = refused(v)) return e;
  }
  for (const Vec3 place : waiting.inserted) {
    if (!is_exact(place)) return not_finite("a new vertex is at " + shown(place));
  }
  if (waiting.sizes && !has_space_of(waiting.sizes->mesh()))
    return InputError{ErrorCode::invalid_option, {}, "the size field lies in another space than the mesh"};
  return std::nullopt;
}

std::optional<InputError> Changing::move(const WaitingChanges& waiting) {
  if (waiting.moved.empty()) return std::nullopt;
  std::map<VertexId, Vec3> places;  // the last one of each vertex
  for (const auto& [v, place] : waiting.moved) places[v] = place;
  const std::vector<VertexId> left = move_at_once(places);
  for (const auto& [v, place] : places) flip_around(v);
  for (const VertexId v : left) {
    const Vec3 place = places[v];
    if (walk(v, place)) continue;
    return error(ErrorCode::overlap, v,
                 "cannot move to " + shown(place) +
                     ": the boundary, a line or another vertex is on its way. Next: move it less far, or remove it and "
                     "insert another one");
  }
  return std::nullopt;
}

/// Moves all vertices, and puts those back that have a triangle turned over. Returns these, ascending.
std::vector<VertexId> Changing::move_at_once(const std::map<VertexId, Vec3>& places) {
  std::vector<std::pair<VertexId, WeightedPoint>> before;
  for (const auto& [v, place] : places) {
    before.emplace_back(v, mesh_.point(v));
    mesh_.set_point(v, at(place, mesh_.weight(v)));
  }
  std::vector<VertexId> left;
  for (bool put_back = true; put_back;) {
    put_back = false;
    for (const auto& [v, from] : before) {
      if (mesh_.point(v) == from || is_upright(mesh_, v)) continue;
      mesh_.set_point(v, from);
      left.push_back(v);
      put_back = true;
    }
  }
  sort_unique(left);
  return left;
}

/// Moves one vertex, as far at a time as its triangles allow. False: something is on its way.
bool Changing::walk(VertexId v, Vec3 place) {
  const Surface surface(mesh_.space());
  const WeightedPoint to = at(place, mesh_.weight(v));
  int halvings = 0;
  for (int i = 0; i < kMostSteps && halvings < kMostHalvings; ++i) {
    const WeightedPoint from = mesh_.point(v);
    const WeightedPoint image = mesh_.space().image(to, from);
    const Vec3 a = surface.place(from), b = surface.place(image);
    const double part = std::ldexp(1.0, -halvings);
    mesh_.set_point(v, halvings == 0 ? to : at(surface.between(a, b, part), mesh_.weight(v)));
    if (!is_upright(mesh_, v)) {
      mesh_.set_point(v, from);
      ++halvings;
      continue;
    }
    flip_around(v);
    if (halvings == 0) return true;
    halvings = std::max(0, halvings - 2);  // flips have made room
  }
  return false;
}

void Changing::flip_around(VertexId v) {
  lawson_.clear();
  lawson_.push_star(mesh_, v);
  lawson_.run(mesh_);
  if (!lawson_.stuck(mesh_).empty()) show_hidden();
}

/// Gives hidden vertices more weight, and flips again. At a stuck edge the hidden end is inside the triangle of the
/// other corners of the quad. With the weight that these have there it is not hidden by them.
void Changing::show_hidden() {
  for (int i = 0; i < kRoundsOfWeights && !lawson_.stuck(mesh_).empty(); ++i) {
    std::map<VertexId, double> weights;
    for (const HalfedgeId h : lawson_.stuck(mesh_)) {
      const VertexId v = reflex_end(mesh_, h);
      const auto [a, b, c, d] = inlined::quad(mesh_, h);
      const auto [p, q, r] = v == a ? mesh_.points(b, c, d) : mesh_.points(a, c, d);
      const WeightedPoint here = mesh_.space().image(mesh_.point(v), p);
      const double w = mesh_.space().weight(with_interpolated_weight(mesh_.space(), here, p, q, r));
      const auto at = weights.emplace(v, w).first;
      at->second = std::max(at->second, w);
    }
    lawson_.clear();
    for (const auto& [v, w] : weights) {
      if (mesh_.is_frozen(v)) continue;
      mesh_.set_weight(v, std::max(w, mesh_.weight(v)));
      lawson_.push_star(mesh_, v);
    }
    lawson_.run(mesh_);
  }
  if (lawson_.stuck(mesh_).empty()) return;
  for (const VertexId v : mesh_.vertices()) {
    if (!mesh_.is_frozen(v)) mesh_.set_weight(v, 0);
  }
  lawson_.clear();
  lawson_.push_all(mesh_);
  lawson_.run(mesh_);
}

std::optional<InputError> Changing::remove(VertexId v) {
  if (mesh_.is_isolated(v)) return std::nullopt;  // removed already
  removal_ = plan_removal(mesh_, v, std::move(removal_));
  switch (removal_.status) {
    case RemovalStatus::possible:
      break;
    case RemovalStatus::fixed:
      return error(ErrorCode::invalid_option, v, "cannot be removed: it is fixed");
    case RemovalStatus::boundary_corner:
      return error(ErrorCode::invalid_option, v, "cannot be removed: the boundary has a corner there");
    case RemovalStatus::constrained:
      return error(ErrorCode::invalid_option, v, "cannot be removed: lines or regions meet there");
    case RemovalStatus::no_triangulation:
      return error(ErrorCode::invalid_option, v, "cannot be removed: its neighbors have no triangulation without it");
  }
  remove_vertex(mesh_, removal_);
  has_removed_ = true;
  lawson_.clear();
  lawson_.push_removal(mesh_, removal_);
  lawson_.run(mesh_);
  return std::nullopt;
}

/// Inserts a vertex with the weight that its triangle has there, so that it is not hidden.
std::optional<InputError> Changing::insert(Vec3 place) {
  const WeightedPoint p = at(place, 0);
  TriangleId near(0);
  if (insertion_.triangle.valid() && insertion_.triangle.index < mesh_.n_triangles()) near = insertion_.triangle;
  while (mesh_.is_erased(near)) near = TriangleId((near.index + 1) % mesh_.n_triangles());
  insertion_ = plan_insertion(mesh_, p, near, std::move(insertion_));
  const auto refused = [&](const std::string& why) {
    return InputError{ErrorCode::overlap, {}, "no vertex can be inserted at " + shown(place) + ": " + why};
  };
  if (insertion_.status == InsertionStatus::outside) return refused("this is outside the mesh");
  if (insertion_.status == InsertionStatus::at_vertex) return refused("a vertex is there");
  const HalfedgeId edge = insertion_.edge;
  const TriangleId t = insertion_.triangle;
  const auto [a, b, c] = mesh_.points(t);
  const WeightedPoint q = with_interpolated_weight(mesh_.space(), mesh_.space().image(p, a), a, b, c);
  const bool on_line = edge.valid() && mesh_.is_unflippable(edge);
  insertion_ =
      on_line ? plan_split(mesh_, edge, q, std::move(insertion_)) : plan_insertion(mesh_, q, t, std::move(insertion_));
  if (insertion_.status != InsertionStatus::possible && insertion_.status != InsertionStatus::not_regular)
    return refused(insertion_.status == InsertionStatus::in_quadrilateral
                       ? "a quadrilateral is there, which stays whole"
                       : "the mesh has no room there");
  insert_vertex(mesh_, insertion_);
  insertion_.triangle = t;
  return std::nullopt;
}

}  // namespace

Expected<ChangedTriangles> changed(const Mesh& mesh, const WaitingChanges& waiting, const InputNames* names) {
  Changing changing(mesh, names);
  if (waiting.empty()) return changing.take();
  if (auto error = changing.make(waiting)) return *std::move(error);
  return changing.take();
}

}  // namespace temper
