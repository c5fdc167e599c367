// Hidden vertices: those whose power cell is empty in the regular triangulation of the constrained domain.
#pragma once

#include <vector>

#include "temper/mesh.hpp"

namespace temper {

/// The end at which the quad of a stuck edge is not strictly convex. Exactly one of the two is.
[[nodiscard]] VertexId reflex_end(const Mesh& mesh, HalfedgeId stuck);

/// All hidden vertices, by number, of a mesh on which Lawson's algorithm has run and left these edges stuck.
/// Works on a copy; O(n) a layer of shadows, seldom more than two.
[[nodiscard]] std::vector<VertexId> hidden_vertices(const Mesh& mesh, const std::vector<HalfedgeId>& stuck);

}  // namespace temper
