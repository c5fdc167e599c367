// Longitude and latitude, and directions from the center of the globe.
#include <cmath>
#include <numbers>

#include "temper/detail/projection.hpp"

namespace temper {
namespace {

constexpr double kGlobeDegree = std::numbers::pi / 180;

struct Turn {
  double cosine, sine;
};

/// Cosine and sine of degrees, exact at multiples of 90.
Turn turn_of(double degrees) {
  const double rest = std::remainder(degrees, 360);  // exact
  const double quarter = std::nearbyint(rest / 90), angle = (rest - 90 * quarter) * kGlobeDegree;
  const double c = std::cos(angle), s = std::sin(angle);
  switch ((static_cast<int>(quarter) + 4) % 4) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

}  // namespace

Vec3 direction_of(Vec2 lon_lat) {
  const Turn lon = turn_of(lon_lat.x), lat = turn_of(lon_lat.y);
  if (lat.cosine == 0) return {0, 0, lat.sine};
  return {lat.cosine * lon.cosine, lat.cosine * lon.sine, lat.sine};
}

Vec2 lon_lat_of(Vec3 p) {
  const double lon = p.x == 0 && p.y == 0 ? 0 : std::atan2(p.y, p.x) / kGlobeDegree;
  return {lon == -180 ? 180 : lon, std::atan2(p.z, std::hypot(p.x, p.y)) / kGlobeDegree};
}

}  // namespace temper
