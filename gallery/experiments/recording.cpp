#include "experiments/recording.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "reading.hpp"

namespace temper::gallery {
namespace {

std::array<VertexId, 3> sorted_corners(const Moment& m, TriangleId t) {
  std::array<VertexId, 3> corners = m.mesh.corners(t);
  for (VertexId& v : corners) v = m.vertices[v];
  std::sort(corners.begin(), corners.end());
  return corners;
}

}  // namespace

VertexId Moment::find(VertexId input) const {
  for (const VertexId v : mesh.vertices()) {
    if (vertices[v] == input) return v;
  }
  return {};
}

std::vector<TriangleId> triangles_not_in(const Moment& one, const Moment& other) {
  std::set<std::array<VertexId, 3>> known;
  for (const TriangleId t : other.mesh.triangles()) known.insert(sorted_corners(other, t));
  std::vector<TriangleId> missing;
  for (const TriangleId t : one.mesh.triangles()) {
    if (!known.contains(sorted_corners(one, t))) missing.push_back(t);
  }
  return missing;
}

std::vector<const Moment*> Recording::all(Snapshot::Moment kind) const {
  std::vector<const Moment*> found;
  for (const Moment& m : moments) {
    if (m.kind == kind) found.push_back(&m);
  }
  return found;
}

const Moment& Recording::begin_of(int iteration) const {
  const auto found = std::ranges::find(moments, iteration, &Moment::sweep);
  return found == moments.end() ? moments.back() : *found;
}

Recording record(const Mesh& start, const OptimizeOptions& options, Keep keep) {
  Recording recording;
  recording.result = start;
  OptimizeHooks hooks;
  hooks.snapshots = [&](const Snapshot& s) {
    if (keep == Keep::outer && s.moment == Snapshot::Moment::after_sweep) return;
    recording.moments.push_back({s.moment, s.sweep, s.outer, s.energy, s.mesh, s.vertices});
  };
  hooks.tracer = [&](const TraceEvent& event) { recording.events.push_back(event); };
  auto report = optimize(recording.result, as_read(options), hooks);
  if (report) {
    recording.report = *std::move(report);
  } else if (report.error().code == ErrorCode::invalid_option) {
    throw CannotBeMade(report.error().what());
  } else {
    recording.error = report.error().what();
  }
  return recording;
}

}  // namespace temper::gallery
