// Ranks that are threads of one process: the messages of several processes, without them.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "temper/detail/executor.hpp"

namespace temper::test {

/// A std::barrier for all systems: the class of libstdc++ 12 leaves threads asleep on Windows.
class Barrier {
 public:
  explicit Barrier(std::size_t n_threads) : n_threads_(n_threads) {}
  void arrive_and_wait() {
    std::unique_lock lock(mutex_);
    if (++n_arrived_ % n_threads_ == 0) return all_.notify_all();
    all_.wait(lock, [&, end = (n_arrived_ / n_threads_ + 1) * n_threads_] { return n_arrived_ >= end; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable all_;
  std::size_t n_threads_, n_arrived_ = 0;  // in all rounds together
};

/// Calls run(communicator) for each of n ranks, at once, and waits for all.
inline void on_ranks(std::size_t n, const std::function<void(Communicator&)>& run) {
  struct Board {
    explicit Board(std::size_t n_ranks) : size(n_ranks), all(n_ranks) {}
    std::size_t size;
    std::string message;
    Barrier all;
  };
  class OneRank final : public Communicator {
   public:
    OneRank(Board& board, std::size_t rank) : board_(board), rank_(rank) {}
    [[nodiscard]] std::size_t size() const override { return board_.size; }
    [[nodiscard]] std::size_t rank() const override { return rank_; }
    void broadcast(std::string& bytes, std::size_t from) override {
      if (rank_ == from) board_.message = bytes;
      board_.all.arrive_and_wait();
      bytes = board_.message;
      board_.all.arrive_and_wait();  // nobody sends the next before all have this one
    }

   private:
    Board& board_;
    std::size_t rank_;
  };
  Board board(n);
  std::vector<std::thread> threads;
  for (std::size_t rank = 0; rank < n; ++rank) {
    threads.emplace_back([&, rank] {
      OneRank one(board, rank);
      run(one);
    });
  }
  for (std::thread& thread : threads) thread.join();
}

}  // namespace temper::test
