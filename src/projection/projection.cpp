// Snyder's formulas for the sphere, in the forms that keep their digits near poles and centers (atan2 for asin).
#include "temper/detail/projection.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "temper/detail/read_number.hpp"
#include "temper/detail/suggest.hpp"

namespace temper {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

struct KindName {
  std::string_view name;
  ProjectionKind kind;
};
constexpr std::array<KindName, 3> kKinds = {{{"stereographic", ProjectionKind::stereographic},
                                             {"mercator", ProjectionKind::mercator},
                                             {"transverse-mercator", ProjectionKind::transverse_mercator}}};

/// The angle from the center's meridian, in [−180, 180] degrees, in radians.
double from_center(const Projection& p, double lon) { return std::remainder(lon - p.center.x, 360) * kDegree; }

Vec2 stereographic(double lambda, double phi, double phi1) {  // (21-2), (21-3), (21-4)
  const double k = 2 / (1 + std::sin(phi1) * std::sin(phi) + std::cos(phi1) * std::cos(phi) * std::cos(lambda));
  return {k * std::cos(phi) * std::sin(lambda),
          k * (std::cos(phi1) * std::sin(phi) - std::sin(phi1) * std::cos(phi) * std::cos(lambda))};
}

/// (20-14), (20-15), (21-15), by the unit vector of the place: east, north and up at the center.
Vec2 stereographic_inverse(Vec2 p, double phi1) {
  const double x = p.x / 2, y = p.y / 2, d = 1 + x * x + y * y;
  const double east = 2 * x / d, north = 2 * y / d, up = (2 - d) / d;
  const double to_pole = north * std::cos(phi1) + up * std::sin(phi1);
  const double to_meridian = up * std::cos(phi1) - north * std::sin(phi1);
  return {std::atan2(east, to_meridian), std::atan2(to_pole, std::hypot(east, to_meridian))};
}

double mercator_height(double phi) { return std::asinh(std::tan(phi)); }  // (7-2)

Vec2 transverse(double lambda, double phi, double phi0) {  // (8-1), (8-3), (8-5)
  const double b = std::cos(phi) * std::sin(lambda);
  return {std::atanh(b), std::atan2(std::sin(phi), std::cos(phi) * std::cos(lambda)) - phi0};
}

Vec2 transverse_inverse(Vec2 p, double phi0) {  // (8-6), (8-7), (8-8)
  const double d = p.y + phi0, s = std::sinh(p.x);
  return {std::atan2(s, std::cos(d)), std::atan2(std::sin(d), std::hypot(std::cos(d), s))};
}

InputError invalid_projection(std::string message) { return {ErrorCode::invalid_option, "", std::move(message)}; }

/// "lon" or "lon,lat".
std::optional<std::array<std::optional<double>, 2>> parse_center(std::string_view text) {
  std::array<std::optional<double>, 2> center;
  for (std::size_t i = 0; i < 2 && !text.empty(); ++i) {
    const std::string_view field = text.substr(0, text.find(','));
    double value = 0;
    const auto [end, error] = read_number(field.data(), field.data() + field.size(), value);
    if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(value)) return {};
    center[i] = value;
    const bool last = field.size() == text.size();
    text.remove_prefix(last ? field.size() : field.size() + 1);
    if (!last && text.empty()) return {};
  }
  if (!text.empty() || !center[0]) return {};
  return center;
}

/// The zone in a name of UTM, such as utm32, UTM:32N or EPSG:32632; 0: a name of UTM without a zone; none: another
/// name.
std::optional<int> zone_of(std::string_view text) {
  constexpr int kZones = 60;
  std::string letters;
  int digits = 0;
  for (const char c : text) {
    if (c >= '0' && c <= '9') digits = std::min(10 * digits + (c - '0'), 100000);
    if (c >= 'A' && c <= 'Z') letters += static_cast<char>(c + ('a' - 'A'));
    if (c >= 'a' && c <= 'z') letters += c;
  }
  if (letters == "epsg" && (digits / 100 == 326 || digits / 100 == 327))
    digits %= 100;
  else if (!letters.starts_with("utm"))
    return std::nullopt;
  return digits <= kZones ? digits : 0;
}

/// The projection that a user may mean by an unknown name.
std::string next_for(std::string_view text) {
  std::array<std::string_view, std::size(kKinds)> names;
  std::ranges::transform(kKinds, names.begin(), &KindName::name);
  const std::optional<int> zone = zone_of(text);
  if (!zone) return did_you_mean(text.substr(0, text.find(':')), names);
  if (*zone == 0)
    return ". Next: for UTM take transverse-mercator:LON, with the middle longitude of the zone (9 in zone 32)";
  return ". Next: for this zone of UTM take transverse-mercator:" + std::to_string(6 * *zone - 183);
}

}  // namespace

