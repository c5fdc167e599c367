// An executor runs work on threads: one small interface, so that the core itself starts none.
//
// Work is cut into blocks whose number does not depend on the number of threads, and every block writes
// only its own results: the same bytes come out for any executor.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

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

// Ranks are processes that make one run together, one on each machine. A communicator passes bytes among them.
//
// Each rank has the whole mesh and makes the same calls in the same order. A sweep divides its parts among the ranks,
// and each sends the others what it changed. So all end with the same bytes, which are those of one process alone.

class Communicator {
 public:
  virtual ~Communicator() = default;
  /// The number of ranks, at least 1.
  [[nodiscard]] virtual std::size_t size() const = 0;
  /// The number of this rank, from 0.
  [[nodiscard]] virtual std::size_t rank() const = 0;
  /// Gives all ranks the bytes that rank `from` has. Collective: all ranks call it, in the same order.
  virtual void broadcast(std::string& bytes, std::size_t from) = 0;

  /// Gives all ranks what each of them has, by rank. Collective.
  [[nodiscard]] std::vector<std::string> all_gather(std::string_view mine) {
    std::vector<std::string> all(size());
    all[rank()] = mine;
    for (std::size_t r = 0; r < all.size(); ++r) broadcast(all[r], r);
    return all;
  }

 protected:
  /// Calls f(data, count) for one piece of the bytes after another. MPI counts in int: a message holds no more.
  template <class F>
  static void in_pieces(std::string& bytes, const F& f) {
    constexpr std::size_t kMostBytes = std::size_t{1} << 30;
    for (std::size_t begin = 0; begin < bytes.size(); begin += kMostBytes) {
      f(bytes.data() + begin, std::min(kMostBytes, bytes.size() - begin));
    }
  }
};

}  // namespace temper
