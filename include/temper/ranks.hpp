// Ranks: processes that make one run together, as MPI has them; one small interface, so that the core itself knows of
// no library for them.
//
// Each rank has the whole mesh and makes the same calls in the same order. Where work is cut into parts, each does some
// and tells the others what it changed; all else each does for itself. So all end with the same bytes, and with those
// of a run alone.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "temper/executor.hpp"

namespace temper {

class Ranks {
 public:
  virtual ~Ranks() = default;
  /// How many there are, at least 1.
  [[nodiscard]] virtual std::size_t size() const = 0;
  /// The number of this one, from 0.
  [[nodiscard]] virtual std::size_t rank() const = 0;
  /// Gives all of them the bytes that rank `from` has. Collective: all call it, at the same places.
  virtual void broadcast(std::string& bytes, std::size_t from) = 0;

  /// What each rank gives, by rank, to all of them. Collective.
  [[nodiscard]] std::vector<std::string> all_gather(std::string_view mine) {
    std::vector<std::string> all(size());
    all[rank()] = mine;
    for (std::size_t r = 0; r < all.size(); ++r) broadcast(all[r], r);
    return all;
  }

 protected:
  /// Calls f(data, count) for one piece of the bytes after the other, each of so many as one message of MPI, which
  /// counts in int, can have.
  template <class F>
  static void in_pieces(std::string& bytes, const F& f) {
    constexpr std::size_t kMostBytes = std::size_t{1} << 30;
    for (std::size_t begin = 0; begin < bytes.size(); begin += kMostBytes) {
      f(bytes.data() + begin, std::min(kMostBytes, bytes.size() - begin));
    }
  }
};

/// A run of n parts, those that one rank does.
struct Share {
  std::size_t first, last;
  Share(std::size_t n, std::size_t rank, std::size_t n_ranks)
      : first(n * rank / n_ranks), last(n * (rank + 1) / n_ranks) {}
};

/// The threads of an executor, with ranks that share out sums.
class RankedExecutor final : public Executor {
 public:
  RankedExecutor(Executor& threads, Ranks& ranks) : threads_(threads), ranks_(ranks) {}
  [[nodiscard]] Ranks* ranks() override { return &ranks_; }
  void run(std::size_t n, const std::function<void(std::size_t)>& block) override { threads_.run(n, block); }

 private:
  Executor& threads_;
  Ranks& ranks_;
};

}  // namespace temper
