#include "optimize/repair/splice.hpp"

#include <array>
#include <utility>

#include "base/assert.hpp"

namespace temper {
namespace {

class Splice {
 public:
  Splice(WorkingCopy& work, Flipper& flipper, const Recorder& recorder, const Neighborhood& around)
      : work_(work), mesh_(work.mesh), flipper_(flipper), recorder_(recorder), vertices_(around.vertices) {}

  void apply(const TraceEvent& e);
  [[nodiscard]] std::vector<VertexId> vertices() && { return std::move(vertices_); }

 private:
  [[nodiscard]] VertexId whole(VertexId local) const { return vertices_[local.index]; }
  void place(const TraceEvent& e);
  void insert(const TraceEvent& e);
  void split(const TraceEvent& e);
  void remove(const TraceEvent& e);

  WorkingCopy& work_;
  Mesh& mesh_;
  Flipper& flipper_;
  const Recorder& recorder_;
  std::vector<VertexId> vertices_;  // by number in the neighbourhood
};

void Splice::apply(const TraceEvent& e) {
  switch (e.kind) {
    case EventKind::move:
    case EventKind::weight:
      return place(e);
    case EventKind::flip:
      return flipper_.flip(mesh_.find_halfedge(whole(e.quad[0]), whole(e.quad[1])), e.before, e.after);
    case EventKind::insertion:
      return insert(e);
    case EventKind::split:
      return split(e);
    case EventKind::collapse:
    case EventKind::removal:
      return remove(e);
    case EventKind::hidden:
    case EventKind::undo:
      return;  // changed nothing
  }
}

void Splice::place(const TraceEvent& e) {
  const VertexId v = whole(e.vertex);
  const WeightedPoint from = mesh_.point(v);
  if (e.kind == EventKind::move) {
    mesh_.set_point(v, e.point);
  } else {
    mesh_.set_weight(v, e.point.w);
  }
  recorder_.placed(v, from, mesh_.point(v), e.before, e.after);
}

void Splice::insert(const TraceEvent& e) {
  const std::array corners = {whole(e.link[0]), whole(e.link[1]), whole(e.link[2])};
  const TriangleId t = Mesh::triangle(mesh_.find_halfedge(corners[0], corners[1]));
  TEMPER_ASSERT(e.vertex.index == vertices_.size());
  vertices_.push_back(flipper_.insert(work_, t, e.point, e.before, e.after));
}

void Splice::split(const TraceEvent& e) {
  TEMPER_ASSERT(e.vertex.index == vertices_.size());
  const HalfedgeId h = mesh_.find_halfedge(whole(e.quad[0]), whole(e.quad[1]));
  vertices_.push_back(flipper_.split(work_, h, e.point, e.before, e.after));
}

void Splice::remove(const TraceEvent& e) {
  std::vector<std::array<VertexId, 3>> triangles;
  for (const auto& [a, b, c] : e.triangles) triangles.push_back({whole(a), whole(b), whole(c)});
  const RemovalPlan plan = removal_from_names(mesh_, whole(e.vertex), whole(e.link.front()), triangles);
  TEMPER_ASSERT(plan.status == RemovalStatus::possible);
  flipper_.remove(e.kind, plan, e.before, e.after);
}

}  // namespace

std::vector<VertexId> splice(WorkingCopy& work, Flipper& flipper, const Recorder& recorder, const Neighborhood& around,
                             std::span<const TraceEvent> events) {
  TEMPER_ASSERT_SLOW(std::all_of(around.mesh.vertices().begin(), around.mesh.vertices().end(), [&](VertexId v) {
    return around.mesh.point(v) == work.mesh.point(around.vertices[v.index]);
  }));
  Splice whole(work, flipper, recorder, around);
  for (const TraceEvent& e : events) whole.apply(e);
  return std::move(whole).vertices();
}

}  // namespace temper
