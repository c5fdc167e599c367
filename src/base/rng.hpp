// Random numbers with the same bits on every platform (the distributions of <random> differ between libraries).
//
// splitmix64: a counter in steps of the golden ratio, mixed by two rounds of xor, shift and multiply. Any seed is good,
// and a stream can start anywhere. Seeded generators and per-vertex jitter need that.
#pragma once

#include <cstdint>

namespace temper {

/// The mixing function alone: a hash of 64 bits, bijective.
constexpr std::uint64_t mix64(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

class Rng {
 public:
  explicit constexpr Rng(std::uint64_t seed) : state_(seed) {}

  /// 64 random bits.
  constexpr std::uint64_t next() { return mix64(state_ += 0x9e3779b97f4a7c15u); }
  /// Uniform in [0, 1), a multiple of 2⁻⁵³.
  constexpr double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  /// Uniform in [low, high), up to rounding.
  constexpr double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Uniform in 0 … n − 1, n > 0; the bias of n / 2³² is far below the effect of a seed.
  constexpr std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(((next() >> 32) * n) >> 32); }
  /// One of these values; there must be one.
  template <class Values>
  constexpr const auto& any_of(const Values& values) {
    return values[below(static_cast<std::uint32_t>(values.size()))];
  }

 private:
  std::uint64_t state_;
};

}  // namespace temper
