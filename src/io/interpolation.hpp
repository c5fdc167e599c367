// Data of the points of a triangulation, at any other place: for points that an optimisation has inserted.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "temper/io.hpp"

namespace temper::io {

/// A place as a mean of points.
struct PointMean {
  std::array<std::int32_t, 3> points = {};
  std::array<double, 3> weights = {};  ///< sum 1, none negative; 0 of a point across the edge that the place is on
};

/// The places in a triangulation, all triangles in either orientation; of a place that rounding has put outside, the
/// nearest. Expected O(triangles + places).
[[nodiscard]] std::vector<PointMean> locate(std::span<const Vec2> points,
                                            std::span<const std::array<std::int32_t, 3>> triangles,
                                            std::span<const Vec2> places);

/// Appends a tuple for each place: of floating numbers the linear interpolation, of integers what all points of the
/// mean have in common. False, and nothing is appended, when somewhere they have nothing in common.
[[nodiscard]] bool append_means(DataArray& array, const std::vector<PointMean>& places);

}  // namespace temper::io
