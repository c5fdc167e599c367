// Ranks are processes that make one run together, one on each machine. A communicator passes bytes among them.
//
// Each rank has the whole mesh and makes the same calls in the same order. A sweep divides its parts among the ranks,
// and each sends the others what it changed. So all end with the same bytes, which are those of one process alone.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace temper {

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
