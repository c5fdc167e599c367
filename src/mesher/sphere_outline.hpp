// The outlines of a sphere as one outline.
//
// In degrees a place has many names: 180 and -180, 190 and -170, every longitude at a pole. Polygons that were cut at
// the end of a map meet themselves there. Joins within a tolerance make each place one point. Such cuts then become
// edges with nothing outside on either side.
#pragma once

#include <vector>

#include "temper/detail/error.hpp"
#include "temper/detail/vec.hpp"
#include "temper/mesher.hpp"

namespace temper::mesher {

struct SphereOutlines {
  Outline outline;           ///< all points in degrees: basins, coasts, lines
  std::vector<Vec3> places;  ///< of its points
};

/// Errors use the outlines' names. They are: values that are no longitude and latitude; ends of segments out of range,
/// or on opposite sides of the sphere. Both conventions of longitude are an error if a segment does not determine its
/// way around.
[[nodiscard]] Expected<SphereOutlines> united(const SphereOutline& given);

}  // namespace temper::mesher
