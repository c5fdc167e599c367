// The box around points of the plane.
#pragma once

#include <algorithm>
#include <limits>

#include "temper/detail/vec.hpp"

namespace temper {

/// Around the points that have been added; low is beyond high before the first.
struct PlaneBox {
  Vec2 low = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()}, high = -1.0 * low;

  void add(Vec2 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  [[nodiscard]] double longer_side() const { return std::max(high.x - low.x, high.y - low.y); }
};

}  // namespace temper
