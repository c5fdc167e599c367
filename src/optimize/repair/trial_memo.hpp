// The results of trials at places that have not changed since.
//
// A search comes back to places that it could not cure, and each search begins with the same mesh. A trial depends on
// its neighborhood and its edit alone, so the same one need not be made twice. Two neighborhoods are the same if all
// their bytes are, which is exact.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>

#include "optimize/repair/neighborhood.hpp"
#include "optimize/repair/trial.hpp"

namespace temper {

class TrialMemo {
 public:
  /// The results at one place, without events. The key has the number of the tier, and of the edit in it.
  using Results = std::map<std::array<std::size_t, 2>, std::optional<TrialResult>>;

  /// Returns the results at this place. They may be gone after the next call. O(size of the neighborhood).
  [[nodiscard]] Results& at(const Neighborhood& around, Pace pace);

 private:
  // A place takes about 5 kB. After this number of other places, a search rarely comes back to one.
  static constexpr std::size_t kMostPlaces = 4096;

  std::unordered_map<std::string, Results> places_;
};

}  // namespace temper
