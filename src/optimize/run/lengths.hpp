// What edges and duals of a mesh lack of the lengths that are asked for (AccuracyOptions::min_edge, min_dual).
#pragma once

#include <vector>

#include "energy/accuracy_edge.hpp"
#include "temper/detail/executor.hpp"
#include "temper/mesh.hpp"

namespace temper {

/// Σ over interior edges of (1 − length/least)² of both lengths, where they are shorter than the least asked for;
/// exactly 0 where nothing is missing. Triangles may be erased. O(n).
[[nodiscard]] double missing_lengths(const Mesh& mesh, const AccuracyModel& model, Executor* executor = nullptr);

/// The triangles that have an edge which lacks length, in ascending order.
[[nodiscard]] std::vector<TriangleId> triangles_lacking_length(const Mesh& mesh, const AccuracyModel& model);

}  // namespace temper
