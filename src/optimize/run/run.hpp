// One run of optimize(): the report that its phases write, the clock, and the caller who may stop it.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <span>

#include "base/engine.hpp"
#include "optimize/flips/flipper.hpp"
#include "optimize/flips/grading.hpp"
#include "temper/optimize.hpp"

namespace temper {

/// The threads and ranks of a run.
[[nodiscard]] inline Engine engine_of(const OptimizeHooks& hooks) { return {hooks.executor, hooks.communicator}; }

/// Triangles that are not counter-clockwise, exact.
[[nodiscard]] std::size_t count_inverted(const Mesh& mesh);

/// Facts that the report tells in sentences.
struct RunFacts {
  std::size_t input_flips = 0;                 ///< that made the input regular
  std::optional<SplitCounts> boundary_splits;  ///< when they were asked for
  SplitCounts splits_where_bad;                ///< before the last restart that made some there
  bool stays_unsplit = false;                  ///< since cuts leave more triangles bad
  bool weights_shrunk = false;                 ///< all of them, since they left edges uncrossed
  bool energy_rose = false;                    ///< in the last sweeps, which were taken back
  bool lacks_programs = false;                 ///< of which a repair would have asked one
};

/// While it lives, this mesh is the best one so far, and a stage planned another.
class BestBefore {
 public:
  BestBefore(const WorkingCopy*& place, const WorkingCopy* best) : place_(place) { place_ = best; }
  ~BestBefore() { place_ = nullptr; }
  BestBefore(const BestBefore&) = delete;
  BestBefore& operator=(const BestBefore&) = delete;

 private:
  const WorkingCopy*& place_;
};

class Run {
 public:
  /// `input`: as the caller gave it, for the places of vertices that stay.
  Run(const OptimizeOptions& options, const OptimizeHooks& hooks, const Mesh& input)
      : repair_trials_left(options.repair_trials),
        options_(options),
        hooks_(hooks),
        input_(input),
        start_(Clock::now()),
        limit_from_(hooks.started.value_or(start_)) {}

  [[nodiscard]] double seconds() const { return seconds_between(start_, Clock::now()); }
  [[nodiscard]] bool sweeps_left() const { return report.sweeps < options_.max_sweeps; }
  /// The number of the next sweep; 0 before the first, while the input is made regular.
  [[nodiscard]] int next_sweep() const { return report.sweeps == 0 ? 0 : report.sweeps + 1; }
  [[nodiscard]] bool stopped_early() const { return temper::stopped_early(report.stopped); }
  /// Says whether there is time for more.
  [[nodiscard]] bool goes_on() const { return !stopped_early() && sweeps_left(); }
  /// From here on there are sweeps. What has been done so far, copies and measures of the whole mesh, is done again
  /// when they end, and takes about as long: the time limit is of all of it.
  void begin_sweeps() {
    if (ending_seconds_ == 0) ending_seconds_ = seconds_between(limit_from_, Clock::now());
  }
  /// A mesh of the run may be saved: says so to the listener, if there is one.
  void offer(const WorkingCopy& now, const Settings& settings, const SweepState& state) const;
  /// Asks the clock and the caller, who are those of rank 0; sets report.stopped when the answer is yes. Ranks ask at
  /// the same places and get the same answer. While each does other things, `alone`, rank 0 alone gets one.
  bool asked_to_stop(double fraction_of_sweep, bool alone = false);
  /// All ranks stop if rank 0 was told to.
  void sync_stop();

  void count(const Flipper::Changes& changes) {
    report.flips += changes.flips;
    report.vertices_removed += changes.removed;
    report.vertices_inserted += changes.inserted;
  }

  OptimizeReport report;
  RunFacts facts;
  int repair_trials_left;
  const WorkingCopy* best_before = nullptr;  ///< of the stages before, while a stage planned another mesh

 private:
  using Clock = std::chrono::steady_clock;
  static double seconds_between(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
  }

  void ask(double fraction_of_sweep);

  const OptimizeOptions& options_;
  const OptimizeHooks& hooks_;
  const Mesh& input_;
  Clock::time_point start_, limit_from_;
  double ending_seconds_ = 0;  // after the last sweep, about
};

// All ranks of a run must be given the same. Otherwise each goes its own way, and waits forever.

/// The error, on every rank, when one of them has another mesh, other options or another version of temper than rank 0;
/// or when some have a tracer and some have none.
[[nodiscard]] std::optional<InputError> expect_agreement(const OptimizeHooks& hooks, const OptimizeOptions& options,
                                                         const Mesh& mesh);

/// The sweeps until the gain of one is below the tolerance, if gains go on shrinking by one factor a sweep, as sweeps
/// for barriers do near their end. None where that cannot be told: in the first sweeps of a stage (one objective, one
/// γ), where the energy rises or gains do not shrink, and with StoppingRule::paper. Stages that may follow are not
/// known yet.
[[nodiscard]] std::optional<double> estimate_sweeps_left(std::span<const SweepRecord> history,
                                                         const OptimizeOptions& options);

}  // namespace temper
