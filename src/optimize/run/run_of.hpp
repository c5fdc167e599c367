// What a run over a mesh of any cells is: the report that it writes, the clock, the caller who may stop it, and the
// listener that may get the best mesh so far.
#pragma once

#include <chrono>
#include <limits>
#include <optional>
#include <utility>

#include "temper/optimize.hpp"

namespace temper {

/// The best mesh so far: the one with the least measure. Kept is a mesh with what belongs to it.
template <class Kept>
struct Best {
  std::optional<Kept> kept = {};
  double measure = std::numeric_limits<double>::infinity();

  /// Says whether a mesh of measure `now` is better; with `or_equal` also one of the same measure.
  [[nodiscard]] bool is_beaten_by(double now, bool or_equal = false) const {
    return now < measure || (or_equal && now == measure);
  }
};

/// Hooks and Report are those of the mesh: OptimizeHooks and OptimizeReport, here or in temper::tets.
template <class Hooks, class Report>
class RunOf {
 public:
  RunOf(const OptimizeOptions& options, const Hooks& hooks)
      : options_(options), hooks_(hooks), start_(Clock::now()), limit_from_(hooks.started.value_or(start_)) {}

  [[nodiscard]] double seconds() const { return seconds_between(start_, Clock::now()); }
  [[nodiscard]] bool sweeps_left() const { return report.sweeps < options_.max_sweeps; }
  [[nodiscard]] bool stopped_early() const { return temper::stopped_early(report.stopped); }
  /// Says whether there is time for more.
  [[nodiscard]] bool goes_on() const { return !stopped_early() && sweeps_left(); }
  /// Call this before the first sweep. The work so far, copies and measures of the whole mesh, is repeated at the end
  /// and takes about as long. The time limit includes all of it.
  void begin_sweeps() {
    if (ending_seconds_ == 0) ending_seconds_ = seconds_between(limit_from_, Clock::now());
  }
  /// Puts a measured mesh into the history, as the one after the last sweep.
  void record(SweepRecord measured) {
    measured.sweep = report.sweeps;
    measured.seconds = seconds();
    report.history.push_back(measured);
  }

  /// Ends the clock.
  [[nodiscard]] Report take_report() {
    report.seconds = seconds();
    return std::move(report);
  }

  Report report;

 protected:
  /// Asks the clock, then the caller, and sets report.stopped if the answer is yes. `complete` adds estimates to the
  /// progress that the caller gets.
  template <class Complete>
  void ask(double fraction_of_sweep, const Complete& complete) {
    const double limit = options_.time_limit;  // 0: none
    if (limit > 0 && seconds_between(limit_from_, Clock::now()) + ending_seconds_ > limit) {
      report.stopped = Stopped::time_limit;
    } else if (hooks_.observer) {
      Progress progress = {report.history.back(), fraction_of_sweep, options_.max_sweeps};
      complete(progress);
      if (hooks_.observer(progress) == Continue::no) report.stopped = Stopped::canceled;
    }
  }
  /// Offers a mesh to the listener, if there is one. `best` calls its argument with the mesh, or does nothing.
  template <class Give>
  void offer(const Give& best) const {
    if (hooks_.best_so_far) hooks_.best_so_far(best);
  }

  const OptimizeOptions& options_;
  const Hooks& hooks_;

 private:
  using Clock = std::chrono::steady_clock;
  static double seconds_between(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
  }

  Clock::time_point start_, limit_from_;
  double ending_seconds_ = 0;  // estimated time from the last sweep to the end
};

}  // namespace temper
