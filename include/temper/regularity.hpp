// Regularity (the weighted Delaunay property) of unconstrained interior edges: test and restore.
#pragma once

#include <cstddef>
#include <vector>

#include "temper/mesh.hpp"

namespace temper {

/// Sign of the dual length of the edge of h: negative means not regular. Exact. Boundary edges: positive.
[[nodiscard]] bool is_regular(const Mesh& mesh, HalfedgeId h);

/// Interior edges that are not regular; with constrained ones or without.
[[nodiscard]] std::size_t count_non_regular_edges(const Mesh& mesh, bool with_constrained = true);

/// What restore_regularity did.
struct Restoration {
  std::size_t flips = 0;
  /// Edges that are not regular and that no flip sequence cures: they run into a vertex hidden by its weight.
  std::vector<HalfedgeId> stuck;
  /// The hidden vertices: those whose power cell is empty in the regular triangulation.
  std::vector<VertexId> hidden;
  [[nodiscard]] bool regular() const { return stuck.empty(); }
};

/// Lawson's algorithm on all edges: flips until every unconstrained interior edge is regular or stuck.
Restoration restore_regularity(Mesh& mesh);

}  // namespace temper
