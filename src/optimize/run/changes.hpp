// Counts of the changes of a run, and its notes about them, for triangles and for tetrahedra.
#pragma once

#include <cstddef>
#include <string>

#include "temper/detail/criterion.hpp"
#include "temper/optimize.hpp"

namespace temper {

/// Says whether the places to change would cover the mesh: each cell at a violation needs a place, and a place has at
/// least 13 triangles.
[[nodiscard]] constexpr bool are_many(std::size_t at_violations, std::size_t n_cells) {
  return static_cast<double>(at_violations) > 1.0 / 13 * static_cast<double>(n_cells);
}

/// Counts the vertices of the input that are elsewhere, or have another weight. `numbers`: as in EndOfRun.
/// `is_moved(v, was)`: says whether v is elsewhere.
template <class Mesh, class IsMoved>
[[nodiscard]] ChangeCounts changed_vertices(const Mesh& input, const Mesh& mesh,
                                            const IdVector<VertexId, VertexId>& numbers, const IsMoved& is_moved) {
  ChangeCounts counts;
  for (const VertexId v : mesh.vertices()) {
    const VertexId was = numbers.empty() ? v : numbers[v];
    if (was.index >= input.n_vertices()) continue;
    counts.vertices_moved += is_moved(v, was) ? 1 : 0;
    counts.weights_changed += mesh.weight(v) == input.weight(was) ? 0 : 1;
  }
  return counts;
}

/// "3 vertices moved, 4 weights and 0 edges changed; all else is as it was"
[[nodiscard]] std::string changes_note(const ChangeCounts& changed);
/// The note about an input that needs no change.
[[nodiscard]] std::string criterion_is_met_note(Criterion criterion);
/// The note about changes at other places than the bad ones. `places`: "3 triangles" at violations, all or those left.
[[nodiscard]] std::string whole_mesh_note(const std::string& places, bool many_are_bad);

}  // namespace temper
