// One run of optimize(): the report that its phases write, the clock, and the caller who may stop it.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>

#include "base/engine.hpp"
#include "optimize/checkpoints.hpp"
#include "optimize/repair/grading.hpp"
#include "optimize/step/flipper.hpp"
#include "temper/optimize.hpp"

namespace temper {

/// The threads and ranks of a run.
[[nodiscard]] inline Engine engine_of(const OptimizeHooks& hooks) { return {hooks.executor, hooks.communicator}; }

/// Triangles that are not counter-clockwise, exact.
[[nodiscard]] std::size_t count_inverted(const Mesh& mesh);

/// Facts that the report tells in sentences.
struct RunFacts {
  std::size_t input_flips = 0;                ///< that made the input regular
  std::optional<BoundaryCuts> boundary_cuts;  ///< when they were asked for
  BoundaryCuts cuts_where_bad;                ///< before the last attempt that made some there
  bool stays_uncut = false;                   ///< since cuts leave more triangles bad
  bool weights_shrunk = false;                ///< all of them, since they left edges uncrossed
  bool energy_rose = false;                   ///< in the last sweeps, which were taken back
};

class Run {
 public:
  /// `communicator`: of the ranks that make the run together, or null.
  Run(const OptimizeOptions& options, const Observer& observer, Communicator* communicator = nullptr)
      : repair_trials_left(options.repair_trials),
        options_(options),
        observer_(observer),
        communicator_(communicator),
        start_(Clock::now()) {}

  /// Since the start, and in the runs that this one goes on with.
  [[nodiscard]] double seconds() const { return earlier_seconds_ + seconds_here(); }
  [[nodiscard]] bool sweeps_left() const { return report.sweeps < options_.max_sweeps; }
  /// The number of the next sweep; 0 before the first, while the input is made regular.
  [[nodiscard]] int next_sweep() const { return report.sweeps == 0 ? 0 : report.sweeps + 1; }
  [[nodiscard]] bool stopped_early() const { return temper::stopped_early(report.stopped); }
  /// Says whether there is time for more.
  [[nodiscard]] bool goes_on() const { return !stopped_early() && sweeps_left(); }
  /// From here on there are sweeps. What has been done so far, copies and measures of the whole mesh, is done again
  /// when they end, and takes about as long: the time limit is of all of it.
  void begin_sweeps() {
    if (ending_seconds_ == 0) ending_seconds_ = seconds_here();
  }
  /// Asks the clock and the caller, who are those of rank 0; sets report.stopped when the answer is yes. Ranks ask at
  /// the same places and get the same answer. While they work locally, rank 0 alone gets one.
  bool asked_to_stop(double fraction_of_sweep);
  /// From here on ranks do different things.
  void begin_local() { local_ = communicator_ != nullptr; }
  /// From here on they do the same again, and all have the answer that rank 0 got meanwhile.
  void end_local();

  void count(const Flipper::Changes& changes) {
    report.flips += changes.flips;
    report.vertices_removed += changes.removed;
    report.vertices_inserted += changes.inserted;
  }

  OptimizeReport report;
  RunFacts facts;
  int repair_trials_left;
  Checkpoints checkpoints;

 private:
  friend void visit(Archive& archive, Run& run);
  using Clock = std::chrono::steady_clock;

  bool ask(double fraction_of_sweep);
  void sync_stop();

  [[nodiscard]] double seconds_here() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  const OptimizeOptions& options_;
  const Observer& observer_;
  Communicator* communicator_;
  bool local_ = false;
  Clock::time_point start_;
  double earlier_seconds_ = 0;
  double ending_seconds_ = 0;  // after the last sweep, about
};

}  // namespace temper
