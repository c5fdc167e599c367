// Medians, and how far the largest is from them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace temper {

/// The mean of the middle two for an even number; 0 of none. Not for NaN.
inline double median_of(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1 || !(*middle < std::numeric_limits<double>::infinity())) return *middle;
  return *middle + (*std::max_element(values.begin(), middle) - *middle) / 2;
}

/// The largest of the values over their median; all are ≥ 0. Where there are none nothing differs: 1. A median of 0 or
/// +∞ leaves nothing to compare with: +∞.
inline double largest_over_median(std::vector<double> values) {
  if (values.empty()) return 1;
  const double largest = *std::max_element(values.begin(), values.end());
  const double median = median_of(std::move(values));
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return median > 0 && largest < infinity ? largest / median : infinity;
}

}  // namespace temper
