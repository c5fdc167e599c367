#pragma once

#include <limits>

namespace temper::gallery {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace temper::gallery
