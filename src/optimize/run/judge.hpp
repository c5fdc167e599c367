// The judge of meshes: the score of each mesh that a run comes to, and which of two meshes a stage keeps.
#pragma once

#include <compare>
#include <cstddef>
#include <vector>

#include "energy/accuracy_edge.hpp"
#include "optimize/options/settings.hpp"
#include "temper/detail/executor.hpp"
#include "temper/mesh.hpp"

namespace temper {

/// Σ over interior edges of (1 − length/least)² of both lengths, where they are shorter than min_edge and min_dual ask
/// for; exactly 0 where nothing is missing. Triangles may be erased. O(n).
[[nodiscard]] double missing_lengths(const Mesh& mesh, const AccuracyModel& model, Executor* executor = nullptr);

/// The triangles that have an edge which lacks length, in ascending order.
[[nodiscard]] std::vector<TriangleId> triangles_lacking_length(const Mesh& mesh, const AccuracyModel& model);

/// Says whether the accuracy objective finds all margins and lengths that it asks for.
[[nodiscard]] bool has_all_for_accuracy(const Mesh& mesh, const Settings& settings);

/// A smaller score is better. Validity comes first. Then regularity, unless the user keeps hidden vertices. Then, for a
/// barrier, the number of triangles that are not well-centered. Then the margins of the accuracy objective, and lengths
/// that are asked for. Then the energy, or the error of the solver.
struct MeshScore {
  std::size_t inverted = 0, non_regular = 0, bad = 0;
  bool lacks_margins = false;
  double missing_lengths = 0;  ///< of those asked for
  double energy = 0;
  friend auto operator<=>(const MeshScore&, const MeshScore&) = default;
};

/// What a mesh needs to replace the best mesh so far.
enum class Requirement {
  not_worse,  ///< an equal score will do
  fewer_bad,  ///< fewer triangles that are not well-centered, whatever the rest
  cures,      ///< no worse, and fewer bad triangles or missing lengths: a mesh of fewer vertices always has less energy
};
[[nodiscard]] bool replaces(const MeshScore& now, const MeshScore& best, Requirement required);

/// What is counted for a score, whatever the energy. Inverted triangles are looked for where they are allowed.
[[nodiscard]] MeshScore count(const Mesh& mesh, const Settings& settings);

/// The score by the energy `model`, or with the sizes at its vertices by the accuracy objective.
[[nodiscard]] MeshScore score(const Mesh& mesh, const Settings& settings, const EnergyModel& model,
                              const VertexSizes* sizes = nullptr);
/// The score of a mesh where all has been counted.
[[nodiscard]] MeshScore score(const Mesh& mesh, const MeshScore& counts, const Settings& settings,
                              const EnergyModel& model, const VertexSizes* sizes);

/// Says whether a mesh replaces the best one, by that energy.
[[nodiscard]] bool replaces(const Mesh& now, const Mesh& best, Requirement required, const Settings& settings,
                            const EnergyModel& model);

/// The root of the geometric mean of the schemes' squared errors; +∞ if there are none.
[[nodiscard]] double root_mean_square(const std::vector<double>& squared_errors);

}  // namespace temper
