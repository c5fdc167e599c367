// One line on a terminal with the progress of a long run, and an estimate of its remaining time if there is one.
#pragma once

#include <algorithm>
#include <chrono>
#include <string_view>

#include "temper/detail/progress.hpp"

namespace temper::app {

class ProgressLine {
 public:
  /// Not shown in a pipe: enabled = standard error is a terminal.
  explicit ProgressLine(bool enabled, std::string_view elements = "triangles")
      : enabled_(enabled), elements_(elements), start_(Clock::now()) {}
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// At most ten times a second.
  void show(const Progress& progress);
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  bool enabled_;
  std::string_view elements_;
  bool shown_ = false;
  Clock::time_point start_, last_ = {};
};

class TimeLimit {
 public:
  /// Seconds of the limit that are left for the library, more than 0; without a limit 0. It reserves the time that
  /// reading took for writing.
  [[nodiscard]] double left(double limit) const {
    constexpr double kLeast = 1e-3;
    const double so_far = std::chrono::duration<double>(Clock::now() - began_).count();
    return limit > 0 ? std::max(kLeast, limit - 2 * so_far) : 0;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point began_ = Clock::now();
};

}  // namespace temper::app
