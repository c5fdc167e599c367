#include "io/conversion/globe.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "io/conversion/kept_points.hpp"
#include "io/text/failure.hpp"
#include "io/text/values.hpp"

namespace temper::io {
namespace {

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

// --- a plane or a sphere -----------------------------------------------------------------------------------------

void expect_finite(const std::vector<Vec3>& points, const InputNames& names) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 p = points[i];
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) {
      fail(ErrorCode::not_finite, names.point_where(i), names.point(i), " has coordinates (", p.x, ", ", p.y,
           "), expected finite numbers");
    }
    if (!std::isfinite(p.z)) {
      fail(ErrorCode::not_finite, names.point_where(i), names.point(i), " has z = ", p.z,
           ", expected a finite number. Next: give its place");
    }
  }
}

std::vector<Vec3> kept(const std::vector<Vec3>& points, const std::vector<bool>& used) {
  std::vector<Vec3> result;
  result.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (used[i]) result.push_back(points[i]);
  }
  return result;
}

/// The longest side of the box around the points.
double extent(const std::vector<Vec3>& points) {
  if (points.empty()) return 0;
  Vec3 low = points[0], high = low;
  for (const Vec3 p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return std::max({high.x - low.x, high.y - low.y, high.z - low.z});
}

struct PlaneFit {
  std::size_t first = 0, worst = 0;  // of triangles: one gives the plane its z, one is farthest off it
  double off = 0;                    // how far
  std::vector<std::size_t> unused;   // points of no triangle that are not in the plane
};

PlaneFit fit_plane(const std::vector<Vec3>& points, const std::vector<bool>& used) {
  PlaneFit plane;
  plane.first = static_cast<std::size_t>(std::find(used.begin(), used.end(), true) - used.begin());
  if (plane.first == used.size()) plane.first = 0;
  plane.worst = plane.first;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double off = std::abs(points[i].z - points[plane.first].z);
    if (!used[i] && off > 0) plane.unused.push_back(i);
    if (!used[i] || off <= plane.off) continue;
    plane.off = off;
    plane.worst = i;
  }
  return plane;
}

std::string where_is(std::size_t point, const InputNames& names) {
  const std::string where = names.point_where(point);
  return where.empty() ? where : text(where, ": ");
}

void warn_of_plane(MeshFile& file, const std::vector<Vec3>& points, const PlaneFit& plane, const InputNames& names) {
  const std::string_view axis = name_of_axis(normal_of(file));
  if (plane.off > 0) {
    file.warnings.push_back(text(where_is(plane.worst, names), names.point(plane.worst), " has ", axis, " = ",
                                 points[plane.worst].z, ", but ", names.point(plane.first), " has ", axis, " = ",
                                 file.z(), ": within ", kOff, " of the extent, so all are taken for a plane of this ",
                                 axis));
  }
  if (plane.unused.empty()) return;
  const std::size_t first = plane.unused.front(), n = plane.unused.size();
  file.warnings.push_back(text(where_is(first, names), names.point(first), " is of no triangle and has ", axis, " = ",
                               points[first].z, n == 1 ? std::string() : text(", and so have ", n - 1, " more"),
                               ": put into the plane of ", axis, " = ", file.z()));
}

struct SphereFit {
  double radius = 0;
  std::size_t n_off = 0;  // too far off
  double off = 0;         // the largest distance
};

SphereFit most_off(const std::vector<Vec3>& points, double radius) {
  SphereFit sphere = {radius};
  for (const Vec3 p : points) {
    const double distance = length(p);
    if (is_off(distance, radius)) ++sphere.n_off;
    sphere.off = std::max(sphere.off, std::abs(distance - radius));
  }
  return sphere;
}
SphereFit fit_sphere(const std::vector<Vec3>& points) { return most_off(points, median_distance(points)); }

std::string two_digits(double value) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.2g", value);
  return digits;
}

constexpr double kOffOfExtent = 1e-3;  // largest distance from a sphere, over the extent of a part of it
constexpr double kNearly = 0.01;       // of the extent or radius: then a sphere may be meant, not a surface

