// Runs work that is cut into parts: on threads of this process, and on other ranks if there are any.
#pragma once

#include <cstddef>
#include <string>

#include "base/assert.hpp"
#include "base/bytes.hpp"
#include "temper/detail/executor.hpp"

namespace temper {

class Engine {
 public:
  /// An executor alone is an engine of one rank. Null: no threads, and no other ranks.
  Engine(Executor* threads, Communicator* ranks = nullptr)  // NOLINT(google-explicit-constructor)
      : executor_(or_serial(threads)), ranks_(ranks) {}

  [[nodiscard]] bool has_ranks() const { return ranks_ != nullptr; }
  [[nodiscard]] std::size_t n_ranks() const { return has_ranks() ? ranks_->size() : 1; }
  [[nodiscard]] Executor& executor() const { return executor_; }

  /// Runs part(i) for this rank's share of n parts.
  template <class Run>
  void run(std::size_t n, Run&& part) const {
    const std::size_t rank = has_ranks() ? ranks_->rank() : 0, first = first_of(rank, n);
    executor_.run(first_of(rank + 1, n) - first, [&](std::size_t i) { part(first + i); });
  }

  /// After run(): write(writer, i) writes the result of part i, and read(reader, i) restores it on the other ranks.
  /// Then all ranks have the results of a single one. Collective.
  template <class Write, class Read>
  void exchange(std::size_t n, Write&& write, Read&& read) const {
    for (std::size_t r = 0; has_ranks() && r < n_ranks(); ++r) {
      std::string message;
      ByteWriter writer(message);
      const bool own = r == ranks_->rank();
      for (std::size_t i = first_of(r, n); own && i < first_of(r + 1, n); ++i) write(writer, i);
      ranks_->broadcast(message, r);
      if (own) continue;
      ByteReader reader(message);
      for (std::size_t i = first_of(r, n); i < first_of(r + 1, n); ++i) read(reader, i);
      TEMPER_ASSERT(reader.at_end());
    }
  }

 private:
  /// The first of n parts that belongs to this rank.
  [[nodiscard]] std::size_t first_of(std::size_t rank, std::size_t n) const { return n * rank / n_ranks(); }

  Executor& executor_;
  Communicator* ranks_;
};

}  // namespace temper
