// Ranks that are threads of one process: the messages of several processes, without them.
#pragma once

#include <barrier>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "temper/detail/executor.hpp"

namespace temper::test {

/// Calls run(communicator) for each of n ranks, at once, and waits for all.
inline void on_ranks(std::size_t n, const std::function<void(Communicator&)>& run) {
  struct Board {
    explicit Board(std::size_t n_ranks) : size(n_ranks), all(static_cast<std::ptrdiff_t>(n_ranks)) {}
    std::size_t size;
    std::string message;
    std::barrier<> all;
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
