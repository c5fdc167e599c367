// replay(): the events of a trace, applied to the user's own mesh.
//
// Replay needs no units and no Hilbert order. A flip or removal keeps the slots of its triangles, and an insertion
// takes the next slots that were never used. So the same events in the same order leave the same slots in any
// numbering. The optimizer's units give coordinates back bit for bit. Removed vertices keep their numbers until the
// mesh is compacted at the end, so the slot of an inserted vertex is its number.
//
// A trace may come from anywhere, so replay checks every event against the mesh before it applies it. It checks
// connectivity, not positions: triangles may turn over, as in the paper. But the triangles that a new vertex cuts must
// be counter-clockwise, before and after.
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "optimize/working/working_units.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/detail/trace.hpp"
#include "temper/topology.hpp"
#include "topology/flip_inline.hpp"

namespace temper {
namespace {

bool undoes_sweeps(const TraceEvent& e) { return e.kind == EventKind::undo && !e.vertex.valid(); }

/// Copies of the mesh at the ends of the sweeps to which events go back.
class SweepStates {
 public:
  explicit SweepStates(std::span<const TraceEvent> events) {
    for (const TraceEvent& e : events) {
      if (undoes_sweeps(e)) states_[e.to_sweep];
    }
  }

  /// Call this for the next event, of `sweep`: all sweeps since the last event's have ended.
  void arrive(int sweep, const Mesh& mesh) {
    for (auto s = states_.lower_bound(sweep_); s != states_.end() && s->first < sweep; ++s) s->second = mesh;
    sweep_ = sweep;
  }

  /// Returns the state at the end of this sweep, or none if it has not ended or was never reached.
  [[nodiscard]] const std::optional<Mesh>& at(int sweep) { return states_[sweep]; }

 private:
  std::map<int, std::optional<Mesh>> states_;
  int sweep_ = -1;  // of the last event; −1: the input
};

InputError misfit(std::string message) { return {ErrorCode::trace_mismatch, {}, std::move(message)}; }

const char* why_not(RemovalStatus status) {
  switch (status) {
    case RemovalStatus::possible:
      break;
    case RemovalStatus::fixed:
      return ", which is fixed";
    case RemovalStatus::boundary_corner:
      return ", which is a corner of the boundary";
    case RemovalStatus::constrained:
      return ", which is on constrained edges";
    case RemovalStatus::no_triangulation:
      return " with triangles that do not fill its cavity";
  }
  return "";
}

/// Does p see a, b, c counter-clockwise: is each of abp, bcp, cap a triangle?
bool is_inside(const Mesh& mesh, const std::array<VertexId, 3>& corners, const WeightedPoint& p) {
  for (std::size_t k = 0; k < 3; ++k) {
    const WeightedPoint a = mesh.point(corners[k], p), b = mesh.point(corners[(k + 1) % 3], p);
    if (orientation(mesh.space(), a, b, p) != Sign::positive) return false;
  }
  return true;
}

/// Can the triangle of h, a → b with c across, be cut from c to p on ab?
bool can_cut(const Mesh& mesh, HalfedgeId h, const WeightedPoint& p) {
  const WeightedPoint a = mesh.point(mesh.origin(h), p), b = mesh.point(mesh.target(h), p),
                      c = mesh.point(mesh.opposite(h), p);
  return orientation(mesh.space(), a, p, c) == Sign::positive && orientation(mesh.space(), p, b, c) == Sign::positive;
}

class Replayer {
 public:
  Replayer(const Mesh& input, const InputNames& names) : mesh_(input), n_input_(input.n_vertices()), names_(names) {}

  std::optional<InputError> apply(const TraceEvent& e) {
    switch (e.kind) {
      case EventKind::move:
      case EventKind::weight:
        return place(e);
      case EventKind::flip:
        return flip_edge(e);
      case EventKind::collapse:
      case EventKind::removal:
        return remove(e);
      case EventKind::insertion:
        return insert(e);
      case EventKind::split:
        return split(e);
      case EventKind::hidden:
        return check_vertex(e.vertex, "hiding");
      case EventKind::undo:
        return check_vertex(e.vertex, "undoing a step");
    }
    return misfit("of no known kind");
  }

