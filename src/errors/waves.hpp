// The fields over which models of errors take their means, in the plane and in space: waves and fronts.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include "base/sine_cosine.hpp"
#include "errors/solve.hpp"
#include "temper/detail/vec.hpp"

namespace temper::error_detail {

// Wave numbers in radians per half of the bounding box. In triangles one number gives meshes with errors as small as
// two. At vertices it gives errors up to 1.6 times as large.
inline constexpr double kWaveNumbers[] = {1.5, 3.5}, kWaveNumberInCells[] = {2.5};
inline constexpr double kFrontNumber = 7;
inline constexpr std::size_t kFrontBlocks = 8;
// A block has a sine and a cosine in each direction. So the sum of their squares does not depend on the place.
inline constexpr std::size_t kDirections = kLanes / 2;

/// Fields u side by side, two in each direction, as functions of the angle a = k · p + phase.
///
///   waves    sin a and cos a
///   fronts   b/√(1 + b²) for b = a + shift and b = a − shift: steep where |b| < 1, which is near a plane
template <class Vec>
struct FieldBlock {
  std::array<Vec, kDirections> k = {};
  std::array<double, kDirections> phase = {};
  double k2 = 0;     // |k|²
  double share = 0;  // c of J
  bool has_fronts = false;
  double shift = 0;

  [[nodiscard]] Lanes at(Vec p) const {
    const auto front = [](double b) { return b / std::sqrt(1 + b * b); };
    Lanes values;
    for (std::size_t d = 0; d < kDirections; ++d) {
      const double angle = dot(k[d], p) + phase[d];
      if (has_fronts) {
        values[2 * d] = front(angle + shift), values[2 * d + 1] = front(angle - shift);
      } else {
        const auto [sine, cosine] = sine_cosine(angle);
        values[2 * d] = sine, values[2 * d + 1] = cosine;
      }
    }
    return values;
  }
  /// The derivatives by the angles, from the values. Those of fronts are c³, with c² = 1 − u².
  [[nodiscard]] Lanes slopes(const Lanes& values) const {
    if (has_fronts) return of_each(values, [](double, double c2) { return c2 * std::sqrt(c2); });
    Lanes slopes;
    for (std::size_t i = 0; i < kLanes; ++i) slopes[i] = values[i ^ 1U];
    for (std::size_t i = 1; i < kLanes; i += 2) slopes[i] = -slopes[i];
    return slopes;
  }
  /// f = −Δu, from the values: k² u, or 3 k² u c⁴.
  [[nodiscard]] Lanes source(const Lanes& values) const {
    return of_each(values, [this](double u, double c2) { return has_fronts ? 3 * k2 * u * c2 * c2 : k2 * u; });
  }
  /// The derivatives of f by u. Those by the angles are slopes() times as large.
  [[nodiscard]] Lanes source_by_value(const Lanes& values) const {
    return of_each(values, [this](double u, double c2) { return has_fronts ? 3 * k2 * c2 * (c2 - 4 * u * u) : k2; });
  }
  /// Σ by_angle k.
  [[nodiscard]] Vec by_place(const Lanes& by_angle) const {
    Vec sum;
    for (std::size_t d = 0; d < kDirections; ++d) sum = sum + (by_angle[2 * d] + by_angle[2 * d + 1]) * k[d];
    return sum;
  }

 private:
  template <class Function>  // of u and 1 − u²
  [[nodiscard]] static Lanes of_each(const Lanes& values, const Function& function) {
    Lanes results;
    for (std::size_t i = 0; i < kLanes; ++i) results[i] = function(values[i], 1 - values[i] * values[i]);
    return results;
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

/// A block with wave number `in_frame`. The directions of block b of n are between those of the others.
template <class Vec, class Frame>
[[nodiscard]] FieldBlock<Vec> block_of(const Frame& frame, double in_frame, std::size_t b, std::size_t n) {
  const double number = in_frame / frame.half_size;
  FieldBlock<Vec> block;
  block.k2 = number * number;
  for (std::size_t d = 0; d < kDirections; ++d) {
    Vec unit;
    set_direction(unit, n * d + b, n * kDirections);
    block.k[d] = number * unit;
    block.phase[d] = -dot(block.k[d], frame.center);
  }
  return block;
}

/// Some blocks of waves for each of these wave numbers, in the units of a mesh with this frame and this area or volume.
/// Their errors are relative to the mean square ½, over k⁴ in the frame, in the mean.
template <class Vec, class Frame>
[[nodiscard]] std::vector<FieldBlock<Vec>> waves_of(const Frame& frame, double size, std::span<const double> numbers,
                                                    std::size_t blocks_of_number = 1) {
  const std::size_t n = blocks_of_number * numbers.size();
  std::vector<FieldBlock<Vec>> blocks;
  for (std::size_t b = 0; b < n; ++b) {
    const double in_frame = numbers[b / blocks_of_number];
    blocks.push_back(block_of<Vec>(frame, in_frame, b, n));
    blocks[b].share = 2 / (size * in_frame * in_frame * in_frame * in_frame * static_cast<double>(n) * kLanes);
  }
  return blocks;
}

/// Blocks of fronts, each a quarter of the half frame away from its middle. Their errors are in the mean.
template <class Vec, class Frame>
[[nodiscard]] std::vector<FieldBlock<Vec>> fronts_of(const Frame& frame, double size) {
  std::vector<FieldBlock<Vec>> blocks;
  for (std::size_t b = 0; b < kFrontBlocks; ++b) {
    blocks.push_back(block_of<Vec>(frame, kFrontNumber, b, kFrontBlocks));
    blocks[b].share = 1 / (size * static_cast<double>(kFrontBlocks * kLanes));
    blocks[b].has_fronts = true;
    blocks[b].shift = 0.25 * kFrontNumber;
  }
  return blocks;
}

}  // namespace temper::error_detail