Expected<Projection> parse_projection(std::string_view text, std::span<const Vec2> places) {
  const std::string_view name = text.substr(0, text.find(':'));
  Projection projection;
  const KindName* found = nullptr;
  for (const KindName& kind : kKinds) {
    if (kind.name == name) found = &kind;
  }
  if (found == nullptr) {
    return invalid_projection("expected a projection (stereographic, mercator, transverse-mercator), found '" +
                              std::string(text) + "'" + next_for(text));
  }
  projection.kind = found->kind;
  projection.center = mean_place(places);
  if (name.size() == text.size()) return projection;
  const auto center = parse_center(text.substr(name.size() + 1));
  if (!center) {
    return invalid_projection("expected " + std::string(name) + ":lon,lat in degrees, found '" + std::string(text) +
                              "'");
  }
  projection.center = {*(*center)[0], (*center)[1].value_or(projection.center.y)};
  const bool on_globe = std::abs(projection.center.x) <= 360 && std::abs(projection.center.y) <= 90;
  const bool pole = projection.kind == ProjectionKind::mercator && std::abs(projection.center.y) >= 90;
  if (!on_globe || pole) return invalid_projection("'" + std::string(text) + "' has its center off the map");
  return projection;
}

Vec2 forward(const Projection& p, Vec2 lon_lat) {
  const double lambda = from_center(p, lon_lat.x), phi = lon_lat.y * kDegree, phi0 = p.center.y * kDegree;
  switch (p.kind) {
    case ProjectionKind::stereographic:
      return p.radius * stereographic(lambda, phi, phi0);
    case ProjectionKind::mercator:
      return (p.radius * std::cos(phi0)) * Vec2{lambda, mercator_height(phi) - mercator_height(phi0)};
    case ProjectionKind::transverse_mercator:
      return p.radius * transverse(lambda, phi, phi0);
  }
  return {};
}

Vec2 inverse(const Projection& p, Vec2 place) {
  const double phi0 = p.center.y * kDegree;
  Vec2 angles;
  switch (p.kind) {
    case ProjectionKind::stereographic:
      angles = stereographic_inverse((1 / p.radius) * place, phi0);
      break;
    case ProjectionKind::mercator: {
      const Vec2 unit = (1 / (p.radius * std::cos(phi0))) * place;
      angles = {unit.x, std::atan(std::sinh(unit.y + mercator_height(phi0)))};
      break;
    }
    case ProjectionKind::transverse_mercator:
      angles = transverse_inverse((1 / p.radius) * place, phi0);
      break;
  }
  return {p.center.x + angles.x / kDegree, angles.y / kDegree};
}

LongitudeTurn::LongitudeTurn(std::span<const Vec2> lon_lat) {
  if (lon_lat.empty()) return;
  const auto [west, east] =
      std::minmax_element(lon_lat.begin(), lon_lat.end(), [](Vec2 a, Vec2 b) { return a.x < b.x; });
  middle_ = (west->x + east->x) / 2;
}

Vec2 LongitudeTurn::operator()(Vec2 lon_lat) const {
  return {lon_lat.x + 360 * std::round((middle_ - lon_lat.x) / 360), lon_lat.y};
}

double scale_factor(const Projection& p, Vec2 lon_lat) {
  const double lambda = from_center(p, lon_lat.x), phi = lon_lat.y * kDegree, phi0 = p.center.y * kDegree;
  switch (p.kind) {
    case ProjectionKind::stereographic:
      return 2 / (1 + std::sin(phi0) * std::sin(phi) + std::cos(phi0) * std::cos(phi) * std::cos(lambda));
    case ProjectionKind::mercator:
      return std::cos(phi0) / std::cos(phi);
    case ProjectionKind::transverse_mercator: {
      const double b = std::cos(phi) * std::sin(lambda);
      return 1 / std::sqrt((1 - b) * (1 + b));
    }
  }
  return 1;
}

Vec2 mean_place(std::span<const Vec2> lon_lat, std::span<const double> shares) {
  double x = 0, y = 0, z = 0;
  for (std::size_t i = 0; i < lon_lat.size(); ++i) {
    const double lon = lon_lat[i].x * kDegree, lat = lon_lat[i].y * kDegree, share = shares.empty() ? 1 : shares[i];
    x += share * (std::cos(lat) * std::cos(lon));
    y += share * (std::cos(lat) * std::sin(lon));
    z += share * std::sin(lat);
  }
  if (x == 0 && y == 0 && z == 0) return {};
  return {std::atan2(y, x) / kDegree, std::atan2(z, std::hypot(x, y)) / kDegree};
}

