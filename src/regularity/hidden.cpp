// From stuck edges to hidden vertices.
//
// A stuck edge names the vertex at its reflex end, which is hidden (lawson.hpp). But a vertex can hide in the shadow of
// another. Next to a tall peak the surface may be convex around a vertex that is itself above the regular surface. So
// the named vertices are removed, Lawson runs again, and vertices of edges that are stuck then are hidden, too. A
// hidden vertex stays hidden when another hidden vertex goes, as the regular surface does not change. plan_removal must
// be able to remove a vertex and keep the domain; other vertices are only named, and their stuck edges stay.
#include "regularity/hidden.hpp"

#include <utility>

#include "base/sort_unique.hpp"
#include "mesh/predicates.hpp"

namespace temper {
namespace {

std::vector<VertexId> reflex_ends(const Mesh& mesh, const std::vector<HalfedgeId>& stuck) {
  std::vector<VertexId> ends;
  ends.reserve(stuck.size());
  for (const HalfedgeId h : stuck) ends.push_back(reflex_end(mesh, h));
  sort_unique(ends);
  return ends;
}

}  // namespace

VertexId reflex_end(const Mesh& mesh, HalfedgeId stuck) {
  const auto [a, b, c, d] = inlined::quad(mesh, stuck);
  return inlined::orientation(mesh, d, c, a) == Sign::positive ? b : a;
}

HiddenVertices remove_hidden(Mesh& mesh, Lawson& lawson, const RestorationObserver* observer) {
  HiddenVertices result;
  FlipObserver flips{observer};
  RemovalPlan plan;
  for (bool removed = true; removed;) {
    removed = false;
    const std::vector<VertexId> found = reflex_ends(mesh, lawson.stuck(mesh));
    result.hidden.insert(result.hidden.end(), found.begin(), found.end());
    for (const VertexId v : found) {
      plan = plan_removal(mesh, v, std::move(plan));
      if (plan.status != RemovalStatus::possible) continue;
      if (observer != nullptr && observer->removing) observer->removing(plan);
      remove_vertex(mesh, plan);
      lawson.push_removal(mesh, plan);
      result.removed.push_back(v);
      removed = true;
    }
    result.flips += lawson.run(mesh, flips).flips;
  }
  lawson.commit();  // a flip before a removal cannot be undone
  sort_unique(result.hidden);
  return result;
}

}  // namespace temper
