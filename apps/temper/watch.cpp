#include "watch.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>

#include "exit.hpp"
#include "system/system.hpp"
#include "temper/io.hpp"

namespace temper::app {

Watch::Watch(double seconds) {
  catch_interrupts();
  thread_ = std::thread([this, seconds] { wait(seconds); });
}

Watch::~Watch() {
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
  }
  ended_.notify_one();
  thread_.join();
}

void Watch::wait(double seconds) {
  constexpr auto kBetweenLooks = std::chrono::milliseconds(50);
  const auto start = std::chrono::steady_clock::now();
  std::unique_lock lock(mutex_);
  while (!ended_.wait_for(lock, kBetweenLooks, [this] { return is_over_; })) {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    const bool is_late = seconds > 0 && passed.count() > seconds;
    if (!is_late && !interrupted()) continue;
    io::discard_unfinished();
    write_to_error(fmt::format("temper: error: stopped by {} after {:.1f} s, before the end: nothing is written\n",
                               is_late ? "--time-limit" : "a signal", passed.count()));
    std::_Exit(static_cast<int>(Exit::stopped_early));
  }
}

}  // namespace temper::app
