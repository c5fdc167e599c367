// restore_regularity: Lawson on all edges, then the policy for the vertices at stuck edges.
#include <utility>

#include "base/sum.hpp"
#include "mesh/predicates.hpp"
#include "regularity/hidden.hpp"
#include "regularity/lawson.hpp"
#include "temper/regularity.hpp"

namespace temper {

// The local test of one edge, and the count over a mesh.

bool is_regular(const Mesh& mesh, HalfedgeId h) {
  return mesh.is_boundary(h) || PowerTest()(mesh, inlined::quad(mesh, h)) != Sign::positive;
}

std::size_t count_non_regular_edges(const Mesh& mesh, bool with_constrained, Executor* executor) {
  return static_cast<std::size_t>(blockwise_sum(mesh.n_halfedges(), executor, [&](std::size_t i) {
    const HalfedgeId h(i);
    if (!mesh.is_edge_representative(h) || (!with_constrained && mesh.is_constrained(h))) return 0.0;
    return is_regular(mesh, h) ? 0.0 : 1.0;
  }));
}

namespace {

[[maybe_unused]] bool all_counter_clockwise(const Mesh& mesh) {
  for (const TriangleId t : mesh.triangles()) {
    if (mesh.is_erased(t)) continue;
    const auto [a, b, c] = mesh.corners(t);
    if (inlined::orientation(mesh, a, b, c) != Sign::positive) return false;
  }
  return true;
}

/// All hidden vertices, removing them from a copy to find those that hide in another's shadow.
std::vector<VertexId> find_hidden(const Mesh& mesh, const Lawson& lawson) {
  Mesh reduced = mesh;
  Lawson again = lawson;
  return remove_hidden(reduced, again).hidden;
}

void undo(Mesh& mesh, Lawson& lawson, const RestorationObserver* observer) {
  lawson.rollback(mesh);
  if (observer != nullptr && observer->undone) observer->undone();
}

}  // namespace

Restoration restore_regularity(Mesh& mesh, HiddenPolicy policy, const RestorationObserver* observer) {
  TEMPER_ASSERT(all_counter_clockwise(mesh));
  Lawson lawson;
  lawson.push_all(mesh);
  Restoration result;
  result.flips = lawson.run(mesh, FlipObserver{observer}).flips;
  result.stuck = lawson.stuck(mesh);
  if (result.stuck.empty()) return result;
  switch (policy) {
    case HiddenPolicy::keep:
      result.hidden = find_hidden(mesh, lawson);
      break;
    case HiddenPolicy::undo:
      result.hidden = find_hidden(mesh, lawson);
      undo(mesh, lawson, observer);
      result.flips = 0;
      result.stuck.clear();
      result.undone = true;
      break;
    case HiddenPolicy::remove: {
      HiddenVertices found = remove_hidden(mesh, lawson, observer);
      result.flips += found.flips;
      result.stuck = lawson.stuck(mesh);
      result.hidden = std::move(found.hidden);
      result.removed = std::move(found.removed);
      break;
    }
  }
  return result;
}

}  // namespace temper
