// Threads by oneTBB, for all functions with an Executor. It is a library of its own, temper::tbb.
//
//   temper::TbbExecutor threads;
//   temper::optimize(mesh, {}, {.executor = &threads});
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "temper/detail/executor.hpp"

namespace temper {

/// A task arena. Nothing starts before the first run(). The threads are oneTBB's, shared with all its other users.
class TbbExecutor final : public Executor {
 public:
  /// More threads than this only wait for each other, and each of them costs memory: 4 times the processors, or 16.
  [[nodiscard]] static std::size_t most_threads();

  /// `threads`: largest number of threads at once, the caller of run() included; 0: as many as the machine has. A
  /// number above most_threads() counts as most_threads().
  explicit TbbExecutor(std::size_t threads = 0);
  ~TbbExecutor() override;
  TbbExecutor(const TbbExecutor&) = delete;
  TbbExecutor& operator=(const TbbExecutor&) = delete;

  /// May be called from several threads at once, and from inside a block.
  void run(std::size_t n, const std::function<void(std::size_t)>& block) override;
  [[nodiscard]] std::size_t threads() const;

 private:
  struct Arena;
  std::unique_ptr<Arena> arena_;
};

}  // namespace temper
