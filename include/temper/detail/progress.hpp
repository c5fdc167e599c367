// Progress: a long computation reports its progress to the caller, and the caller may stop it.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string_view>

namespace temper {

struct ReportTable;

/// The objective that a run lowers.
enum class Objective {
  energy,        ///< One energy of the registry
  accuracy,      ///< After all triangles are well-centered: a measure proportional to the errors of a solver
  solver_error,  ///< After that: the errors of a solver themselves
};

/// "energy", "accuracy", "solver_error".
[[nodiscard]] std::string_view name(Objective objective);
[[nodiscard]] std::span<const std::string_view> words_of(Objective);

/// One sweep over all vertices, in the history of a run.
struct SweepRecord {
  int sweep = 0;                ///< Number of the sweep; 0 is the input
  double energy = 0;            ///< Total energy at the end of the sweep, at the γ of that sweep
  std::size_t bad = 0;          ///< Number of triangles that are not well-centered
  std::size_t flips = 0;        ///< Number of edge flips in this sweep
  double length_parameter = 0;  ///< Value of γ or −h° in this sweep (relative to ℓ by default); 0 for accuracy sweeps
  double seconds = 0;           ///< Time since the start of the optimization [s]
  Objective objective = Objective::energy;  ///< Objective that the sweep lowered; `energy` is its value
};
[[nodiscard]] const ReportTable& table_of(const SweepRecord*);

/// Progress of a run. The observer gets it at least once per sweep, and more often on large meshes.
struct Progress {
  SweepRecord last;     ///< Last whole sweep
  double fraction = 0;  ///< Fraction of the current sweep, in [0, 1)
  int max_sweeps = 0;
  /// Estimate of the sweeps after the last one, while the energy converges. Absent in the first sweeps of a stage (one
  /// objective, one γ). Repairs may follow.
  std::optional<double> sweeps_left = {};
  /// Number of vertices, while the run searches for a mesh with fewer.
  std::optional<std::size_t> n_vertices = {};
  /// Estimate of the share of the present phase that is done, in [0, 1]. Each objective of `last` is a phase, and its
  /// energy has another meaning than in the phase before. Absent if there is no estimate.
  std::optional<double> share_of_phase = {};
  /// Phase of the mesher before an optimization, such as "placing points". `fraction` is then the share of the phase
  /// that is done, as far as it is known. Empty in an optimization.
  std::string_view phase = {};
};
[[nodiscard]] const ReportTable& table_of(const Progress*);

/// The reason why a run ended.
enum class Stopped {
  converged,
  max_sweeps,
  max_outer,
  time_limit,
  canceled,
  tangled,      ///< Triangles are inverted (Inversion::allow), and no flips can make the mesh regular
  sweep_limit,  ///< All sweeps of AccuracyOptions, or steps of SolverErrorOptions, are done: a normal end
  hidden,       ///< Deferred flips hid a vertex against the policy: the mesh is the last or best regular one
};
[[nodiscard]] std::string_view name(Stopped stopped);
[[nodiscard]] std::span<const std::string_view> words_of(Stopped);
/// Says whether the time limit or the observer ended the run. With more time the run would have continued.
[[nodiscard]] constexpr bool stopped_early(Stopped stopped) {
  return stopped == Stopped::time_limit || stopped == Stopped::canceled;
}

enum class Continue { yes, no };

/// A function that can get the best mesh so far. `best` calls its argument with the best valid mesh, or does nothing if
/// there is none yet.
template <class BestSoFar>
using BestListenerOf =
    std::function<void(const std::function<void(const std::function<void(const BestSoFar&)>&)>& best)>;

/// Function that returns Continue::no to stop early. The mesh is then the best valid one so far.
using Observer = std::function<Continue(const Progress&)>;

}  // namespace temper
