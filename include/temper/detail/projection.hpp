// From longitude and latitude to the plane and back, by conformal maps of the sphere: angles stay what they are, so a
// mesh that is well-centered on the map is so, up to the curvature of single triangles, on the globe.
//
// The Earth is taken as a sphere of 6371 km (its mean radius); against the ellipsoid, lengths are off by up to 0.6 %,
// which no mesh notices. Formulas: J. P. Snyder, Map Projections: A Working Manual, USGS Professional Paper 1395, 1987.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "temper/detail/error.hpp"
#include "temper/detail/outline.hpp"
#include "temper/detail/vec.hpp"
#include "temper/mesh.hpp"

namespace temper {

enum class ProjectionKind {
  stereographic,        ///< true at the center; best for round regions, the poles included
  mercator,             ///< true along the center's parallel; best for belts along it
  transverse_mercator,  ///< true along the center's meridian; best for strips along it, the zones of UTM
};

/// The direction of a longitude and a latitude [degrees], exactly on the axes: of a pole there is one.
[[nodiscard]] Vec3 direction_of(Vec2 lon_lat);
/// Longitude, above −180 and up to 180, and latitude of a direction [degrees].
[[nodiscard]] Vec2 lon_lat_of(Vec3 direction);

/// Longitudes and latitudes are in degrees, x and y in meters from the center.
struct Projection {
  ProjectionKind kind = ProjectionKind::stereographic;
  Vec2 center = {};         ///< longitude and latitude
  double radius = 6371000;  ///< of the sphere [m]
};

/// Reads "stereographic", "mercator:lon" … "transverse-mercator:lon,lat". Without a center, that of `places`.
[[nodiscard]] Expected<Projection> parse_projection(std::string_view text, std::span<const Vec2> places);

/// The text that parse_projection reads as this projection, its radius apart.
[[nodiscard]] std::string projection_text(const Projection& projection);

/// The place on the map. Infinite where the map has no end (antipodes, poles): project() refuses such points.
[[nodiscard]] Vec2 forward(const Projection& projection, Vec2 lon_lat);
/// The longitude, in [center − 180, center + 180], and latitude of a place on the map.
[[nodiscard]] Vec2 inverse(const Projection& projection, Vec2 place);
/// The turn of the globe that longitudes are on: −100 and 260 are the same meridian, and one file has one of them.
class LongitudeTurn {
 public:
  explicit LongitudeTurn(std::span<const Vec2> lon_lat);
  /// The same place, its longitude within 180 degrees of the middle of those given.
  [[nodiscard]] Vec2 operator()(Vec2 lon_lat) const;

 private:
  double middle_ = 0;
};

/// Length on the map over length on the sphere: the same in all directions.
[[nodiscard]] double scale_factor(const Projection& projection, Vec2 lon_lat);

/// The middle of places on the sphere: the direction of their sum. `shares`: of each in it; empty: the same.
[[nodiscard]] Vec2 mean_place(std::span<const Vec2> lon_lat, std::span<const double> shares = {});

/// The outline on the map. Errors, by its names: latitudes beyond the poles, longitudes beyond ±360, places that are
/// infinitely far away, and pieces that are torn apart because the map ends between their ends.
[[nodiscard]] Expected<Outline> project(const Outline& lon_lat, const Projection& projection);
/// The points of a mesh on the map. The same errors, by its names.
[[nodiscard]] Expected<std::vector<Vec2>> project(std::span<const Vec2> lon_lat,
                                                  std::span<const std::array<std::int32_t, 3>> triangles,
                                                  const Projection& projection, const InputNames& names);

}  // namespace temper
