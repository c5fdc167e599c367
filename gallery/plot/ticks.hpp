// The ticks of an axis: multiples of 1, 2 or 5 times a power of ten, or the powers themselves on a
// logarithmic axis.
#pragma once

#include <string>
#include <vector>

#include "plot/plot.hpp"

namespace temper {

struct Tick {
  double value = 0;
  std::string label = {};  ///< empty: a minor tick
};

struct Ticks {
  std::vector<Tick> ticks;
  int exponent = 0;  ///< labels are values / 10^exponent, and the axis says so
};

/// The least of 1, 2, 5 × 10^k that cuts the length into at most `most` parts. Precondition: length > 0, most > 0.
[[nodiscard]] double nice_step(double length, double most);
/// The multiples of a nice step in the range, at most `most` + 1. Precondition: range.low < range.high, finite.
[[nodiscard]] Ticks linear_ticks(const PlotRange& range, double most);
/// Powers of ten, at most about `most`; when there are few, 2 and 5 times them too. Precondition: 0 < low < high.
[[nodiscard]] Ticks log_ticks(const PlotRange& range, double most);

}  // namespace temper