/// Returns the first point of a triangle for which `is` holds. Precondition: there is one.
template <class Is>
std::size_t find_used(const std::vector<Vec3>& points, const std::vector<bool>& used, const Is& is) {
  for (std::size_t i = 0;; ++i) {
    if (used[i] && is(points[i])) return i;
  }
}

/// The point of a triangle that is farthest from the sphere.
std::size_t worst_of(const SphereFit& sphere, const std::vector<Vec3>& points, const std::vector<bool>& used) {
  return find_used(points, used, [&](Vec3 p) { return std::abs(length(p) - sphere.radius) == sphere.off; });
}

[[noreturn]] void fail_in_space(const std::vector<Vec3>& points, const std::vector<bool>& used, const PlaneFit& plane,
                                const InputNames& names) {
  const std::vector<Vec3> all = kept(points, used);
  const SphereFit sphere = fit_sphere(all);
  const double radius = sphere.radius;
  constexpr std::string_view kExpected = "; expected all on one sphere around the origin, or in a plane of constant z";
  if (2 * sphere.n_off < all.size()) {
    const std::size_t off = find_used(points, used, [&](Vec3 p) { return is_off(length(p), radius); });
    fail(ErrorCode::not_planar, names.point_where(off), names.point(off), " is ", length(points[off]),
         " from the origin, but most points are ", radius, kExpected);
  }
  if (sphere.off <= kNearly * extent(all)) {
    const std::size_t worst = worst_of(sphere, points, used);
    fail(ErrorCode::not_planar, names.point_where(worst), names.point(worst), " is ", length(points[worst]),
         " from the origin, but the median of all is ", radius, ": off by ", two_digits(sphere.off / radius),
         " of it, and ", kOff, " is allowed", kExpected);
  }
  const double z = points[plane.first].z, allowed = kOff * extent(all);
  const std::size_t off = find_used(points, used, [&](Vec3 p) { return std::abs(p.z - z) > allowed; });
  fail(ErrorCode::not_planar, names.point_where(off), names.point(off), " has z = ", points[off].z, ", but ",
       names.point(plane.first), " has z = ", z,
       "; expected a mesh in a plane of constant x, y or z, or on a sphere around the origin. Next: --flat takes z as "
       "data of a mesh of the plane (flat=True in Python)");
}

bool is_near(const SphereFit& sphere, const std::vector<Vec3>& points) {
  return sphere.radius > 0 && sphere.off <= kNearly * std::min(sphere.radius, extent(points));
}

std::vector<Vec3> positions_of(const MeshFile& file) {
  std::vector<Vec3> positions;
  positions.reserve(file.points.size());
  for (std::size_t i = 0; i < file.points.size(); ++i) positions.push_back(position_of(file, i));
  return positions;
}

/// Says whether all triangles have one orientation when seen along z: the surface may be a bed.
bool is_graph(const MeshFile& file, const std::vector<Vec3>& points) {
  const auto side = [&](const std::array<std::int32_t, 3>& triangle) {
    const auto at = [&](std::size_t k) { return points[static_cast<std::size_t>(triangle[k])]; };
    return cross(at(1) - at(0), at(2) - at(0)).z;
  };
  const auto is_up = [&](const auto& triangle) { return side(triangle) > 0; };
  const auto is_down = [&](const auto& triangle) { return side(triangle) < 0; };
  return std::ranges::all_of(file.triangles, is_up) || std::ranges::all_of(file.triangles, is_down);
}