  void go_back_to(const Mesh& state) { mesh_ = state; }
  [[nodiscard]] const Mesh& mesh() const { return mesh_; }

  [[nodiscard]] Replay finish(const Mesh& input) && {
    Replay result{std::move(mesh_), {}};
    bool changed = result.mesh.n_vertices() > n_input_;
    for (const VertexId v : result.mesh.vertices()) changed = changed || result.mesh.is_isolated(v);
    if (changed) {
      result.vertices = result.mesh.compact().vertices;
      for (VertexId& v : result.vertices) {
        if (v.index >= n_input_) v = VertexId();
      }
    }
    take_back_rounding(input, result.vertices, result.mesh);
    return result;
  }

 private:
  std::optional<InputError> check_vertex(VertexId v, const char* what) const {
    if (!v.valid()) return misfit(std::string(what) + " without a vertex");
    if (v.index >= mesh_.n_vertices()) {
      return misfit(std::string(what) + " of vertex index " + std::to_string(v.index) + ", but the mesh has " +
                    std::to_string(mesh_.n_vertices()) + " vertices");
    }
    if (mesh_.is_isolated(v)) return misfit(std::string(what) + " of " + point(v) + ", which was removed before");
    return std::nullopt;
  }

  std::optional<InputError> place(const TraceEvent& e) {
    const bool move = e.kind == EventKind::move;
    if (auto error = check_vertex(e.vertex, move ? "move" : "weight")) return error;
    const WeightedPoint p = move ? e.point : WeightedPoint{0, 0, e.point.w};
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.w)) {
      return misfit(std::string(move ? "move" : "weight") + " of " + point(e.vertex) +
                    " to what is not finite; expected finite numbers");
    }
    if (move) {
      mesh_.set_point(e.vertex, p);
    } else {
      mesh_.set_weight(e.vertex, p.w);
    }
    return std::nullopt;
  }

  std::optional<InputError> flip_edge(const TraceEvent& e) {
    for (const VertexId v : e.quad) {
      if (auto error = check_vertex(v, "flip at an edge")) return error;
    }
    const auto [a, b, c, d] = e.quad;
    const std::string flip_of_edge = "flip of the " + edge(a, b);
    const HalfedgeId h = mesh_.find_halfedge(a, b);
    if (!h.valid()) return misfit(flip_of_edge + ", which is not in the mesh");
    if (mesh_.is_boundary(h)) return misfit(flip_of_edge + ", which is on the boundary");
    if (mesh_.is_constrained(h)) return misfit(flip_of_edge + ", which is constrained");
    const VertexId left = mesh_.opposite(h), right = mesh_.opposite(mesh_.twin(h));
    if (left != c || right != d) {
      return misfit(flip_of_edge + " between " + point(c) + " and " + point(d) + ", but it is between " + point(left) +
                    " and " + point(right));
    }
    if (c == d || mesh_.find_halfedge(c, d).valid() || mesh_.find_halfedge(d, c).valid()) {
      return misfit(flip_of_edge + " to one from " + point(d) + " to " + point(c) + ", which is in the mesh already");
    }
    inlined::flip(mesh_, h);
    return std::nullopt;
  }

  std::optional<InputError> remove(const TraceEvent& e) {
    const char* what = e.kind == EventKind::collapse ? "collapse" : "removal";
    if (auto error = check_vertex(e.vertex, what)) return error;
    const std::string removal_of_vertex = std::string(what) + " of " + point(e.vertex);
    if (e.link.empty()) return misfit(removal_of_vertex + " without a link");
    plan_ = removal_from_names(mesh_, e.vertex, e.link.front(), e.triangles, std::move(plan_));
    if (plan_.status != RemovalStatus::possible) return misfit(removal_of_vertex + why_not(plan_.status));
    if (plan_.link != e.link) return misfit(removal_of_vertex + " with a link that is not its own");
    remove_vertex(mesh_, plan_);
    return std::nullopt;
  }

  /// A new vertex must have the next number and a valid place.
  std::optional<InputError> check_new(const TraceEvent& e, const char* what) const {
    if (!e.vertex.valid()) return misfit(std::string(what) + " without a vertex");
    if (e.vertex.index != mesh_.n_vertices()) {
      return misfit(std::string(what) + " of vertex index " + std::to_string(e.vertex.index) +
                    ", but the next new one is " + std::to_string(mesh_.n_vertices()));
    }
    if (!std::isfinite(e.point.x) || !std::isfinite(e.point.y) || !std::isfinite(e.point.w)) {
      return misfit(std::string(what) + " of " + point(e.vertex) + " at what is not finite; expected finite numbers");
    }
    return std::nullopt;
  }

