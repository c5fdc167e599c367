// The unit of each weight in a programme: the mean ℓ² of the edges at its vertex.
#pragma once

#include <span>
#include <vector>

#include "temper/mesh.hpp"

namespace temper {

/// Position of v in a sorted list that has it; its size, or that of another, when it does not.
[[nodiscard]] std::size_t index_of(std::span<const VertexId> sorted_vertices, VertexId v);

/// One a vertex: the mean over those of the edges that end there. Each vertex must have one.
[[nodiscard]] std::vector<double> weight_units(const Mesh& mesh, std::span<const VertexId> vertices,
                                               std::span<const HalfedgeId> edges);

}  // namespace temper
