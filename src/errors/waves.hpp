// The waves over which models of errors take their means, in the plane and in space.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <vector>

#include "base/sine_cosine.hpp"
#include "errors/solve.hpp"
#include "temper/detail/vec.hpp"

namespace temper::error_detail {

// Wave numbers in radians per half of the bounding box.
inline constexpr double kWaveNumbers[] = {1.5, 3.5};
// A block has a sine and a cosine in each direction. So the sum of their squares does not depend on the place.
inline constexpr std::size_t kDirections = kLanes / 2;

/// Waves side by side: in each direction the sine of its angle k · p + phase, then the cosine.
template <class Vec>
struct WaveBlock {
  std::array<Vec, kDirections> k = {};
  std::array<double, kDirections> phase = {};
  double k2 = 0;     // |k|²
  double share = 0;  // c of J, relative to the mean square ½, over k⁴ in the frame, in the mean

  [[nodiscard]] Lanes at(Vec p) const {
    Lanes values;
    for (std::size_t d = 0; d < kDirections; ++d) {
      const auto [sine, cosine] = sine_cosine(dot(k[d], p) + phase[d]);
      values[2 * d] = sine, values[2 * d + 1] = cosine;
    }
    return values;
  }
  /// The derivatives by the angles, from the values.
  static Lanes slopes(const Lanes& values) {
    Lanes slopes;
    for (std::size_t d = 0; d < kDirections; ++d) {
      slopes[2 * d] = values[2 * d + 1], slopes[2 * d + 1] = -values[2 * d];
    }
    return slopes;
  }
  /// Σ by_angle k.
  [[nodiscard]] Vec by_place(const Lanes& by_angle) const {
    Vec sum;
    for (std::size_t d = 0; d < kDirections; ++d) sum = sum + (by_angle[2 * d] + by_angle[2 * d + 1]) * k[d];
    return sum;
  }
};

/// Direction i of n over a half circle. The sum of k k k k over four of them does not depend on directions.
inline void set_direction(Vec2& unit, std::size_t i, std::size_t n) {
  const double turn = static_cast<double>(2 * i + 1) / static_cast<double>(2 * n);
  const auto [sine, cosine] = sine_cosine(std::numbers::pi * turn);
  unit = {cosine, sine};
}
/// Direction i of n on a spiral from one pole to the equator.
inline void set_direction(Vec3& unit, std::size_t i, std::size_t n) {
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  const double z = (static_cast<double>(i) + 0.5) / static_cast<double>(n), r = std::sqrt(1 - z * z);
  const auto [sine, cosine] = sine_cosine(golden * static_cast<double>(i));
  unit = {r * cosine, r * sine, z};
}

/// Some blocks for each wave number, in the units of a mesh with this frame and this area or volume. The directions of
/// one block are between those of the others.
template <class Vec, class Frame>
[[nodiscard]] std::vector<WaveBlock<Vec>> waves_of(const Frame& frame, double size, std::size_t blocks_of_number) {
  const std::size_t n = blocks_of_number * std::size(kWaveNumbers);
  std::vector<WaveBlock<Vec>> blocks(n);
  for (std::size_t b = 0; b < n; ++b) {
    const double in_frame = kWaveNumbers[b / blocks_of_number], number = in_frame / frame.half_size;
    blocks[b].k2 = number * number;
    blocks[b].share = 2 / (size * in_frame * in_frame * in_frame * in_frame * static_cast<double>(n) * kLanes);
    for (std::size_t d = 0; d < kDirections; ++d) {
      Vec unit;
      set_direction(unit, n * d + b, n * kDirections);
      blocks[b].k[d] = number * unit;
      blocks[b].phase[d] = -dot(blocks[b].k[d], frame.center);
    }
  }
  return blocks;
}

}  // namespace temper::error_detail
