// The middle of some values, the upper one of two.
#pragma once

#include <algorithm>
#include <vector>

namespace temper::gallery {

/// 0 of none.
[[nodiscard]] inline double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values.empty() ? 0 : values[values.size() / 2];
}

}  // namespace temper::gallery
