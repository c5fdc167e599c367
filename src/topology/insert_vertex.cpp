// The commit of an insertion or a split. The drawing is in plan_insertion.cpp.
//
// The flips are found by the vertices' numbers in the star of the new vertex, which is all that they change.
#include "base/assert.hpp"
#include "temper/topology.hpp"

namespace temper {
namespace {

/// The halfedge a → b with v on its left.
HalfedgeId link_halfedge(const Mesh& mesh, VertexId v, VertexId a, VertexId b) {
  for (const HalfedgeId spoke : mesh.star(v)) {
    const HalfedgeId h = Mesh::next(spoke);
    if (mesh.origin(h) == a && mesh.target(h) == b) return h;
  }
  return {};
}

}  // namespace

VertexId insert_vertex(Mesh& mesh, const InsertionPlan& plan, const InsertionObserver* observer) {
  TEMPER_ASSERT(plan.status == InsertionStatus::possible || plan.status == InsertionStatus::not_regular);
  if (observer != nullptr && observer->inserting) observer->inserting(plan);
  const VertexId v =
      plan.edge.valid() ? split_edge(mesh, plan.edge, plan.point) : insert_in_triangle(mesh, plan.triangle, plan.point);
  for (const auto& [a, b] : plan.flips) {
    const HalfedgeId h = link_halfedge(mesh, v, a, b);
    TEMPER_ASSERT(h.valid());
    if (observer != nullptr && observer->flipped) observer->flipped(a, b, v, mesh.opposite(mesh.twin(h)));
    flip(mesh, h);
  }
  return v;
}

}  // namespace temper
