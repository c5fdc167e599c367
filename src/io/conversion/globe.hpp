// The space that the points of a file are in.
#pragma once

#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "temper/detail/location.hpp"
#include "temper/detail/projection.hpp"
#include "temper/detail/vec.hpp"
#include "temper/io.hpp"

namespace temper::io {

/// Relative to the radius, or to the extent of a plane: the precision of coordinates with seven digits.
inline constexpr double kOff = 1e-6;

/// The unit vector to the east; on the axis, the east of longitude 0.
[[nodiscard]] Vec3 east_of(Vec3 direction);

/// Puts points in degrees onto the sphere. Fails if a latitude or a longitude is out of range.
void put_on_sphere(MeshFile& file, double radius, const InputNames& names);
/// Gives a mesh of tetrahedra, or a curved surface, its points.
void put_in_space(MeshFile& file, std::span<const Vec3> points, int dimension = 3);
/// Moves the points of a surface that is nearly a sphere to the sphere, with a warning. Fails if it is not.
void take_to_sphere(MeshFile& file, std::optional<double> radius, const InputNames& names);
/// Changes the radius of the sphere, with weights that keep the power diagram.
void resize_sphere(MeshFile& file, double radius);
/// Turns points in space into points on the sphere.
void set_sphere(MeshFile& file, double radius, std::vector<Vec3> points);

/// The error of a surface, where a mesh of the plane or the sphere is expected: it names a point.
[[nodiscard]] Expected<void> expect_no_surface(const MeshFile& file);

/// Gives a file points with three coordinates, as set_points() does, with these names in errors.
/// `may_be_surface`: otherwise points in no plane and on no sphere are an error.
void settle_points(MeshFile& file, std::vector<Vec3> points, const InputNames& names, bool may_be_surface = true);

/// The radius of all points, to one part in a million; nothing if they have none in common.
[[nodiscard]] std::optional<double> common_radius(const std::vector<Vec3>& points);

/// The position of a point in the space of its mesh, in three coordinates.
[[nodiscard]] inline Vec3 position_of(const MeshFile& file, std::size_t point) {
  const Vec2 p = file.points[point];
  if (file.sphere() != nullptr) return file.sphere()->places[point];
  return {p.x, p.y, file.in_space() != nullptr ? file.in_space()->heights[point] : file.z()};
}

/// The axis across the plane of the points: 0 x, 1 y, 2 z.
inline constexpr int kZAxis = 2;
[[nodiscard]] inline int normal_of(const MeshFile& file) {
  const auto* const plane = std::get_if<PlanePoints>(&file.points_in);
  return plane == nullptr ? kZAxis : plane->normal;
}
[[nodiscard]] std::string_view name_of_axis(int axis);
/// Coordinates in the order of a plane across this axis, (y, z) or (x, z), and then the one along the axis.
[[nodiscard]] inline Vec3 turned(Vec3 p, int normal) {
  return normal == 0 ? Vec3{p.y, p.z, p.x} : normal == 1 ? Vec3{p.x, p.z, p.y} : p;
}

/// The places of the points of a sphere; of other files none.
[[nodiscard]] inline std::span<const Vec3> sphere_places(const MeshFile& file) {
  return file.sphere() != nullptr ? std::span<const Vec3>(file.sphere()->places) : std::span<const Vec3>();
}
/// Says whether points are in the plane z = 0.
[[nodiscard]] bool is_flat(const MeshFile& file);

/// Guesses whether points are degrees, if nothing says it or that they are lengths. They are if they fit longitude and
/// latitude. Points around the origin, or from it to the upper right, are local coordinates of a plane, unless a depth
/// or height is more than their extent. Models of shallow water make no sense there.
[[nodiscard]] bool look_like_degrees(std::span<const Vec2> points, std::span<const double> heights);

/// Point data with the third coordinate, when z is data.
inline constexpr std::string_view kHeight = "z";

/// Point data with the place on the globe of each point of a plane mesh: temper mesh writes them.
inline constexpr std::string_view kLongitude = "longitude", kLatitude = "latitude";

/// Longitude and latitude of the points of a file [degrees]; nothing when it has neither a map nor such data.
[[nodiscard]] std::optional<std::vector<Vec2>> lon_lat_of_points(const MeshFile& file);
/// Longitude and latitude of any places of its mesh, if the file has them for its points: by the map, or linear on the
/// sphere between corners.
[[nodiscard]] std::vector<Vec2> lon_lat_of_places(const MeshFile& file, const Mesh& mesh, std::span<const Vec2> places);

/// The file with its points in degrees; those must be known.
[[nodiscard]] MeshFile in_degrees(const MeshFile& file);

struct PlaceHash {
  std::size_t operator()(Vec2 p) const {
    std::uint64_t x = 0, y = 0;
    p = {p.x + 0.0, p.y + 0.0};  // −0 is the same place as 0
    std::memcpy(&x, &p.x, sizeof x);
    std::memcpy(&y, &p.y, sizeof y);
    return static_cast<std::size_t>((x * 0x9E3779B97F4A7C15u) ^ (y + (x >> 29)) * 0xBF58476D1CE4E5B9u);
  }
  std::size_t operator()(const Vec3& p) const {
    return (*this)(Vec2{p.x, p.y}) ^ (*this)(Vec2{p.z, 0}) * 0x94D049BB133111EBu;
  }
};

}  // namespace temper::io
