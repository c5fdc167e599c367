// The space that the points of a file are in.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "temper/io.hpp"
#include "temper/detail/projection.hpp"

namespace temper::io {

/// The unit vector to the east, on the axis that of longitude 0.
[[nodiscard]] Vec3 east_of(Vec3 direction);

/// Puts points, which are degrees, onto the sphere. Fails where a latitude or a longitude is none.
void put_on_sphere(MeshFile& file, double radius, const InputNames& names);
/// Makes the sphere one of another radius, with weights that leave the power diagram as it is.
void resize_sphere(MeshFile& file, double radius);
/// Makes a file of points in space one of points on the sphere.
void set_sphere(MeshFile& file, double radius, std::vector<Vec3> points);

/// Gives a file points with three coordinates, as set_points() does, with these names in errors.
void settle_points(MeshFile& file, std::vector<Vec3> points, const InputNames& names);

/// The radius that all points have, to one part in a million; nothing where they have none in common.
[[nodiscard]] std::optional<double> common_radius(const std::vector<Vec3>& points);

/// Where a point is, in three coordinates.
[[nodiscard]] inline Vec3 place_of(const MeshFile& file, std::size_t point) {
  const Vec2 p = file.points[point];
  return file.sphere() != nullptr ? file.sphere()->places[point] : Vec3{p.x, p.y, file.z()};
}

/// The places of the points of a sphere; of other files none.
[[nodiscard]] inline std::span<const Vec3> sphere_places(const MeshFile& file) {
  return file.sphere() != nullptr ? std::span<const Vec3>(file.sphere()->places) : std::span<const Vec3>();
}
/// Says whether points are in the plane z = 0.
[[nodiscard]] bool is_flat(const MeshFile& file);

/// Which of the first n points are corners of triangles.
[[nodiscard]] std::vector<bool> points_of_triangles(const MeshFile& file, std::size_t n);

}  // namespace temper::io