  std::optional<InputError> insert(const TraceEvent& e) {
    if (auto error = check_new(e, "insertion")) return error;
    const std::string insertion_of_vertex = "insertion of " + point(e.vertex);
    if (e.link.size() != 3) return misfit(insertion_of_vertex + " in what is no triangle");
    for (const VertexId v : e.link) {
      if (auto error = check_vertex(v, "insertion in a triangle")) return error;
    }
    const VertexId a = e.link[0], b = e.link[1], c = e.link[2];
    const HalfedgeId h = mesh_.find_halfedge(a, b);
    if (!h.valid() || mesh_.opposite(h) != c) {
      return misfit(insertion_of_vertex + " in the triangle of " + point(a) + ", " + point(b) + " and " + point(c) +
                    ", which is not in the mesh");
    }
    if (!is_inside(mesh_, {a, b, c}, e.point)) {
      return misfit(insertion_of_vertex + ", which is not inside the triangle of " + point(a) + ", " + point(b) +
                    " and " + point(c));
    }
    insert_in_triangle(mesh_, Mesh::triangle(h), e.point);
    return std::nullopt;
  }

  std::optional<InputError> split(const TraceEvent& e) {
    if (auto error = check_new(e, "split")) return error;
    const auto [a, b, c, d] = e.quad;
    for (const VertexId v : {a, b, c, d}) {
      if (v == d && !d.valid()) continue;
      if (auto error = check_vertex(v, "split at an edge")) return error;
    }
    const std::string split_of_edge = "split of the " + edge(a, b);
    const HalfedgeId h = mesh_.find_halfedge(a, b);
    if (!h.valid()) return misfit(split_of_edge + ", which is not in the mesh");
    const VertexId right = mesh_.is_boundary(h) ? VertexId() : mesh_.opposite(mesh_.twin(h));
    if (mesh_.opposite(h) != c || right != d)
      return misfit(split_of_edge + " between other vertices than are beside it");
    if (!can_cut(mesh_, h, e.point) || (d.valid() && !can_cut(mesh_, mesh_.twin(h), e.point))) {
      return misfit(split_of_edge + " at a place that is not on it");
    }
    split_edge(mesh_, h, e.point);
    return std::nullopt;
  }

  [[nodiscard]] std::string point(VertexId v) const { return names_.point(v.index); }
  [[nodiscard]] std::string edge(VertexId a, VertexId b) const { return "edge from " + point(a) + " to " + point(b); }

  Mesh mesh_;
  std::size_t n_input_;
  const InputNames& names_;
  RemovalPlan plan_;
};

InputError at_event(std::size_t index, InputError error) {
  error.where = "event " + std::to_string(index);
  return error;
}

}  // namespace

Expected<Replay> replay_with_vertices(const Mesh& input, std::span<const TraceEvent> events, const InputNames* names) {
  const InputNames numbers_from_0;
  Replayer replayer(input, names != nullptr ? *names : numbers_from_0);
  SweepStates states(events);
  for (std::size_t i = 0; i < events.size(); ++i) {
    const TraceEvent& e = events[i];
    states.arrive(e.sweep, replayer.mesh());
    if (!undoes_sweeps(e)) {
      if (auto error = replayer.apply(e)) return at_event(i, *std::move(error));
    } else if (const auto& state = states.at(e.to_sweep)) {
      replayer.go_back_to(*state);
    } else if (e.to_sweep != e.sweep) {
      return at_event(i, misfit("undo in sweep " + std::to_string(e.sweep) + " to the end of sweep " +
                                std::to_string(e.to_sweep) + ", which has not been"));
    }
  }
  return std::move(replayer).finish(input);
}

Expected<Mesh> replay(const Mesh& input, std::span<const TraceEvent> events) {
  auto result = replay_with_vertices(input, events);
  if (!result) return result.error();
  return std::move(result->mesh);
}

}  // namespace temper
