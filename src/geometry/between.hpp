// Points on one line.
#pragma once

#include <algorithm>

#include "temper/vec2.hpp"

namespace temper {

/// Says whether p is on the closed segment ab, given that the three are collinear.
[[nodiscard]] inline bool is_between(Vec2 a, Vec2 b, Vec2 p) {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

}  // namespace temper
