// Medians, and the ratio of the largest value to the median.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace temper {

/// The median, if these two numbers are in the middle; they are one number if there is an odd number of values.
inline double median_of_middle(double lower, double upper) {
  return upper < std::numeric_limits<double>::infinity() ? upper + (lower - upper) / 2 : upper;
}

/// The mean of the middle two for an even number; 0 without values. NaN counts as +∞: an order with NaN is none.
inline double median_of(std::vector<double> values) {
  if (values.empty()) return 0;
  for (double& value : values) value = std::isnan(value) ? std::numeric_limits<double>::infinity() : value;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return median_of_middle(values.size() % 2 == 1 ? *middle : *std::max_element(values.begin(), middle), *middle);
}

/// The largest of values ≥ 0 over their median. If the median is 0 or +∞ there is nothing to compare with, and the
/// result is +∞.
inline double over_median(double largest, double median) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return median > 0 && largest < infinity ? largest / median : infinity;
}

/// The largest of these values over their median. Without values the result is 1.
inline double largest_over_median(std::vector<double> values) {
  if (values.empty()) return 1;
  const double largest = *std::max_element(values.begin(), values.end());
  return over_median(largest, median_of(std::move(values)));
}

}  // namespace temper
