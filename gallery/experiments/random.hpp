// Random numbers that are the same with every standard library, which std::uniform_real_distribution's are not.
#pragma once

#include <cstdint>
#include <random>

namespace temper::gallery {

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
