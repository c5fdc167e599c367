// The numbers with which the exact predicates neither overflow nor underflow.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "base/text.hpp"

namespace temper {

/// The magnitudes that a number other than 0 may have.
struct ExactRange {
  double low, high;
  [[nodiscard]] bool allows(double x) const { return x == 0 || (std::abs(x) >= low && std::abs(x) <= high); }
  [[nodiscard]] ExactRange squared() const { return {low * low, high * high}; }
  [[nodiscard]] std::string text() const {
    return "expected 0 or a magnitude from " + to_text(low) + " to " + to_text(high) + ", which exact arithmetic needs";
  }
};

// Within these bounds nothing over- or underflows in the exact predicates of triangles (geometry.hpp), in the user's
// units and after scaling to an extent of about 1, whatever the other coordinates are. They are far beyond any unit of
// length.
inline constexpr double kLargestCoordinate = 1e60;
inline constexpr double kSmallestCoordinate = 1e-60;  // absolute, and relative to the largest coordinate

/// The range of coordinates of triangles. `largest`: the magnitude of their largest coordinate. NaN is in no range.
inline ExactRange exact_range(double largest) {
  return {kSmallestCoordinate * std::clamp(largest, 1.0, kLargestCoordinate), kLargestCoordinate};
}

namespace tets {

// The same for tetrahedra, whose polynomials have higher degrees.
inline constexpr double kLargestCoordinate = 1e35;
inline constexpr double kSmallestCoordinate = 1e-35;  // absolute, and relative to the largest coordinate

inline ExactRange exact_range(double largest) {
  return {kSmallestCoordinate * std::clamp(largest, 1.0, kLargestCoordinate), kLargestCoordinate};
}

}  // namespace tets
}  // namespace temper
