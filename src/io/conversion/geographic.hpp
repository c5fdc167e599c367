// Files whose points are longitude and latitude: how they are known, and how they come back from the map.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "temper/io.hpp"
#include "temper/detail/places.hpp"

namespace temper::io {

/// Says whether points are degrees in a format that does not tell, of water with depths: they are in the range of
/// longitude and latitude, and lengths would be less than depths. Models of shallow water make no sense there.
[[nodiscard]] bool look_like_degrees(std::span<const Vec2> points, std::span<const double> depths);

/// Point data by which a mesh in the plane knows where on the globe it is: temper mesh writes them.
inline constexpr std::string_view kLongitude = "longitude", kLatitude = "latitude";

/// Longitude and latitude of the points of a file [degrees]; nothing when it has neither a map nor data that say it.
[[nodiscard]] std::optional<std::vector<Vec2>> lon_lat_of_points(const MeshFile& file);
/// The same of any places of its mesh, where those of the points are known: by the map, or linear on the sphere between
/// corners.
[[nodiscard]] std::vector<Vec2> lon_lat_of_places(const MeshFile& file, const Mesh& mesh, std::span<const Vec2> places);

/// The file with its points in degrees; those must be known.
[[nodiscard]] MeshFile in_degrees(const MeshFile& file);

}  // namespace temper::io
