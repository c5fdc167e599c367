// An end for work that cannot stop by itself, such as a linear program.
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

namespace temper::app {

/// While it lives, a signal or the end of a time limit ends the process with Exit::stopped_early, within a moment. Only
/// for work that has written nothing yet.
class Watch {
 public:
  /// `seconds` from now; 0: no limit.
  explicit Watch(double seconds);
  ~Watch();
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

 private:
  void wait(double seconds);

  std::mutex mutex_;
  std::condition_variable ended_;
  bool is_over_ = false;
  std::thread thread_;
};

}  // namespace temper::app
