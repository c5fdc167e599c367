// Numbers for claims: medians, and random ones that are the same with every standard library, which
// std::uniform_real_distribution's are not.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace temper::gallery {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The upper middle; 0 of none.
[[nodiscard]] inline double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values.empty() ? 0 : values[values.size() / 2];
}

/// Uniform in [low, high).
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double operator()(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace temper::gallery
