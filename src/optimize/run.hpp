// What the attempts of one call of optimize share, and what they are judged by.
#pragma once

#include <chrono>
#include <cstddef>

#include "energy/whole_mesh.hpp"
#include "temper/optimize.hpp"

namespace temper {

/// Triangles that are not counter-clockwise, exact.
[[nodiscard]] std::size_t count_inverted(const Mesh& mesh);

/// What the attempts of one call of optimize share: the report that grows, the clock, and the caller's ear.
class Run {
 public:
  Run(const OptimizeOptions& options, const Observer& observer)
      : repair_trials_left(options.repair_trials), options_(options), observer_(observer), start_(Clock::now()) {}

  [[nodiscard]] double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  [[nodiscard]] bool sweeps_left() const { return report.sweeps < options_.max_sweeps; }
  /// The number of the next sweep; 0 before the first, while the input is made regular.
  [[nodiscard]] int next_sweep() const { return report.sweeps == 0 ? 0 : report.sweeps + 1; }
  [[nodiscard]] bool stopped_by_caller() const {
    return report.stopped == Stopped::cancelled || report.stopped == Stopped::time_limit;
  }
  /// Asks the clock and the caller; sets report.stopped when the answer is yes.
  bool asked_to_stop(double fraction_of_sweep);

  OptimizeReport report;
  int repair_trials_left;

 private:
  using Clock = std::chrono::steady_clock;

  const OptimizeOptions& options_;
  const Observer& observer_;
  Clock::time_point start_;
};

}  // namespace temper
