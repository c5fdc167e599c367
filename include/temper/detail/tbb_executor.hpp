// Threads by oneTBB, for whatever takes an Executor: in a library of its own (temper::tbb).
//
//   temper::TbbExecutor threads;
//   temper::optimize(mesh, {}, {.executor = &threads});
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "temper/detail/executor.hpp"

namespace temper {

/// A task arena. Nothing is started before the first run(); threads are oneTBB's, shared with all else that uses it.
class TbbExecutor final : public Executor {
 public:
  /// `threads`: at most so many at once, the caller of run() among them; 0: as many as the machine has.
  explicit TbbExecutor(std::size_t threads = 0);
  ~TbbExecutor() override;
  TbbExecutor(const TbbExecutor&) = delete;
  TbbExecutor& operator=(const TbbExecutor&) = delete;

  /// May be called from several threads at once, and from within a block.
  void run(std::size_t n, const std::function<void(std::size_t)>& block) override;
  [[nodiscard]] std::size_t threads() const;

 private:
  struct Arena;
  std::unique_ptr<Arena> arena_;
};

}  // namespace temper
