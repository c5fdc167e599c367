// Ranks: processes that make one run together, as MPI has them; one small interface, so that the core itself knows of
// no library for them.
//
// Each rank has the whole mesh and makes the same calls in the same order. Where work is cut into parts, each does some
// and tells the others what it changed; all else each does for itself. So all end with the same bytes, and with those
// of a run alone.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace temper {

class Ranks {
 public:
  virtual ~Ranks() = default;
  /// How many there are, at least 1.
  [[nodiscard]] virtual std::size_t size() const = 0;
  /// The number of this one, from 0.
  [[nodiscard]] virtual std::size_t rank() const = 0;
  /// What each rank gives, by rank, to all of them. Collective: it returns when every rank has called it.
  [[nodiscard]] virtual std::vector<std::string> all_gather(std::string_view mine) = 0;
};

}  // namespace temper
