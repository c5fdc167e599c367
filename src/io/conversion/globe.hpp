// The space that the points of a file are in.
#pragma once

#include "temper/io.hpp"
#include "temper/projection.hpp"

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
  return file.sphere_radius > 0 ? file.sphere_points[point] : Vec3{file.points[point].x, file.points[point].y, file.z};
}

[[nodiscard]] inline bool is_periodic(const MeshFile& file) { return !(file.period == Vec2{}); }
/// The space that the points of a file are in.
[[nodiscard]] Space space_of(const MeshFile& file);
/// Says whether points are in the plane z = 0.
[[nodiscard]] bool is_flat(const MeshFile& file);

/// Which of the first n points are corners of triangles.
[[nodiscard]] std::vector<bool> points_of_triangles(const MeshFile& file, std::size_t n);

}  // namespace temper::io
