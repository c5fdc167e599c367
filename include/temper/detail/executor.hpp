// An executor runs work on threads: one small interface, so that the core itself starts none.
//
// Work is cut into blocks whose number does not depend on the number of threads, and every block writes
// only its own results: the same bytes come out for any executor.
#pragma once

#include <cstddef>
#include <functional>

namespace temper {

class Executor {
 public:
  virtual ~Executor() = default;
  /// Runs block(0) … block(n − 1), each once, in any order and on any thread; returns when all are done.
  virtual void run(std::size_t n, const std::function<void(std::size_t)>& block) = 0;
};

/// Block after block, in the thread that calls.
class SerialExecutor final : public Executor {
 public:
  void run(std::size_t n, const std::function<void(std::size_t)>& block) override {
    for (std::size_t i = 0; i < n; ++i) block(i);
  }
};

/// The executor that is given, or a serial one where there is none.
[[nodiscard]] inline Executor& or_serial(Executor* executor) {
  static SerialExecutor serial;
  return executor != nullptr ? *executor : serial;
}

}  // namespace temper
