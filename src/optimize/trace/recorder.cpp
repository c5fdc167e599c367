#include "optimize/trace/recorder.hpp"

namespace temper {

TraceEvent Recorder::event(EventKind kind, double before, double after) const {
  TraceEvent e;
  e.kind = kind;
  e.sweep = sweep_;
  e.before = energy_unit_ * before;
  e.after = energy_unit_ * after;
  return e;
}

void Recorder::placed(VertexId v, const WeightedPoint& from, const WeightedPoint& to, double before,
                      double after) const {
  if (!on()) return;
  const bool moves = !work_.mesh.space().is_plane() || from.x != to.x || from.y != to.y;
  TraceEvent e = event(moves ? EventKind::move : EventKind::weight, before, after);
  e.vertex = user(v);
  e.point = work_.frame.to_user(to);
  tracer_(e);
}

void Recorder::flipped(std::span<const FlipRecord> flips) const {
  if (!on()) return;
  for (const FlipRecord& f : flips) {
    TraceEvent e = event(EventKind::flip, f.before, f.after);
    e.quad = {user(f.a), user(f.b), user(f.c), user(f.d)};
    tracer_(e);
  }
}

void Recorder::removed(EventKind kind, const RemovalPlan& plan, double before, double after) const {
  if (!on()) return;
  TraceEvent e = event(kind, before, after);
  e.vertex = user(plan.vertex);
  for (const VertexId v : plan.link) e.link.push_back(user(v));
  for (const auto& [a, b, c] : plan.triangles) e.triangles.push_back({user(a), user(b), user(c)});
  tracer_(e);
}

void Recorder::inserted(VertexId v, const std::array<VertexId, 3>& triangle, double before, double after) const {
  if (!on()) return;
  TraceEvent e = event(EventKind::insertion, before, after);
  e.vertex = user(v);
  e.point = work_.frame.to_user(work_.mesh.point(v));
  for (const VertexId corner : triangle) e.link.push_back(user(corner));
  tracer_(e);
}

void Recorder::split(VertexId v, const std::array<VertexId, 4>& quad, double before, double after) const {
  if (!on()) return;
  const auto [a, b, c, d] = quad;
  TraceEvent e = event(EventKind::split, before, after);
  e.vertex = user(v);
  e.point = work_.frame.to_user(work_.mesh.point(v));
  e.quad = {user(a), user(b), user(c), d.valid() ? user(d) : VertexId()};
  tracer_(e);
}

void Recorder::hidden(VertexId v) const {
  if (!on()) return;
  TraceEvent e = event(EventKind::hidden, kNoEnergy, kNoEnergy);
  e.vertex = user(v);
  tracer_(e);
}

void Recorder::undone(VertexId v, double before, double after) const {
  if (!on()) return;
  TraceEvent e = event(EventKind::undo, before, after);
  e.vertex = user(v);
  tracer_(e);
}

void Recorder::returned_to(int sweep) const {
  if (!on()) return;
  TraceEvent e = event(EventKind::undo, kNoEnergy, kNoEnergy);
  e.to_sweep = sweep;
  tracer_(e);
}

}  // namespace temper
