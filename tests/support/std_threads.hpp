// An Executor of plain threads, started anew by every run: what results must not depend on.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <thread>
#include <vector>

#include "temper/detail/executor.hpp"

namespace temper::test {

class StdThreads final : public Executor {
 public:
  explicit StdThreads(std::size_t threads) : threads_(threads) {}

  void run(std::size_t n, const std::function<void(std::size_t)>& block) override {
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
      for (std::size_t i = next++; i < n; i = next++) block(i);
    };
    std::vector<std::thread> others;
    for (std::size_t i = 1; i < threads_; ++i) others.emplace_back(work);
    work();
    for (std::thread& other : others) other.join();
    ++runs_;
  }
  /// Runs so far: a test of nothing would have none.
  [[nodiscard]] std::size_t runs() const { return runs_; }

 private:
  std::size_t threads_;
  std::size_t runs_ = 0;
};

}  // namespace temper::test
