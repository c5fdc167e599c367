// An executor runs work on threads. It is one small interface, so that the core itself starts no threads.
//
// Work is cut into blocks. Their number does not depend on the number of threads, and every block writes only its own
// results. So every executor gives the same bytes.
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

/// Runs block after block in the calling thread.
class SerialExecutor final : public Executor {
 public:
  void run(std::size_t n, const std::function<void(std::size_t)>& block) override {
    for (std::size_t i = 0; i < n; ++i) block(i);
  }
};

/// The given executor, or a serial one if it is null.
[[nodiscard]] inline Executor& or_serial(Executor* executor) {
  static SerialExecutor serial;
  return executor != nullptr ? *executor : serial;
}

// Ranks are processes that make one run together, usually one per machine. A communicator passes bytes among them.
//
// Each rank has the whole mesh and makes the same calls in the same order. A sweep divides its parts among the ranks,
// and each sends its changes to the others. So all end with the same bytes as a single process.

class Communicator {
 public:
  virtual ~Communicator() = default;
  /// The number of ranks, at least 1.
  [[nodiscard]] virtual std::size_t size() const = 0;
  /// The number of this rank, from 0.
  [[nodiscard]] virtual std::size_t rank() const = 0;
  /// Sends the bytes of rank `from` to all ranks. Collective: all ranks call it, in the same order.
  virtual void broadcast(std::string& bytes, std::size_t from) = 0;

  /// Gives all ranks the bytes of each rank, sorted by rank. Collective.
  [[nodiscard]] std::vector<std::string> all_gather(std::string_view mine) {
    std::vector<std::string> all(size());
    all[rank()] = mine;
    for (std::size_t r = 0; r < all.size(); ++r) broadcast(all[r], r);
    return all;
  }

 protected:
  /// Calls f(data, count) for one piece of the bytes after another. MPI counts in int, which limits the size of a
  /// message.
  template <class F>
  static void in_pieces(std::string& bytes, const F& f) {
    constexpr std::size_t kMostBytes = std::size_t{1} << 30;
    for (std::size_t begin = 0; begin < bytes.size(); begin += kMostBytes) {
      f(bytes.data() + begin, std::min(kMostBytes, bytes.size() - begin));
    }
  }
};

}  // namespace temper
