// The outlines of a sphere as one outline, on which each place is one point.
//
// In degrees a place has many names: 180 and -180, 190 and -170, every longitude at a pole. Polygons that were cut at
// the end of a map meet themselves there, and what is left of the cut are edges with nothing outside on either side.
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
  std::vector<std::int32_t> numbers;  ///< of each point given (basins, coasts, lines): that of its place
};

/// Errors, by the outlines' names: what is no longitude and latitude, ends of segments out of range or on opposite
/// sides of the sphere, coasts and basins that are not closed, both conventions of longitude where a segment does not
/// say which way it goes.
[[nodiscard]] Expected<JoinedOutline> join(const SphereOutline& given);

}  // namespace temper::mesher
