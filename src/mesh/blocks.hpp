// Loops in blocks (base/loops.hpp) that may end early.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <optional>
#include <utility>

#include "base/loops.hpp"
#include "temper/detail/executor.hpp"

namespace temper {

/// Runs blocks by another executor until it is time to stop, and skips the others. The results are then of no use.
class StoppableExecutor final : public Executor {
 public:
  /// `stop` is asked in the calling thread, and may be empty.
  StoppableExecutor(Executor* executor, std::function<bool()> stop)
      : executor_(or_serial(executor)), stop_(std::move(stop)) {}

  void run(std::size_t n, const std::function<void(std::size_t)>& block) override {
    constexpr std::size_t kAtATime = 32;  // some hundredths of a second, and enough for many threads
    for (std::size_t first = 0; first < n && !asked_to_stop(); first += kAtATime) {
      executor_.run(std::min(kAtATime, n - first), [&](std::size_t i) { block(first + i); });
    }
  }
  bool asked_to_stop() {
    stopped_ = stopped_ || (stop_ && stop_());
    return stopped_;
  }

 private:
  Executor& executor_;
  std::function<bool()> stop_;
  bool stopped_ = false;
};

/// The least i with wrong(i); make_test() gives each block a test of its own. Blocks behind a found index are skipped.
template <class MakeTest>
std::optional<std::size_t> first_index_by(std::size_t n, Executor* executor, MakeTest&& make_test) {
  std::atomic<std::size_t> found = n;
  for_blocks(n, executor, [&](std::size_t first, std::size_t last) {
    if (first >= found.load(std::memory_order_relaxed)) return;
    auto wrong = make_test();
    std::size_t i = first;
    while (i < last && !wrong(i)) ++i;
    std::size_t least = found.load(std::memory_order_relaxed);
    while (i < last && i < least && !found.compare_exchange_weak(least, i, std::memory_order_relaxed)) {
    }
  });
  return found < n ? std::optional(found.load()) : std::nullopt;
}

template <class Wrong>
std::optional<std::size_t> first_index(std::size_t n, Executor* executor, const Wrong& wrong) {
  return first_index_by(n, executor, [&] { return [&](std::size_t i) { return wrong(i); }; });
}

}  // namespace temper