namespace {

// At larger scales, further away from the center, the map is useless and soon infinite.
constexpr double kLargestScale = 1e3;

/// The place on the map, if it has one.
std::optional<Vec2> mapped(const Projection& projection, Vec2 place) {
  const bool on_globe = std::abs(place.x) <= 360 && std::abs(place.y) <= 90;  // false for NaN
  if (!on_globe || !(scale_factor(projection, place) < kLargestScale)) return {};
  return forward(projection, place);
}

InputError off_the_map(const std::string& where, const std::string& name, Vec2 place) {
  return {ErrorCode::out_of_scale, where,
          name + " is at longitude " + std::to_string(place.x) + " and latitude " + std::to_string(place.y) +
              "; expected degrees on the globe, and not at the end of the map"};
}

/// Says whether the map ends between two places. A stereographic map ends at one point.
bool is_torn(const Projection& projection, Vec2 a, Vec2 b) {
  if (projection.kind == ProjectionKind::stereographic) return false;
  return std::abs(from_center(projection, b.x) - from_center(projection, a.x)) > std::numbers::pi;
}

InputError torn(const std::string& where, const std::string& name) {
  return {ErrorCode::out_of_scale, where,
          name + " crosses the end of the map, 180 degrees from its center; choose another center"};
}

/// The names of an outline in degrees, for its map.
class ProjectedNames final : public OutlineNames {
 public:
  ProjectedNames(std::shared_ptr<const OutlineNames> names, const Projection& projection)
      : names_(names ? std::move(names) : std::make_shared<const OutlineNames>()), projection_(projection) {}

  [[nodiscard]] std::string point(std::size_t i) const override { return names_->point(i); }
  [[nodiscard]] std::string segment(std::size_t i) const override { return names_->segment(i); }
  [[nodiscard]] std::string hole(std::size_t i) const override { return names_->hole(i); }
  [[nodiscard]] std::string region(std::size_t i) const override { return names_->region(i); }
  [[nodiscard]] std::string part(std::size_t i) const override { return names_->part(i); }
  [[nodiscard]] std::string ring(std::size_t i) const override { return names_->ring(i); }
  [[nodiscard]] Vec2 in_file(Vec2 place) const override { return names_->in_file(inverse(projection_, place)); }
  [[nodiscard]] std::string point_where(std::size_t i) const override { return names_->point_where(i); }
  [[nodiscard]] std::string segment_where(std::size_t i) const override { return names_->segment_where(i); }
  [[nodiscard]] std::string hole_where(std::size_t i) const override { return names_->hole_where(i); }
  [[nodiscard]] std::string region_where(std::size_t i) const override { return names_->region_where(i); }

 private:
  std::shared_ptr<const OutlineNames> names_;
  Projection projection_;
};

}  // namespace

Expected<Outline> project(const Outline& lon_lat, const Projection& projection) {
  Outline result = lon_lat;
  result.names = std::make_shared<const ProjectedNames>(lon_lat.names, projection);
  const OutlineNames numbers_from_0;
  const OutlineNames& names = lon_lat.names ? *lon_lat.names : numbers_from_0;
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    const auto place = mapped(projection, lon_lat.points[i]);
    if (!place) return off_the_map(names.point_where(i), names.point(i), lon_lat.points[i]);
    result.points[i] = *place;
  }
  for (std::size_t i = 0; i < result.holes.size(); ++i) {
    const auto place = mapped(projection, lon_lat.holes[i]);
    if (!place) return off_the_map(names.hole_where(i), names.hole(i), lon_lat.holes[i]);
    result.holes[i] = *place;
  }
  for (std::size_t i = 0; i < result.regions.size(); ++i) {
    const auto place = mapped(projection, lon_lat.regions[i].at);
    if (!place) return off_the_map(names.region_where(i), names.region(i), lon_lat.regions[i].at);
    result.regions[i].at = *place;
  }
  for (std::size_t i = 0; i < result.segments.size(); ++i) {
    const auto& ends = result.segments[i].ends;
    const auto n = static_cast<std::int64_t>(result.points.size());
    if (ends[0] < 0 || ends[1] < 0 || ends[0] >= n || ends[1] >= n) continue;  // the mesher's to name
    const Vec2 a = lon_lat.points[static_cast<std::size_t>(ends[0])];
    const Vec2 b = lon_lat.points[static_cast<std::size_t>(ends[1])];
    if (is_torn(projection, a, b)) return torn(names.segment_where(i), names.segment(i));
  }
  return result;
}

Expected<std::vector<Vec2>> project(std::span<const Vec2> lon_lat,
                                    std::span<const std::array<std::int32_t, 3>> triangles,
                                    const Projection& projection, const InputNames& names) {
  std::vector<Vec2> places;
  places.reserve(lon_lat.size());
  for (std::size_t i = 0; i < lon_lat.size(); ++i) {
    const auto place = mapped(projection, lon_lat[i]);
    if (!place) return off_the_map(names.point_where(i), names.point(i), lon_lat[i]);
    places.push_back(*place);
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = triangles[t][k], b = triangles[t][(k + 1) % 3];
      const auto n = static_cast<std::int64_t>(lon_lat.size());
      if (std::min(a, b) < 0 || std::max(a, b) >= n) continue;  // Mesh::build's to name
      if (is_torn(projection, lon_lat[static_cast<std::size_t>(a)], lon_lat[static_cast<std::size_t>(b)])) {
        return torn(names.triangle_where(t), names.triangle(t));
      }
    }
  }
  return places;
}

std::string projection_text(const Projection& projection) {
  std::string text;
  for (const KindName& kind : kKinds) {
    if (kind.kind == projection.kind) text = kind.name;
  }
  return text + ":" + to_text(projection.center.x) + "," + to_text(projection.center.y);
}

// Longitude and latitude, and directions from the center of the globe.

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