/// Takes the points for a curved surface. If they are nearly on a sphere, or most are, a sphere may be meant.
void set_surface(MeshFile& file, const std::vector<Vec3>& points, const std::vector<Vec3>& used) {
  const auto warn = [&](const auto&... words) {
    file.warnings.push_back(text(file.path, file.path.empty() ? "" : ": ", words...));
  };
  const SphereFit fit = fit_sphere(used);
  if (is_near(fit, used)) {
    warn("all points are on a sphere around the origin to ", two_digits(fit.off / fit.radius), " of its radius and ",
         two_digits(fit.off / extent(used)), " of their extent. A mesh of the sphere has at most ", kOff, " and ",
         kOffOfExtent,
         ", so they are a curved surface. Next: --projection sphere moves them to the sphere "
         "(projection=\"sphere\" in Python)");
  } else if (fit.n_off > 0 && 2 * fit.n_off < used.size()) {
    warn("most points are ", fit.radius, " from the origin, but ", fit.n_off, fit.n_off == 1 ? " is" : " are",
         " not: they are a curved surface");
  } else if (is_graph(file, points)) {
    warn(
        "z differs, so the mesh is a curved surface. Next: if z is a height or a depth, --flat takes the mesh as one "
        "of the plane (flat=True in Python)");
  }
  put_in_space(file, points, 2);
}

/// Puts points into the plane of their first two coordinates.
void set_plane(MeshFile& file, const std::vector<Vec3>& points, const PlaneFit& plane, const InputNames& names) {
  file.set_z(points.empty() ? 0 : points[plane.first].z);
  warn_of_plane(file, points, plane, names);
  file.points.clear();
  for (const Vec3 p : points) file.points.push_back({p.x, p.y});
}

}  // namespace

std::string_view name_of_axis(int axis) { return std::string_view("xyz").substr(static_cast<std::size_t>(axis), 1); }

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
      fail(ErrorCode::geographic, names.point_where(i), names.point(i), " has longitude ", p.x, " and latitude ", p.y,
           "; expected degrees, a latitude between -90 and 90");
    }
    if (!(std::abs(p.x) <= 720)) {
      fail(ErrorCode::geographic, names.point_where(i), names.point(i), " has longitude ", p.x, " and latitude ", p.y,
           "; expected degrees, a longitude between -720 and 720");
    }
    places.push_back(radius * direction_of(p));
  }
  file.points_in = SpherePoints{radius, std::move(places)};
}

void put_in_space(MeshFile& file, std::span<const Vec3> points, int dimension) {
  file.points.clear();
  std::vector<double> heights;
  for (const Vec3& p : points) {
    file.points.push_back({p.x, p.y});
    heights.push_back(p.z);
  }
  file.points_in = SpacePoints{std::move(heights), dimension};
}

void take_to_sphere(MeshFile& file, std::optional<double> radius, const InputNames& names) {
  std::vector<Vec3> points = positions_of(file);
  const std::vector<bool> used = corners_among(points.size(), file.triangles);
  const std::vector<Vec3> all = kept(points, used);
  const SphereFit sphere = fit_sphere(all);
  if (!is_near(sphere, all)) {
    const std::size_t worst = worst_of(sphere, points, used);
    fail(ErrorCode::not_planar, names.point_where(worst), names.point(worst), " is ", length(points[worst]),
         " from the origin, but the median of all is ", sphere.radius, "; expected all within ", kNearly,
         " of a sphere around the origin. Next: leave out the projection, for a curved surface");
  }
  const double to = radius.value_or(sphere.radius);
  for (Vec3& p : points) {
    const double distance = length(p);
    p = distance > 0 ? (to / distance) * p : Vec3{0, 0, to};  // only a point of no triangle is at the center
  }
  for (double& w : file.weights) w *= (to / sphere.radius) * (to / sphere.radius);
  file.warnings.push_back(text(file.path.empty() ? "" : file.path + ": ", "points are moved to the sphere of radius ",
                               to, ", by ", two_digits(sphere.off / sphere.radius), " of the radius at most"));
  set_sphere(file, to, std::move(points));
}

void resize_sphere(MeshFile& file, double radius) {
  auto& sphere = std::get<SpherePoints>(file.points_in);
  const double scale = radius / sphere.radius;
  for (Vec3& p : sphere.places) p = scale * p;
  for (double& w : file.weights) w *= scale * scale;
  sphere.radius = radius;
}

void set_sphere(MeshFile& file, double radius, std::vector<Vec3> points) {
  file.points.clear();
  file.points.reserve(points.size());
  for (const Vec3 p : points) file.points.push_back(lon_lat_of(p));
  file.points_in = SpherePoints{radius, std::move(points)};
}

