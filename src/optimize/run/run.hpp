// One run of optimize() over a mesh of triangles.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>

#include "base/engine.hpp"
#include "optimize/flips/flipper.hpp"
#include "optimize/flips/grading.hpp"
#include "optimize/run/run_of.hpp"
#include "temper/optimize.hpp"

namespace temper {

/// The threads and ranks of a run.
[[nodiscard]] inline Engine engine_of(const OptimizeHooks& hooks) { return {hooks.executor, hooks.communicator}; }

/// Counts the triangles that are not counter-clockwise, exactly.
[[nodiscard]] std::size_t count_inverted(const Mesh& mesh);

/// Facts for the sentences of the report.
struct RunFacts {
  std::size_t input_flips = 0;                 ///< that made the input regular
  std::optional<SplitCounts> boundary_splits;  ///< if the options ask for splits
  SplitCounts splits_where_bad;                ///< at bad triangles, before the last restart with such splits
  bool stays_unsplit = false;                  ///< the boundary, since cuts leave more triangles bad
  bool weights_shrunk = false;                 ///< all weights, since they left edges uncrossed
  bool meets_limits = false;                   ///< the input: those of its client, so it comes back
  bool meets_criterion = false;                ///< the input: that of its target, so it comes back
  bool many_are_bad = false;                   ///< so the whole mesh changes, not only their places
  std::size_t places_left = 0;                 ///< triangles that rings left bad, so that the whole mesh changes
  bool gave_up = false;                        ///< in a metric, restarts left most triangles bad
  std::optional<double> error_ratio;           ///< above 1: of measured errors on the mesh of the run to the input's
  bool keeps_input = false;                    ///< for that reason
  bool energy_rose = false;                    ///< in the last sweeps, which were undone
  bool lacks_programs = false;                 ///< a repair would use linear programs, but the build has no solver
};

/// During its life, this mesh is the best one so far, while a stage works on another.
class BestBefore {
 public:
  BestBefore(const WorkingCopy*& place, const WorkingCopy* best) : place_(place) { place_ = best; }
  ~BestBefore() { place_ = nullptr; }
  BestBefore(const BestBefore&) = delete;
  BestBefore& operator=(const BestBefore&) = delete;

 private:
  const WorkingCopy*& place_;
};

class Run : public RunOf<OptimizeHooks, OptimizeReport> {
 public:
  /// `input`: the caller's mesh, for the places of vertices that stay.
  Run(const OptimizeOptions& options, const OptimizeHooks& hooks, const Mesh& input)
      : RunOf(options, hooks),
        input_(input),
        trials_left_(options.repair_trials),
        most_trial_triangles_(most_trial_triangles(options, input)) {}

  /// Returns the number of the next sweep; 0 before the first sweep, while flips make the input regular.
  [[nodiscard]] int next_sweep() const { return report.sweeps == 0 ? 0 : report.sweeps + 1; }
  /// Returns how many trials repairs may still make. Large neighborhoods use up a second budget, which depends on the
  /// size of the mesh.
  [[nodiscard]] int repair_trials_left() const { return trial_triangles_left_ > 0 ? std::max(0, trials_left_) : 0; }
  /// Counts `trials` trials of a repair on a neighborhood of n triangles.
  void count_trials(int trials, std::size_t n) {
    trials_left_ -= trials;
    trial_triangles_left_ -= static_cast<double>(trials) * static_cast<double>(n);
  }
  /// Gives repairs their budgets again, for another attempt.
  void renew_trials() {
    trials_left_ = options_.repair_trials;
    trial_triangles_left_ = most_trial_triangles_;
  }
  /// Offers a mesh of the run to the listener, if there is one, which may save it.
  void offer(const WorkingCopy& now, const Settings& settings, const SweepState& state) const;
  /// Asks the clock and the caller of rank 0, and sets report.stopped if the answer is yes. Ranks call this at the same
  /// places and get the same answer. While ranks do different work, `alone`, only rank 0 gets an answer.
  bool asked_to_stop(double fraction_of_sweep, bool alone = false);
  /// Stops all ranks if rank 0 must stop.
  void sync_stop();

  void count(const Flipper::Changes& changes) { report.flips += changes.flips; }

  RunFacts facts;
  std::optional<std::size_t> n_vertices;     ///< of the mesh, for the progress of a search for fewer
  const WorkingCopy* best_before = nullptr;  ///< of earlier stages, while a stage works on another mesh

 private:
  static double most_trial_triangles(const OptimizeOptions& options, const Mesh& input);

  const Mesh& input_;
  int trials_left_;
  const double most_trial_triangles_;  // of all trials together; kept here because a run may fold the input up
  double trial_triangles_left_ = most_trial_triangles_;
};

// All ranks of a run must get the same input. Otherwise they wait for each other forever.

/// Returns an error on every rank if a rank has another mesh, other options or another version of temper than rank 0.
/// It also returns an error if only some ranks have a tracer.
[[nodiscard]] std::optional<InputError> expect_agreement(const OptimizeHooks& hooks, const OptimizeOptions& options,
                                                         const Mesh& mesh);

/// Estimates the number of sweeps until the gain of a sweep is below the tolerance. It assumes that gains shrink by one
/// factor per sweep, as they do for barriers near the end. Returns none in the first sweeps of a stage (one objective,
/// one γ), if the energy rises or gains do not shrink, and with StoppingRule::paper. Later stages are not known yet.
[[nodiscard]] std::optional<double> estimate_sweeps_left(std::span<const SweepRecord> history,
                                                         const OptimizeOptions& options);
/// Estimates the share of the present phase that is done, see Progress. Phases after the first one have a limit of
/// sweeps; the first one needs an estimate of the sweeps left.
[[nodiscard]] std::optional<double> share_of_phase(std::span<const SweepRecord> history, const OptimizeOptions& options,
                                                   double fraction_of_sweep);

}  // namespace temper
