// Progress: a long computation tells its caller how far it is, and the caller may stop it.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string_view>

namespace temper {

/// The objective that a run lowers.
enum class Objective {
  energy,        ///< one of the registry's
  accuracy,      ///< after it has made every triangle well-centered: what the errors of a solver are proportional to
  solver_error,  ///< after that: the errors of a solver themselves
};

/// "energy", "accuracy", "solver_error".
[[nodiscard]] std::string_view name(Objective objective);

/// One sweep over all vertices, as recorded in the history of a run.
struct SweepRecord {
  int sweep = 0;          ///< 0 is the input
  double energy = 0;      ///< total energy at the end of the sweep, at that sweep's γ
  std::size_t bad = 0;    ///< triangles that are not well-centered
  std::size_t flips = 0;  ///< edge flips of this sweep
  double length_parameter =
      0;               ///< γ or −h° of this sweep, as used (relative to ℓ by default); 0 of sweeps for accuracy
  double seconds = 0;  ///< since the start of the optimization
  Objective objective = Objective::energy;  ///< what the sweep lowered, and `energy` is of
};

/// Called now and then during a run (at least once a sweep, and on large meshes more often).
struct Progress {
  SweepRecord last;     ///< the last whole sweep
  double fraction = 0;  ///< of the sweep under way, in [0, 1)
  int max_sweeps = 0;
  /// An estimate of the sweeps after the last one, while the energy converges: none in the first sweeps of a stage (one
  /// objective, one γ). Repairs may follow.
  std::optional<double> sweeps_left = {};
};

enum class Continue { yes, no };

/// Returns Continue::no to stop early: the mesh is then the best valid one so far.
using Observer = std::function<Continue(const Progress&)>;

}  // namespace temper
