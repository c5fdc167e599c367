// The clock and the caller, asked from all loops of the mesher: one of them may be enough to run for hours, where the
// outline has edges of very different lengths.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>

#include "temper/detail/progress.hpp"

namespace temper::mesher {

/// When a run must end, by its time limit or its observer.
class Deadline {
 public:
  /// `time_limit`: seconds from now; 0: none.
  Deadline(double time_limit, const Observer& observer)
      : limit_(time_limit), observer_(observer), start_(Clock::now()) {}

  /// Says whether to stop, and goes on saying so. Cheap: most calls only count, some hundredths of a second of them.
  /// What takes no longer than that is not stopped.
  bool asked_to_stop() {
    constexpr std::size_t kCallsAtATime = 16384;
    if (!stopped_ && ++calls_ % kCallsAtATime == 0) stopped_ = out_of_time() || refused();
    return stopped_;
  }
  [[nodiscard]] bool stopped() const { return stopped_; }
  [[nodiscard]] bool out_of_time() const { return limit_ > 0 && seconds() > limit_; }
  /// The limit of what is still to do: seconds, more than 0; 0: none.
  [[nodiscard]] double time_left() const {
    constexpr double kLeast = 1e-3;
    return limit_ > 0 ? std::max(kLeast, limit_ - seconds()) : 0;
  }

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  [[nodiscard]] bool refused() const { return observer_ && observer_({}) == Continue::no; }

  double limit_;
  const Observer& observer_;
  Clock::time_point start_;
  std::size_t calls_ = 0;
  bool stopped_ = false;
};

}  // namespace temper::mesher