void settle_points(MeshFile& file, std::vector<Vec3> points, const InputNames& names, bool may_be_surface) {
  expect_finite(points, names);
  const std::vector<bool> used =
      file.triangles.empty() ? std::vector<bool>(points.size(), true) : corners_among(points.size(), file.triangles);
  const bool whole = std::find(used.begin(), used.end(), false) == used.end();
  const std::vector<Vec3> some = whole ? std::vector<Vec3>() : kept(points, used);
  const std::vector<Vec3>& all = whole ? points : some;
  const PlaneFit plane = fit_plane(points, used);
  const auto radius = plane.off == 0 ? std::nullopt : common_radius(all);
  const auto fits = [&](const PlaneFit& fit) { return fit.off <= kOff * extent(all); };
  if (fits(plane) && !(radius && most_off(all, *radius).off < plane.off)) {
    if (file.sphere() != nullptr) file.points_in = PlanePoints{};
    return set_plane(file, points, plane, names);
  }
  if (radius) return set_sphere(file, *radius, std::move(points));
  const bool may_stand = file.periodic() == nullptr && file.degrees() == nullptr;
  for (int normal = 0; may_stand && normal < kZAxis; ++normal) {
    std::vector<Vec3> standing;
    standing.reserve(points.size());
    for (const Vec3 p : points) standing.push_back(turned(p, normal));
    const PlaneFit vertical = fit_plane(standing, used);
    if (!fits(vertical)) continue;
    file.points_in = PlanePoints{.normal = normal};
    return set_plane(file, standing, vertical, names);
  }
  if (!may_stand || !may_be_surface) fail_in_space(points, used, plane, names);
  set_surface(file, points, all);
}

Expected<void> expect_no_surface(const MeshFile& file) {
  if (!file.is_surface()) return {};
  const InputNames from_0;
  const InputNames& names = file.numbering ? *file.numbering : from_0;
  return guarded<void>(file.path, [&] {
    const std::vector<Vec3> points = positions_of(file);
    const std::vector<bool> used = corners_among(points.size(), file.triangles);
    fail_in_space(points, used, fit_plane(points, used), names);
  });
}

Expected<void> set_points(MeshFile& file, std::vector<Vec3> points) {
  const InputNames from_0;
  const InputNames& names = file.numbering ? *file.numbering : from_0;
  return guarded<void>({}, [&] {
    if (file.dimension() == 3) return put_in_space(file, points);
    settle_points(file, std::move(points), names);
  });
}

std::optional<double> common_radius(const std::vector<Vec3>& points) {
  const SphereFit fit = fit_sphere(points);
  const double radius = fit.radius;
  // A small surface far from the origin has nearly equal distances, too.
  if (!(radius > 0) || fit.n_off > 0 || fit.off > kOffOfExtent * extent(points)) return std::nullopt;
  // A radius that a person wrote has few digits.
  const double places = 11 - std::floor(std::log10(radius)), power = std::pow(10, std::abs(places));
  const double rounded = places > 0 ? std::round(radius * power) / power : std::round(radius / power) * power;
  return std::abs(rounded - radius) < 1e-14 * radius ? rounded : radius;
}

double MeshFile::z() const {
  return std::visit(
      [](const auto& in) {
        if constexpr (requires { in.z; }) return in.z;
        return 0.0;
      },
      points_in);
}

void MeshFile::set_z(double z) {
  std::visit(
      [z](auto& in) {
        if constexpr (requires { in.z; }) in.z = z;
      },
      points_in);
}

Vec3 MeshFile::place(std::size_t point) const {
  const Vec3 p = position_of(*this, point);
  const int normal = normal_of(*this);
  return normal == 0 ? Vec3{p.z, p.x, p.y} : normal == 1 ? Vec3{p.x, p.z, p.y} : p;
}

Space MeshFile::space() const {
  if (periodic() != nullptr) return Space::periodic(periodic()->period);
  return sphere() != nullptr ? Space::sphere(sphere()->radius) : Space();
}

bool is_flat(const MeshFile& file) { return file.sphere() == nullptr && file.z() == 0 && !std::signbit(file.z()); }

}  // namespace temper::io
