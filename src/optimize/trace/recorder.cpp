#include "optimize/trace/recorder.hpp"

#include <cmath>

#include "temper/detail/trace.hpp"

namespace temper {

std::span<const std::string_view> words_of(EventKind) {
  static constexpr std::string_view kNames[] = {"move",      "weight", "flip",   "collapse", "removal",
                                                "insertion", "split",  "hidden", "undo"};
  return kNames;
}
std::string_view name(EventKind kind) { return words_of(kind)[static_cast<std::size_t>(kind)]; }

void Recorder::record(TraceEvent e) const {
  if (!on()) return;
  e.sweep = sweep_;
  e.before *= energy_unit_;
  e.after *= energy_unit_;
  const auto name = [this](VertexId& v) {
    if (v.valid()) v = work_.order->vertices[v];
  };
  name(e.vertex);
  for (VertexId& v : e.quad) name(v);
  for (VertexId& v : e.link) name(v);
  for (auto& triangle : e.triangles) {
    for (VertexId& v : triangle) name(v);
  }
  tracer_(e);
}

void Recorder::placed(VertexId v, const WeightedPoint& from, const WeightedPoint& to, double before,
                      double after) const {
  if (!on()) return;
  // A zero may change its sign, and a replay must do so, too.
  const auto differ = [](double x, double y) { return x != y || std::signbit(x) != std::signbit(y); };
  const bool moves = !work_.mesh.space().is_plane() || differ(from.x, to.x) || differ(from.y, to.y);
  record({.kind = moves ? EventKind::move : EventKind::weight,
          .vertex = v,
          .before = before,
          .after = after,
          .point = work_.units.to_user(to)});
}

void Recorder::flipped(std::span<const FlipRecord> flips) const {
  for (const auto& [a, b, c, d, before, after] : flips) {
    record({.kind = EventKind::flip, .before = before, .after = after, .quad = {a, b, c, d}});
  }
}

void Recorder::removed(EventKind kind, const RemovalPlan& plan, double before, double after) const {
  record({.kind = kind,
          .vertex = plan.vertex,
          .before = before,
          .after = after,
          .link = plan.link,
          .triangles = plan.triangles});
}

void Recorder::inserted(VertexId v, const std::array<VertexId, 3>& triangle, double before, double after) const {
  record({.kind = EventKind::insertion,
          .vertex = v,
          .before = before,
          .after = after,
          .point = place(v),
          .link = {triangle.begin(), triangle.end()}});
}

void Recorder::split(VertexId v, const std::array<VertexId, 4>& quad, double before, double after) const {
  record({.kind = EventKind::split, .vertex = v, .before = before, .after = after, .point = place(v), .quad = quad});
}

}  // namespace temper
