// The clock and the caller, checked in all loops of the mesher: each of them may run for hours if the outline has edges
// of very different lengths. The caller hears of each phase here.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <string_view>

#include "temper/detail/progress.hpp"

namespace temper::mesher {

/// The deadline of a run, by its time limit or its observer.
class Deadline {
 public:
  /// `time_limit`: seconds from now; 0: none.
  Deadline(double time_limit, const Observer& observer)
      : limit_(time_limit), observer_(observer), start_(Clock::now()) {}

  /// Begins a phase with its name. `calls`: about the number of calls of asked_to_stop() in it; 0: unknown.
  void begin(std::string_view phase, double calls = 0) {
    phase_ = phase;
    calls_of_phase_ = calls;
    calls_before_phase_ = calls_;
    ask();
  }

  /// Returns true when it is time to stop, and then always. Cheap: most calls only count. Calls at most a millisecond
  /// apart end the work within a second. Work of a tenth of a second and few calls is not stopped by the observer.
  bool asked_to_stop() {
    constexpr std::size_t kCallsAtATime = 256;
    return ++calls_ % kCallsAtATime == 0 ? ask() : stopped_;
  }
  /// The same at once, for loops whose steps take longer.
  bool ask() {
    if (!stopped_) stopped_ = out_of_time() || refused();
    return stopped_;
  }
  [[nodiscard]] bool stopped() const { return stopped_; }
  [[nodiscard]] bool out_of_time() const { return limit_ > 0 && seconds() > limit_; }
  /// The time limit for the remaining work: seconds, more than 0; 0: none.
  [[nodiscard]] double time_left() const {
    constexpr double kLeast = 1e-3;
    return limit_ > 0 ? std::max(kLeast, limit_ - seconds()) : 0;
  }

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  [[nodiscard]] bool refused() {
    constexpr std::size_t kManyCalls = 16384;
    constexpr double kInterval = 0.1;  // seconds
    if (!observer_ || ((calls_ == 0 || calls_ % kManyCalls != 0) && seconds() - asked_ < kInterval)) return false;
    asked_ = seconds();
    Progress progress;
    progress.phase = phase_;
    progress.fraction = share();
    return observer_(progress) == Continue::no;
  }
  /// Of the phase. An estimate of its calls may be too small.
  [[nodiscard]] double share() const {
    constexpr double kMost = 0.99;
    const auto calls = static_cast<double>(calls_ - calls_before_phase_);
    return calls_of_phase_ > 0 ? std::min(kMost, calls / calls_of_phase_) : 0;
  }

  double limit_;
  const Observer& observer_;
  Clock::time_point start_;
  std::size_t calls_ = 0, calls_before_phase_ = 0;
  std::string_view phase_;
  double calls_of_phase_ = 0;
  double asked_ = 0;  // seconds
  bool stopped_ = false;
};

}  // namespace temper::mesher
