// Regularity (the weighted Delaunay property) of unconstrained interior edges: test and restore.
#pragma once

#include <cstddef>
#include <vector>

#include "temper/mesh.hpp"

namespace temper {

/// Is the dual length of the edge of h zero or more? Exact; cocircular in the power sense is regular. Boundary edges
/// always are.
[[nodiscard]] bool is_regular(const Mesh& mesh, HalfedgeId h);

/// Interior edges that are not regular; with constrained ones or without.
[[nodiscard]] std::size_t count_non_regular_edges(const Mesh& mesh, bool with_constrained = true);

/// What restore_regularity did.
struct Restoration {
  std::size_t flips = 0;
  /// Edges that are not regular and that no flip sequence cures: they run into a vertex hidden by its weight.
  std::vector<HalfedgeId> stuck;
  /// The hidden vertices, by number: those whose power cell is empty in the regular triangulation of the domain. A
  /// vertex on the boundary or on a constrained edge is named when an edge is stuck at it.
  std::vector<VertexId> hidden;
  [[nodiscard]] bool regular() const { return stuck.empty(); }
};

/// Lawson's algorithm on all edges: flips until every unconstrained interior edge is regular or stuck. Ends always
/// (every flip lowers the lifted surface). About n flips in practice, O(n²) at worst.
///
///     const Restoration restored = restore_regularity(mesh);
///     if (!restored.regular()) { … }  // the weights of restored.hidden are too small, or a neighbour's too large
Restoration restore_regularity(Mesh& mesh);

}  // namespace temper
