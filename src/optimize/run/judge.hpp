// The judge of meshes. It scores each mesh that a run reaches, and decides which of two meshes a stage keeps.
#pragma once

#include <compare>
#include <cstddef>
#include <vector>

#include "energy/accuracy_edge.hpp"
#include "optimize/options/settings.hpp"
#include "optimize/working/working_copy.hpp"
#include "temper/detail/executor.hpp"
#include "temper/mesh.hpp"

namespace temper {

/// Returns Σ (1 − length/least)² over the primal and dual lengths of interior edges that are shorter than min_edge and
/// min_dual require. If no length is missing, it is exactly 0. Triangles may be erased. O(n).
[[nodiscard]] double missing_lengths(const Mesh& mesh, const AccuracyModel& model, Executor* executor = nullptr);

/// Says whether the triangle has an edge that it represents and that lacks length. O(degree).
[[nodiscard]] bool lacks_length(const Mesh& mesh, TriangleId t, const AccuracyModel& model);
/// Returns all these triangles, in ascending order. O(n).
[[nodiscard]] std::vector<TriangleId> triangles_lacking_length(const Mesh& mesh, const AccuracyModel& model);

/// Returns the largest of −h/ℓ, −d/ℓ and d/ℓ − 1 of triangle t, which is positive if it is not well-centered.
[[nodiscard]] double violation_of(const Mesh& mesh, TriangleId t);
/// Returns the largest violation of a triangle that is not well-centered; 0 if all are. O(n).
[[nodiscard]] double worst_violation(const Mesh& mesh, Executor* executor = nullptr);
/// Counts triangles that are not well-centered by more than `limit`. O(n).
[[nodiscard]] std::size_t count_worse(const Mesh& mesh, double limit, Executor* executor = nullptr);

/// Says whether the mesh has all margins and lengths that the accuracy objective requires.
[[nodiscard]] bool has_all_for_accuracy(const Mesh& mesh, const Settings& settings);

/// A smaller score is better. What is worse than in the input comes first: measures of the guard (guard.hpp), and
/// triangles that are farther from well-centered than any of the input. Then validity. Then regularity, unless the user
/// keeps hidden vertices. Then, if Settings::counts_violations(), violations of the criterion. Then, for a barrier, the
/// number of triangles that are not well-centered. Then the margins of the accuracy objective, and missing lengths.
/// Then the energy, or the error of the solver.
struct MeshScore {
  std::size_t beyond_guard = 0, inverted = 0, non_regular = 0, violations = 0, bad = 0;
  bool lacks_margins = false;
  double missing_lengths = 0;  ///< if the options require lengths
  double energy = 0;
  friend auto operator<=>(const MeshScore&, const MeshScore&) = default;
};

/// The condition on which a mesh replaces the best mesh so far.
enum class Requirement {
  not_worse,  ///< an equal score will do
  fewer_bad,  ///< fewer violations, or as many and fewer triangles that are not well-centered, whatever the rest
  cures,      ///< no worse, and fewer bad triangles or missing lengths: a mesh of fewer vertices always has less energy
};
[[nodiscard]] bool replaces(const MeshScore& now, const MeshScore& best, Requirement required);

/// Counts the parts of a score that do not depend on the energy. Inverted triangles are counted if they are allowed.
[[nodiscard]] MeshScore count(const Mesh& mesh, const Settings& settings, const WorkingUnits& units = {});

/// Returns the score by the energy `model`; or, with `sizes` at the vertices, by the accuracy objective.
[[nodiscard]] MeshScore score(const Mesh& mesh, const Settings& settings, const EnergyModel& model,
                              const VertexSizes* sizes = nullptr, const WorkingUnits& units = {});
/// Completes the score of a mesh from its counts.
[[nodiscard]] MeshScore score(const Mesh& mesh, const MeshScore& counts, const Settings& settings,
                              const EnergyModel& model, const VertexSizes* sizes);
/// Completes it with a known value of the accuracy objective, or with a known error of the solver.
[[nodiscard]] MeshScore score(const Mesh& mesh, const MeshScore& counts, const Settings& settings, double energy);

/// Says whether the mesh violates the criterion of the settings. O(n).
[[nodiscard]] bool is_unfinished(const Mesh& mesh, const Settings& settings);
/// Counts the violations of the criterion: triangles that are not well-centered, or duals of edges.
[[nodiscard]] std::size_t count_violations(const Mesh& mesh, const Settings& settings);

/// Says whether a mesh of the run replaces the best one, by the energy `model`.
[[nodiscard]] bool replaces(const WorkingCopy& now, const WorkingCopy& best, Requirement required,
                            const Settings& settings, const EnergyModel& model);

/// Largest number of vertices of rivals that measured errors judge: every field is solved on each of them.
inline constexpr int kMostJudgedVertices = 20'000;

/// Says whether measured errors of the solver decide between the mesh of the run and its rivals. For this the target
/// must have a solver, the objective must be left to the run, and the build must be able to measure.
[[nodiscard]] bool is_judged_by_errors(std::size_t n_vertices, const Space& space, const Settings& settings);

/// Says whether the input needs no change: it meets the criterion of its scheme. For stars, and for several schemes, it
/// must also have margins.
[[nodiscard]] bool is_sound(const Mesh& input, const MeshScore& counts, const Settings& settings);

/// Says whether the input meets the limits of its client, so that the run returns it as it is:
///   - D-Flow FM: orthogonality of at most 0.01, no small flow links
///   - ADCIRC: no obtuse triangles but those by rounding, and the least lengths of the options
///   - MPAS: all triangles well-centered, and the least lengths
[[nodiscard]] bool meets_limits_of_client(const Mesh& input, const Settings& settings);

/// Measures the solver's errors on meshes, and divides them by its errors on the input.
class ErrorJudge {
 public:
  ErrorJudge(const Mesh& input, const Settings& settings);
  /// Returns the largest ratio of an error on the mesh to the input's; 0 if one of them cannot be measured.
  [[nodiscard]] double largest_ratio(const Mesh& mesh) const;

 private:
  [[nodiscard]] std::vector<double> squared(const Mesh& mesh) const;

  const Settings& settings_;
  std::vector<double> of_input_;
};

/// Returns the root of the largest ratio of squared errors to the input's; 0 if either has none.
[[nodiscard]] double largest_ratio(const std::vector<double>& of_mesh, const std::vector<double>& of_input);
/// Returns the root of the geometric mean of the schemes' squared errors; +∞ without errors.
[[nodiscard]] double root_mean_square(const std::vector<double>& squared_errors);

}  // namespace temper
