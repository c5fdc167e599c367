// Maps between longitude and latitude and the plane, by conformal maps of the sphere. They keep angles. So a mesh that
// is well-centered on the map is well-centered on the globe, up to the curvature of single triangles.
//
// The Earth is a sphere of 6371 km, its mean radius. Compared with the ellipsoid, lengths differ by up to 0.6 %, which
// does not matter for meshes. Formulas: J. P. Snyder, Map Projections: A Working Manual, USGS Professional Paper 1395,
// 1987.
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
  stereographic,        ///< True scale at the center; best for round regions, the poles included
  mercator,             ///< True scale along the center's parallel; best for belts along it
  transverse_mercator,  ///< True scale along the center's meridian; best for strips along it, the zones of UTM
};

/// The direction of a longitude and a latitude [degrees], exact on the axes. Each pole has only one direction.
[[nodiscard]] Vec3 direction_of(Vec2 lon_lat);
/// Longitude, above −180 and up to 180, and latitude of a direction [degrees].
[[nodiscard]] Vec2 lon_lat_of(Vec3 direction);

/// Longitudes and latitudes are in degrees, x and y in meters from the center.
struct Projection {
  ProjectionKind kind = ProjectionKind::stereographic;
  Vec2 center = {};         ///< Longitude and latitude
  double radius = 6371000;  ///< Radius of the sphere [m]
};

/// Reads "stereographic", "mercator:lon" … "transverse-mercator:lon,lat". Without a center, the center of `places`
/// is used.
[[nodiscard]] Expected<Projection> parse_projection(std::string_view text, std::span<const Vec2> places);

/// The text that parse_projection reads as this projection, without its radius.
[[nodiscard]] std::string projection_text(const Projection& projection);

/// The place on the map. It is infinite if the map has no end there (antipodes, poles); project() refuses such points.
[[nodiscard]] Vec2 forward(const Projection& projection, Vec2 lon_lat);
/// The longitude, in [center − 180, center + 180], and latitude of a place on the map.
[[nodiscard]] Vec2 inverse(const Projection& projection, Vec2 place);
/// The range of longitudes. The longitudes −100 and 260 are the same meridian, and a file uses one of them.
class LongitudeTurn {
 public:
  explicit LongitudeTurn(std::span<const Vec2> lon_lat);
  /// Returns the place with a longitude within 180 degrees of the middle of the given ones.
  [[nodiscard]] Vec2 operator()(Vec2 lon_lat) const;

 private:
  double middle_ = 0;
};

/// Length on the map over length on the sphere: the same in all directions.
[[nodiscard]] double scale_factor(const Projection& projection, Vec2 lon_lat);

/// The middle of places on the sphere: the direction of their sum. `shares`: factor of each place; empty: all equal.
[[nodiscard]] Vec2 mean_place(std::span<const Vec2> lon_lat, std::span<const double> shares = {});

/// Maps an outline. Errors, with its names: latitudes beyond the poles, longitudes beyond ±360, places that are
/// infinitely far away, and segments that are torn apart because the map ends between their ends.
[[nodiscard]] Expected<Outline> project(const Outline& lon_lat, const Projection& projection);
/// Maps the points of a mesh. Errors are the same, with its names.
[[nodiscard]] Expected<std::vector<Vec2>> project(std::span<const Vec2> lon_lat,
                                                  std::span<const std::array<std::int32_t, 3>> triangles,
                                                  const Projection& projection, const InputNames& names);

}  // namespace temper
