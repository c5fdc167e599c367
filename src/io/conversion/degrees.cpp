// Points in longitude and latitude: by a map, by data, or on the way to the sphere.
#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "io/conversion/globe.hpp"
#include "io/text/failure.hpp"
#include "io/text/values.hpp"
#include "temper/detail/read_number.hpp"

namespace temper::io {
namespace {

std::vector<Vec2> back_from_map(const GeographicMap& map, const std::vector<Vec2>& points) {
  std::unordered_map<Vec2, std::size_t, PlaceHash> known;
  for (std::size_t i = 0; i < map.places.size(); ++i) known.emplace(map.places[i], i);
  const LongitudeTurn turn(map.lon_lat);
  std::vector<Vec2> lon_lat;
  lon_lat.reserve(points.size());
  for (const Vec2 p : points) {
    const auto found = known.find(p);
    lon_lat.push_back(found != known.end() ? map.lon_lat[found->second] : turn(inverse(map.projection, p)));
  }
  return lon_lat;
}

const std::vector<double>* doubles_of(const MeshFile& file, std::string_view name) {
  const DataArray* array = find(file.point_data, name);
  return array != nullptr && array->components == 1 ? std::get_if<std::vector<double>>(&array->values) : nullptr;
}

Vec2 between_corners(const Place& place, const std::vector<Vec2>& lon_lat) {
  const auto n = static_cast<std::size_t>(place.n);
  std::array<Vec2, 3> corners;
  for (std::size_t k = 0; k < n; ++k) corners[k] = lon_lat[place.corners[k].index];
  return mean_place(std::span(corners).first(n), std::span(place.shares).first(n));
}

}  // namespace

bool look_like_degrees(std::span<const Vec2> points, std::span<const double> heights) {
  constexpr double kHalfTurn = 180;  // as wide as the globe: around the origin is no sign of a plane
  if (points.empty()) return false;
  Vec2 low = points[0], high = low;
  for (const Vec2 p : points) {
    if (!(std::abs(p.x) <= 360 && std::abs(p.y) <= 90)) return false;
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const double wide = std::max(high.x - low.x, high.y - low.y);
  if (std::ranges::any_of(heights, [wide](double z) { return std::abs(z) > wide; })) return true;
  const auto is_origin = [wide](Vec2 p) { return std::max(std::abs(p.x), std::abs(p.y)) <= kOff * wide; };
  return !(is_origin(low) || (is_origin(0.5 * (low + high)) && high.x < kHalfTurn));
}

std::optional<std::vector<Vec2>> lon_lat_of_points(const MeshFile& file) {
  if (file.map() != nullptr) return back_from_map(*file.map(), file.points);
  const auto *longitude = doubles_of(file, kLongitude), *latitude = doubles_of(file, kLatitude);
  if (longitude == nullptr || latitude == nullptr) return {};
  std::vector<Vec2> lon_lat;
  lon_lat.reserve(file.points.size());
  for (std::size_t i = 0; i < file.points.size(); ++i) lon_lat.push_back({(*longitude)[i], (*latitude)[i]});
  return lon_lat;
}

std::vector<Vec2> lon_lat_of_places(const MeshFile& file, const Mesh& mesh, std::span<const Vec2> places) {
  std::vector<Vec2> result;
  result.reserve(places.size());
  if (const GeographicMap* const map = file.map()) {
    const LongitudeTurn turn(map->lon_lat);
    for (const Vec2 p : places) result.push_back(turn(inverse(map->projection, p)));
    return result;
  }
  const std::vector<Vec2> corners = lon_lat_of_points(file).value_or(std::vector<Vec2>());
  const LongitudeTurn turn(corners);
  const PointLocator finder(mesh);
  TriangleId near;
  for (const Vec2 p : places) {
    const Place place = finder.find(p, near);
    near = place.triangle;
    result.push_back(turn(between_corners(place, corners)));
  }
  return result;
}

MeshFile in_degrees(const MeshFile& file) {
  MeshFile result = file;
  result.points = *lon_lat_of_points(file);
  result.points_in = DegreePoints{.z = file.z()};
  return result;
}

std::string needs_projection(bool guessed, std::string_view onto_sphere) {
  const std::string_view what =
      guessed ? "the points look like longitude and latitude: all x are from -360 to 360 and all y from -90 to 90, and "
                "the file does not say that they are lengths; in degrees angles and lengths are distorted"
              : "the points are longitude and latitude, in which angles and lengths are distorted";
  return text(what,
              ". Next: choose a `projection`: stereographic, mercator or transverse-mercator for lengths in meters, ",
              onto_sphere, " for a mesh of the sphere, or none ",
              guessed ? "if they are coordinates of a plane" : "to use the degrees as coordinates of a plane");
}

namespace {

/// The radius in "sphere" or "sphere:radius=R"; nothing for other words.
std::optional<Expected<double>> radius_of_sphere(std::string_view words) {
  if (words == kOntoSphere) return Projection{}.radius;
  constexpr std::string_view kRadius = ":radius=";
  if (!words.starts_with(kOntoSphere)) return std::nullopt;
  words.remove_prefix(kOntoSphere.size());
  double radius = 0;
  if (words.starts_with(kRadius)) {
    words.remove_prefix(kRadius.size());
    const auto [end, error] = read_number(words.data(), words.data() + words.size(), radius);
    if (error == std::errc() && end == words.data() + words.size() && radius > 0 && std::isfinite(radius))
      return radius;
  }
  return InputError{
      ErrorCode::invalid_option, {}, text("the sphere has '", words, "'; expected sphere or sphere:radius=R, R > 0")};
}

}  // namespace

Expected<void> project(MeshFile& file, std::string_view projection) {
  const auto radius = radius_of_sphere(projection);
  if (radius && !*radius) return radius->error();
  if (file.is_surface() && radius) {
    const InputNames from_0;
    const auto to = projection == kOntoSphere ? std::nullopt : std::optional(**radius);
    return guarded<void>(file.path, [&] { take_to_sphere(file, to, file.numbering ? *file.numbering : from_0); });
  }
  if (auto right = expect_triangles(file); !right) return right;
  if (file.sphere() != nullptr) {
    if (radius) {
      resize_sphere(file, **radius);
      return {};
    }
    file.points_in = DegreePoints{};
  }
  if (projection == kNoProjection) {
    if (file.degrees() != nullptr) file.points_in = PlanePoints{file.z()};
    return {};
  }
  if (radius) {
    const InputNames from_0;
    return guarded<void>({}, [&] { put_on_sphere(file, **radius, file.numbering ? *file.numbering : from_0); });
  }
  auto parsed = parse_projection(projection, file.points);
  if (!parsed) return parsed.error();
  const InputNames numbers_from_0;
  const InputNames& names = file.numbering ? *file.numbering : numbers_from_0;
  auto places = temper::project(file.points, file.triangles, *parsed, names);
  if (!places) return places.error();
  const GeographicMap map = {*parsed, std::move(file.points), *places};
  file.points_in = MappedPoints{std::make_shared<const GeographicMap>(map), file.z()};
  file.points = *std::move(places);
  return {};
}

}  // namespace temper::io
