// Medians, and the ratio of the largest value to the median.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace temper {

/// The mean of the middle two for an even number; 0 without values. Precondition: no NaN.
inline double median_of(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1 || !(*middle < std::numeric_limits<double>::infinity())) return *middle;
  return *middle + (*std::max_element(values.begin(), middle) - *middle) / 2;
}

/// The largest of the values over their median; all are ≥ 0. Without values the result is 1. If the median is 0 or +∞
/// there is nothing to compare with, and the result is +∞.
inline double largest_over_median(std::vector<double> values) {
  if (values.empty()) return 1;
  const double largest = *std::max_element(values.begin(), values.end());
  const double median = median_of(std::move(values));
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return median > 0 && largest < infinity ? largest / median : infinity;
}

}  // namespace temper
