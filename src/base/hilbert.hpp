// Place along the Hilbert curve: points that are near on the curve are near in the plane.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include "base/box.hpp"
#include "temper/detail/vec.hpp"

namespace temper {

inline constexpr int kHilbertBits = 24;  // of each coordinate: finer than any mesh that fits in memory

/// The curve through 16 × 16 cells in each of its four orientations: in the second half of these both coordinates are
/// mirrored, and in every second one they are swapped.
struct HilbertStep {
  std::uint8_t index;        ///< of the cell
  std::uint8_t orientation;  ///< inside of the cell
};
inline constexpr auto kHilbertSteps = [] {
  std::array<HilbertStep, 1024> steps{};
  for (std::uint32_t i = 0; i < steps.size(); ++i) {
    std::uint32_t index = 0, mirrored = i >> 9, swapped = i >> 8 & 1;
    for (int bit = 3; bit >= 0; --bit) {
      std::uint32_t rx = (i >> (4 + bit) & 1) ^ mirrored, ry = (i >> bit & 1) ^ mirrored;
      if (swapped != 0) std::swap(rx, ry);
      index = 4 * index + ((3 * rx) ^ ry);
      mirrored ^= rx & ~ry & 1;
      swapped ^= ry ^ 1;
    }
    steps[i] = {static_cast<std::uint8_t>(index), static_cast<std::uint8_t>(2 * mirrored + swapped)};
  }
  return steps;
}();

/// Position of cell (x, y) along the Hilbert curve of 2^bits × 2^bits cells.
constexpr std::uint64_t hilbert_index(std::uint32_t x, std::uint32_t y) {
  std::uint64_t index = 0;
  std::uint32_t orientation = 0;
  for (int shift = kHilbertBits - 4; shift >= 0; shift -= 4) {
    const HilbertStep step = kHilbertSteps[orientation << 8 | (x >> shift & 15) << 4 | (y >> shift & 15)];
    index = index << 8 | step.index;
    orientation = step.orientation;
  }
  return index;
}

/// Six curves, one on each face of a cube around the sphere; a face has an edge with the one before.
inline constexpr int kCubeBits = 2 * kHilbertBits + 3;

/// Place of a direction along the curves, below 2^kCubeBits.
inline std::uint64_t cube_hilbert_index(Vec3 p) {
  const double x = std::abs(p.x), y = std::abs(p.y), z = std::abs(p.z);
  const int axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  const double of_axis[] = {p.x, p.y, p.z};
  const double up = of_axis[axis], u = of_axis[(axis + 1) % 3], v = of_axis[(axis + 2) % 3];
  const auto cell = [&](double t) {
    constexpr double kCells = static_cast<double>(1u << kHilbertBits) - 1;
    return static_cast<std::uint32_t>(0.5 * (t / std::abs(up) + 1) * kCells);
  };
  const auto face = static_cast<unsigned>(axis) + (up < 0 ? 3u : 0u);
  return (std::uint64_t{face} << (2 * kHilbertBits)) + hilbert_index(cell(u), cell(v));
}

class HilbertGrid {
 public:
  explicit HilbertGrid(std::span<const Vec2> points) {
    PlaneBox box;
    for (const Vec2 p : points) box.add(p);
    *this = HilbertGrid(box);
  }
  explicit HilbertGrid(const PlaneBox& box) : low_(box.low) {
    const double extent = box.longer_side();
    cells_per_length_ = extent > 0 ? (static_cast<double>(1u << kHilbertBits) - 1) / extent : 0;
  }

  /// Below 2^(2 kHilbertBits).
  [[nodiscard]] std::uint64_t operator()(Vec2 p) const {
    return hilbert_index(static_cast<std::uint32_t>((p.x - low_.x) * cells_per_length_),
                         static_cast<std::uint32_t>((p.y - low_.y) * cells_per_length_));
  }

 private:
  Vec2 low_;
  double cells_per_length_ = 0;
};

}  // namespace temper
