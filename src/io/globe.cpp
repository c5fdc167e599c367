#include "io/globe.hpp"

#include <algorithm>
#include <cmath>

#include "io/failure.hpp"

namespace temper::io {
namespace {

// Of the radius: what is left of coordinates with seven digits.
constexpr double kOff = 1e-6;

bool is_off(double distance, double radius) { return !(std::abs(distance - radius) <= kOff * radius); }

/// 0 where there are no points.
double median_distance(const std::vector<Vec3>& points) {
  if (points.empty()) return 0;
  std::vector<double> all;
  all.reserve(points.size());
  for (const Vec3 p : points) all.push_back(length(p));
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end());
  return *middle;
}

/// The first point that is not on a sphere which more than half of them share; nothing where they share none.
std::optional<std::size_t> off_shared_sphere(const std::vector<Vec3>& points, double radius) {
  std::optional<std::size_t> first;
  std::size_t n_off = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!is_off(length(points[i]), radius)) continue;
    if (n_off++ == 0) first = i;
  }
  return 2 * n_off < points.size() ? first : std::nullopt;
}

}  // namespace

Vec3 east_of(Vec3 p) {
  const double across = std::hypot(p.x, p.y);
  return across == 0 ? Vec3{0, 1, 0} : Vec3{-p.y / across, p.x / across, 0};
}

void put_on_sphere(MeshFile& file, double radius, const InputNames& names) {
  std::vector<Vec3> places;
  places.reserve(file.points.size());
  for (std::size_t i = 0; i < file.points.size(); ++i) {
    const Vec2 p = file.points[i];
    if (!(std::abs(p.y) <= 90)) {
      fail(ErrorCode::geographic, names.point_where(i),
           text(names.point(i), " has longitude ", p.x, " and latitude ", p.y,
                "; expected degrees, a latitude between -90 and 90"));
    }
    if (!(std::abs(p.x) <= 720)) {
      fail(ErrorCode::geographic, names.point_where(i),
           text(names.point(i), " has longitude ", p.x, " and latitude ", p.y,
                "; expected degrees, a longitude between -720 and 720"));
    }
    places.push_back(radius * direction_of(p));
  }
  file.sphere_points = std::move(places);
  file.sphere_radius = radius;
  file.geographic = false;
}

void resize_sphere(MeshFile& file, double radius) {
  const double scale = radius / file.sphere_radius;
  for (Vec3& p : file.sphere_points) p = scale * p;
  for (double& w : file.weights) w *= scale * scale;
  file.sphere_radius = radius;
}

void set_sphere(MeshFile& file, double radius, std::vector<Vec3> points) {
  file.sphere_radius = radius;
  file.z = 0;
  file.points.clear();
  file.points.reserve(points.size());
  for (const Vec3 p : points) file.points.push_back(lon_lat_of(p));
  file.sphere_points = std::move(points);
}

void settle_points(MeshFile& file, std::vector<Vec3> points, const InputNames& names) {
  const double z = points.empty() ? 0 : points.front().z;
  std::optional<std::size_t> off_plane;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 p = points[i];
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) {
      fail(ErrorCode::not_finite, names.point_where(i),
           text(names.point(i), " has coordinates (", p.x, ", ", p.y, "), expected finite numbers"));
    }
    if (!std::isfinite(p.z)) {
      fail(ErrorCode::not_finite, names.point_where(i),
           text(names.point(i), " has z = ", p.z, ", expected a finite number"));
    }
    if (p.z != z && !off_plane) off_plane = i;
  }
  if (!off_plane) {
    file.z = z;
    file.points.clear();
    for (const Vec3 p : points) file.points.push_back({p.x, p.y});
    return;
  }
  if (const auto radius = common_radius(points)) return set_sphere(file, *radius, std::move(points));
  const double radius = median_distance(points);
  if (const auto off = off_shared_sphere(points, radius)) {
    fail(ErrorCode::not_planar, names.point_where(*off),
         text(names.point(*off), " is ", length(points[*off]), " from the origin, but most points are ", radius,
              "; expected all on one sphere around the origin, or in a plane of constant z"));
  }
  fail(ErrorCode::not_planar, names.point_where(*off_plane),
       text(names.point(*off_plane), " has z = ", points[*off_plane].z, ", but ", names.point(0), " has z = ", z,
            "; expected a mesh in a plane of constant z, or on a sphere around the origin"));
}

Expected<void> set_points(MeshFile& file, std::vector<Vec3> points) {
  try {
    const InputNames from_0;
    settle_points(file, std::move(points), file.numbering ? *file.numbering : from_0);
    return {};
  } catch (Failure& failure) {
    return std::move(failure.error);
  }
}

std::optional<double> common_radius(const std::vector<Vec3>& points) {
  const double radius = median_distance(points);
  const auto off = [radius](Vec3 p) { return is_off(length(p), radius); };
  if (!(radius > 0) || std::any_of(points.begin(), points.end(), off)) return std::nullopt;
  // A radius that somebody wrote down has few digits.
  const double places = 11 - std::floor(std::log10(radius)), power = std::pow(10, std::abs(places));
  const double rounded = places > 0 ? std::round(radius * power) / power : std::round(radius / power) * power;
  return std::abs(rounded - radius) < 1e-14 * radius ? rounded : radius;
}

}  // namespace temper::io
