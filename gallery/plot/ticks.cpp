#include "plot/ticks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "draw/text.hpp"

namespace temper {
namespace {

constexpr int kLargestPower = 5, kSmallestPower = -4;  // exponents from which on an axis takes out a power of ten
constexpr double kRounding = 1e-9;                     // of a step: a tick at the very end of the range is in it

// 10^k, to the nearest double.
double power_of_ten(int k) { return k >= 0 ? std::pow(10.0, k) : 1 / std::pow(10.0, -k); }

std::string power_label(int k) {
  if (k >= -3 && k <= 4) return fixed_label(power_of_ten(k), std::max(0, -k));
  return "10^{" + fixed_label(k, 0) + "}";
}

}  // namespace

double nice_step(double length, double most) {
  const double least = length / most;
  int k = static_cast<int>(std::floor(std::log10(least)));
  for (;; ++k) {
    for (const double m : {1.0, 2.0, 5.0}) {
      const double step = k >= 0 ? m * power_of_ten(k) : m / power_of_ten(-k);
      if (step >= least * (1 - kRounding)) return step;
    }
  }
}

Ticks linear_ticks(const PlotRange& range, double most) {
  const double step = nice_step(range.high - range.low, most);
  const double size = std::max(std::abs(range.low), std::abs(range.high));
  Ticks result;
  const int magnitude = static_cast<int>(std::floor(std::log10(size) + kRounding));
  if (magnitude >= kLargestPower || magnitude < kSmallestPower) result.exponent = magnitude;
  const int step_exponent = static_cast<int>(std::floor(std::log10(step) + kRounding));
  const int decimals = std::clamp(result.exponent - step_exponent, 0, 15);
  const double first = std::ceil(range.low / step - kRounding), last = std::floor(range.high / step + kRounding);
  const auto n = static_cast<std::int64_t>(last - first);  // at most `most`
  for (std::int64_t i = 0; i <= n; ++i) {
    const double count = first + static_cast<double>(i);
    // Dividing by a whole number keeps 0.3 from being 3 × 0.1 = 0.30000000000000004.
    const double value = step < 1 ? count / std::round(1 / step) : count * step;
    result.ticks.push_back({value, fixed_label(value / power_of_ten(result.exponent), decimals)});
  }
  return result;
}

Ticks log_ticks(const PlotRange& range, double most) {
  const double low = std::log10(range.low), high = std::log10(range.high);
  const int first = static_cast<int>(std::floor(low - kRounding)), last = static_cast<int>(std::ceil(high + kRounding));
  const double decades = high - low;
  const int stride = std::max(1, static_cast<int>(nice_step(std::max(decades, 1.0), most)));
  const bool label_two_and_five = 3 * decades <= most;
  Ticks result;
  for (int k = first; k <= last; ++k) {
    for (int m = 1; m < 10; ++m) {
      const double value = m * power_of_ten(k);
      const double at = std::log10(value);
      if (at < low - kRounding || at > high + kRounding) continue;
      if (m == 1 && k % stride == 0) {
        result.ticks.push_back({value, power_label(k)});
      } else if (label_two_and_five && (m == 2 || m == 5)) {
        result.ticks.push_back({value, number_label(value)});
      } else if (stride == 1) {
        result.ticks.push_back({value, ""});
      }
    }
  }
  return result;
}

}  // namespace temper
