// The outlines of a sphere as one outline, on which each place is one point.
//
// In degrees a place has many names: 180 and -180, 190 and -170, every longitude at a pole. Polygons that were cut at
// the end of a map meet themselves there. Such cuts become edges with nothing outside on either side.
#pragma once

#include <cstdint>
#include <vector>

#include "temper/detail/error.hpp"
#include "temper/detail/vec.hpp"
#include "temper/mesher.hpp"

namespace temper::mesher {

struct JoinedOutline {
  Outline outline;                    ///< its points in degrees, as the first of each place was given
  std::vector<Vec3> places;           ///< of its points
  std::vector<std::int32_t> numbers;  ///< for each given point (basins, coasts, lines), the number of its place
};

/// Errors use the outlines' names. They are: values that are no longitude and latitude; ends of segments out of range,
/// or on opposite sides of the sphere; coasts and basins that are not closed. Both conventions of longitude are an
/// error if a segment does not determine its way around.
[[nodiscard]] Expected<JoinedOutline> join(const SphereOutline& given);

}  // namespace temper::mesher
