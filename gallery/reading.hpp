// How a reader takes what the paper leaves open. Each figure has its own way, which its claims state; a reading puts
// one way in the place of all of these, so that it can be seen which claims depend on it.
#pragma once

#include <optional>

#include "temper/optimize.hpp"

namespace temper::gallery {

/// Absent: as each figure has it.
struct Reading {
  std::optional<SearchRadius> search_radius;  ///< §5.2: "the maximum search distance is the patch radius"
  std::optional<double> weight_reach;         ///< of a weight, relative to its square
  bool refuses_inversions = false;            ///< no step turns a triangle over, in any figure
};

/// Before the first figure is made: some keep their runs.
void set_reading(const Reading& reading);
[[nodiscard]] const Reading& reading();

/// The options as the reading has them.
[[nodiscard]] OptimizeOptions as_read(OptimizeOptions options);

}  // namespace temper::gallery
