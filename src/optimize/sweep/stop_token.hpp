// The stop token of a sweep over many vertices: all threads ask whether to go on, one of them finds out.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>

#include "base/assert.hpp"
#include "optimize/run/run.hpp"

namespace temper {

/// The thread that called asks the clock and the caller; the others hear of the answer.
class StopToken {
 public:
  /// To be made in the thread that is to ask.
  StopToken(Run& run, std::size_t n_vertices)
      : run_(run), caller_(this_thread()), n_(static_cast<double>(std::max<std::size_t>(1, n_vertices))) {}

  /// Has the caller asked before the next stretch. To be called from the thread that asks.
  void ask_soon() {
    TEMPER_ASSERT(this_thread() == caller_);
    since_asked_ = kVerticesBetweenCalls;
  }
  /// Begins and ends what each rank does alone: rank 0 asks meanwhile, the others get the answer at the end.
  void begin_local(std::size_t n_ranks) {
    run_.begin_local();
    n_ranks_ = n_ranks;
  }
  void end_local() {
    n_ranks_ = 1;
    run_.end_local();
    if (run_.stopped_early()) stop_.store(true, std::memory_order_relaxed);
    ask_soon();  // on all ranks, however much each has done
  }
  /// To be asked before each stretch of vertices: says whether to go on.
  [[nodiscard]] bool goes_on() {
    if (stop_.load(std::memory_order_relaxed)) return false;
    if (this_thread() != caller_ || since_asked_ < kVerticesBetweenCalls) return true;
    since_asked_ = 0;
    const bool stop = run_.asked_to_stop(static_cast<double>(done_.load(std::memory_order_relaxed)) / n_);
    if (stop) stop_.store(true, std::memory_order_relaxed);
    return !stop;
  }
  /// To be told after each stretch, some of whose vertices must wait for another phase.
  void passed(std::size_t vertices, std::size_t left) {
    done_.fetch_add(n_ranks_ * (vertices - left), std::memory_order_relaxed);  // the others do about as much
    if (this_thread() == caller_) since_asked_ += vertices;
  }
  [[nodiscard]] bool stopped() const { return stop_.load(std::memory_order_relaxed); }

 private:
  static constexpr std::size_t kVerticesBetweenCalls = 8192;  // of the observer and the clock: a few milliseconds

  /// A different address in each thread.
  static const void* this_thread() {
    thread_local const char here = 0;
    return &here;
  }

  Run& run_;
  const void* caller_;
  double n_;
  std::size_t n_ranks_ = 1;                          // that are at work on other vertices
  std::size_t since_asked_ = kVerticesBetweenCalls;  // the caller's own
  std::atomic<bool> stop_ = false;
  std::atomic<std::size_t> done_ = 0;
};

}  // namespace temper
