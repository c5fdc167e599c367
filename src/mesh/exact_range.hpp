// The numbers with which the exact predicates neither overflow nor underflow.
#pragma once

#include <cmath>
#include <string>

#include "base/text.hpp"
#include "temper/detail/vec.hpp"

namespace temper {

[[nodiscard]] inline bool is_finite(Vec3 p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

/// The magnitudes that a number other than 0 may have.
struct ExactRange {
  double low, high;
  [[nodiscard]] bool allows(double x) const { return x == 0 || (std::abs(x) >= low && std::abs(x) <= high); }
  /// Returns 0 for a magnitude below the range.
  [[nodiscard]] double without_tiny(double x) const { return std::abs(x) < low ? 0 : x; }
  [[nodiscard]] constexpr ExactRange squared() const { return {low * low, high * high}; }
  [[nodiscard]] std::string text() const {
    return "expected 0 or a magnitude from " + to_text(low) + " to " + to_text(high) + ", which exact arithmetic needs";
  }
};

/// Range of the coordinates of surfaces.
inline constexpr ExactRange kCoordinatesInSpace = {1e-60, 1e60};

}  // namespace temper
