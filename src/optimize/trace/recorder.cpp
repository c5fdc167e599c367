#include "optimize/trace/recorder.hpp"

#include "temper/detail/trace.hpp"

namespace temper {

std::string_view name(EventKind kind) {
  constexpr std::string_view kNames[] = {"move",      "weight", "flip",   "collapse", "removal",
                                         "insertion", "split",  "hidden", "undo"};
  return kNames[static_cast<std::size_t>(kind)];
}

/// An event that fill(event) completes, if anybody listens.
template <class Fill>
void Recorder::tell(EventKind kind, double before, double after, Fill&& fill) const {
  if (!on()) return;
  TraceEvent e;
  e.kind = kind;
  e.sweep = sweep_;
  e.before = energy_unit_ * before;
  e.after = energy_unit_ * after;
  fill(e);
  tracer_(e);
}

void Recorder::placed(VertexId v, const WeightedPoint& from, const WeightedPoint& to, double before,
                      double after) const {
  if (!on()) return;
  const bool moves = !work_.mesh.space().is_plane() || from.x != to.x || from.y != to.y;
  tell(moves ? EventKind::move : EventKind::weight, before, after, [&](TraceEvent& e) {
    e.vertex = user(v);
    e.point = work_.frame.to_user(to);
  });
}

void Recorder::flipped(std::span<const FlipRecord> flips) const {
  for (const FlipRecord& f : flips) {
    tell(EventKind::flip, f.before, f.after, [&](TraceEvent& e) {
      e.quad = {user(f.a), user(f.b), user(f.c), user(f.d)};
    });
  }
}

void Recorder::removed(EventKind kind, const RemovalPlan& plan, double before, double after) const {
  tell(kind, before, after, [&](TraceEvent& e) {
    e.vertex = user(plan.vertex);
    for (const VertexId v : plan.link) e.link.push_back(user(v));
    for (const auto& [a, b, c] : plan.triangles) e.triangles.push_back({user(a), user(b), user(c)});
  });
}

void Recorder::inserted(VertexId v, const std::array<VertexId, 3>& triangle, double before, double after) const {
  tell(EventKind::insertion, before, after, [&](TraceEvent& e) {
    e.vertex = user(v);
    e.point = work_.frame.to_user(work_.mesh.point(v));
    for (const VertexId corner : triangle) e.link.push_back(user(corner));
  });
}

void Recorder::split(VertexId v, const std::array<VertexId, 4>& quad, double before, double after) const {
  tell(EventKind::split, before, after, [&](TraceEvent& e) {
    const auto [a, b, c, d] = quad;
    e.vertex = user(v);
    e.point = work_.frame.to_user(work_.mesh.point(v));
    e.quad = {user(a), user(b), user(c), d.valid() ? user(d) : VertexId()};
  });
}

void Recorder::hidden(VertexId v) const {
  tell(EventKind::hidden, kNoEnergy, kNoEnergy, [&](TraceEvent& e) { e.vertex = user(v); });
}

void Recorder::undone(VertexId v, double before, double after) const {
  tell(EventKind::undo, before, after, [&](TraceEvent& e) { e.vertex = user(v); });
}

void Recorder::returned_to(int sweep) const {
  tell(EventKind::undo, kNoEnergy, kNoEnergy, [&](TraceEvent& e) { e.to_sweep = sweep; });
}

}  // namespace temper
