// Threads for sums over the mesh: a small pool of std::thread behind the library's Executor.
//
// Blocks are taken from a counter, so which thread runs which block varies; results do not, because the
// number of blocks is the caller's and each block writes only its own part.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "temper/executor.hpp"

namespace temper::app {

class ThreadPool final : public Executor {
 public:
  /// The caller of run() is one of the threads; the others are started by the first run().
  explicit ThreadPool(std::size_t threads) : helpers_(threads > 0 ? threads - 1 : 0) {}
  ~ThreadPool() override;
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  void run(std::size_t n, const std::function<void(std::size_t)>& block) override;

 private:
  void help();
  void take_blocks(std::unique_lock<std::mutex>& lock);

  std::size_t helpers_;
  std::vector<std::thread> threads_;
  std::mutex mutex_;
  std::condition_variable work_, done_;
  const std::function<void(std::size_t)>* block_ = nullptr;
  std::size_t next_ = 0, size_ = 0;  // blocks not yet taken: next_ … size_ − 1
  std::size_t running_ = 0;          // blocks taken and not finished
  bool stop_ = false;
};

/// What --threads 0 means: as many as the machine has, at least 1.
[[nodiscard]] std::size_t hardware_threads();

}  // namespace temper::app
