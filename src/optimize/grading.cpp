#include "optimize/grading.hpp"

#include <utility>

namespace temper {
namespace {

class BoundaryCutter {
 public:
  BoundaryCutter(WorkingCopy& work, Flipper& flipper) : work_(work), mesh_(work.mesh), flipper_(flipper) {}

  void cut(const EdgeCuts& edge);
  /// A vertex at the orthocenter of a triangle that has none free.
  void free(const std::array<VertexId, 3>& corners);
  /// A split between vertices with weights far apart may leave edges that are not regular.
  void restore_regularity() {
    if (!regular_) flipper_.restore_all();
    regular_ = true;
  }
  [[nodiscard]] std::size_t vertices() const { return vertices_; }
  [[nodiscard]] std::size_t inside() const { return inside_; }
  [[nodiscard]] std::size_t refused() const { return refused_; }

 private:
  [[nodiscard]] HalfedgeId find_edge(VertexId a, VertexId b) const;
  VertexId split(VertexId a, VertexId b, Vec2 at);
  VertexId commit(const InsertionPlan& plan);

  WorkingCopy& work_;
  Mesh& mesh_;
  Flipper& flipper_;
  InsertionPlan plan_;
  std::size_t vertices_ = 0, inside_ = 0, refused_ = 0;
  bool regular_ = true;
};

HalfedgeId BoundaryCutter::find_edge(VertexId a, VertexId b) const {
  const HalfedgeId h = mesh_.find_halfedge(a, b);
  return h.valid() ? h : mesh_.find_halfedge(b, a);
}

/// From a towards b, each time what is left of the edge.
void BoundaryCutter::cut(const EdgeCuts& edge) {
  const Vec2 a = mesh_.position(edge.a), along = mesh_.position(edge.b) - a;
  VertexId last = edge.a;
  for (const double t : edge.at) {
    const VertexId v = split(last, edge.b, work_.frame.snap(a + t * along));
    if (v.valid()) last = v;
  }
}

/// The new vertex on ab, or none.
VertexId BoundaryCutter::split(VertexId a, VertexId b, Vec2 at) {
  const Vec2 from = mesh_.position(a), along = mesh_.position(b) - from;
  const double l2 = squared_length(along), t = dot(at - from, along) / l2;
  const double w = split_weight(mesh_.weight(a), mesh_.weight(b), l2, t);
  plan_ = plan_split(mesh_, find_edge(a, b), WeightedPoint{at.x, at.y, w}, std::move(plan_));
  if (plan_.status != InsertionStatus::possible && plan_.status != InsertionStatus::not_regular) {
    ++refused_;
    return {};
  }
  regular_ = regular_ && plan_.status == InsertionStatus::possible;
  ++vertices_;
  return commit(plan_);
}

void BoundaryCutter::free(const std::array<VertexId, 3>& corners) {
  plan_ = plan_center(mesh_, corners, std::move(plan_));
  if (plan_.status != InsertionStatus::possible) return;
  const Vec2 at = work_.frame.snap(plan_.point.position());
  plan_ = plan_insertion(mesh_, {at.x, at.y, plan_.point.w}, plan_.triangle, std::move(plan_));
  if (plan_.status != InsertionStatus::possible) return;
  commit(plan_);
  ++inside_;
}

VertexId BoundaryCutter::commit(const InsertionPlan& plan) {
  const VertexId v = plan.edge.valid() ? flipper_.split(work_, plan.edge, plan.point, kNoEnergy, kNoEnergy)
                                       : flipper_.insert(work_, plan.triangle, plan.point, kNoEnergy, kNoEnergy);
  for (const auto& [a, b] : plan.flips) flipper_.flip(mesh_.find_halfedge(a, b), kNoEnergy, kNoEnergy);
  return v;
}

}  // namespace

BoundaryCuts cut_boundary(WorkingCopy& work, Flipper& flipper, double ratio) {
  BoundaryCutter cutter(work, flipper);
  BoundaryCuts result;
  for (int pass = 0; pass < kGradingPasses; ++pass) {
    const GradingPlan plan = plan_boundary_grading(work.mesh, ratio, kWidestBoundaryAngle);
    if (pass == 0) result.ratio_before = plan.ratio_before;
    result.ratio_after = plan.ratio_after;
    for (const EdgeCuts& edge : plan.cuts) cutter.cut(edge);
    cutter.restore_regularity();
  }
  for (const auto& corners : triangles_without_free_corner(work.mesh)) cutter.free(corners);
  result.vertices = cutter.vertices();
  result.inside = cutter.inside();
  result.refused = cutter.refused();
  return result;
}

}  // namespace temper
