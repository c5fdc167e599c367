// One line on a terminal that says how far a long run is, and how long it will about take when that can be told.
#pragma once

#include <chrono>

#include "temper/detail/progress.hpp"

namespace temper::app {

class ProgressLine {
 public:
  /// Not shown in a pipe: enabled = standard error is a terminal.
  explicit ProgressLine(bool enabled) : enabled_(enabled), start_(Clock::now()) {}
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// At most ten times a second.
  void show(const Progress& progress);
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  bool enabled_;
  bool shown_ = false;
  Clock::time_point start_, last_ = {};
};

}  // namespace temper::app
