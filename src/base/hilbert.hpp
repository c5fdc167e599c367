// Place along the Hilbert curve: points that are near on the curve are near in the plane.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include "base/box.hpp"
#include "temper/detail/vec.hpp"

namespace temper {

inline constexpr int kHilbertBits = 24;  // of each coordinate: finer than any mesh that fits in memory

/// Position of cell (x, y) along the Hilbert curve of 2^bits × 2^bits cells.
constexpr std::uint64_t hilbert_index(std::uint32_t x, std::uint32_t y) {
  std::uint64_t index = 0;
  for (std::uint32_t s = 1u << (kHilbertBits - 1); s > 0; s /= 2) {
    const std::uint32_t rx = (x & s) != 0 ? 1 : 0;
    const std::uint32_t ry = (y & s) != 0 ? 1 : 0;
    index = 4 * index + ((3 * rx) ^ ry);
    if (ry == 0) {
      if (rx == 1) {
        x = ~x;
        y = ~y;
      }
      std::swap(x, y);
    }
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
    Box box;
    for (const Vec2 p : points) box.add(p);
    *this = HilbertGrid(box);
  }
  explicit HilbertGrid(const Box& box) : low_(box.low) {
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
