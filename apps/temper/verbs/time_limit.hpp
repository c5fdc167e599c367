// --time-limit is of the whole run: what the library may take is less, by what reading took and writing will take.
#pragma once

#include <algorithm>
#include <chrono>

namespace temper::app {

class TimeLimit {
 public:
  /// Seconds of the limit that are left for the library, more than 0; 0: none was set. What has been read is written
  /// again, in about the same time.
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
