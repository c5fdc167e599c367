// Example meshes of the whole sphere: the bisected icosahedron, and random points, uniform or graded.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "base/rng.hpp"
#include "generate/outline.hpp"
#include "temper/detail/projection.hpp"
#include "temper/generate.hpp"

namespace temper {
namespace {

using generate::invalid;
using Corners = std::array<std::int32_t, 3>;

constexpr int kMostLevels = 13;  // 671 million vertices
constexpr std::size_t kMostOnGlobe = 500'000'000;

struct Globe {
  std::vector<Vec3> points;  // of the unit sphere
  std::vector<Corners> triangles;
};

Vec3 unit(Vec3 p) { return (1 / length(p)) * p; }

Globe icosahedron() {
  const double golden = (1 + std::sqrt(5.0)) / 2;
  Globe s;
  for (const double a : {1.0, -1.0}) {
    for (const double b : {golden, -golden}) {
      s.points.push_back(unit({0, a, b}));
      s.points.push_back(unit({a, b, 0}));
      s.points.push_back(unit({b, 0, a}));
    }
  }
  // Three vertices are a face if each two are neighbors: the nearest pairs are.
  const auto neighbors = [&](std::size_t i, std::size_t j) { return dot(s.points[i], s.points[j]) > 0.4; };
  for (std::size_t i = 0; i < 12; ++i) {
    for (std::size_t j = i + 1; j < 12; ++j) {
      for (std::size_t k = j + 1; k < 12; ++k) {
        if (!neighbors(i, j) || !neighbors(j, k) || !neighbors(k, i)) continue;
        const bool left = dot(s.points[i], cross(s.points[j], s.points[k])) > 0;
        const auto at = [](std::size_t x) { return static_cast<std::int32_t>(x); };
        s.triangles.push_back(left ? Corners{at(i), at(j), at(k)} : Corners{at(i), at(k), at(j)});
      }
    }
  }
  return s;
}

//          c            Each edge gets the direction of its midpoint, once.
//        /   \ .
//      ca --- bc
//     /   \ /   \ .
//    a --- ab --- b
Globe bisected(Globe coarse) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
  const auto middle = [&](std::int32_t a, std::int32_t b) {
    const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<std::int32_t>(coarse.points.size()));
    const auto point = [&](std::int32_t i) { return coarse.points[static_cast<std::size_t>(i)]; };
    if (is_new) coarse.points.push_back(unit(point(a) + point(b)));
    return at->second;
  };
  std::vector<Corners> fine;
  for (const auto& [a, b, c] : coarse.triangles) {
    const std::int32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const Corners& t : {Corners{a, ab, ca}, Corners{ab, b, bc}, Corners{ca, bc, c}, Corners{ab, bc, ca}}) {
      fine.push_back(t);
    }
  }
  return {std::move(coarse.points), std::move(fine)};
}

/// The distance of a unit vector from a place, as a part of the axis from there to the opposite place.
double part_of_axis(Vec3 p, Vec3 place) { return (1 - dot(p, place)) / 2; }

/// Uniform, without functions whose last bits differ between libraries (Marsaglia, 1972).
Vec3 random_direction(Rng& rng) {
  for (;;) {
    const double u = rng.uniform(-1, 1), v = rng.uniform(-1, 1), s = u * u + v * v;
    if (s >= 1) continue;
    const double r = 2 * std::sqrt(1 - s);
    return {u * r, v * r, 1 - 2 * s};
  }
}

std::optional<InputError> check_count(std::size_t vertices) {
  if (vertices < 20) return invalid("random points around a sphere should be 20 or more");
  if (vertices > kMostOnGlobe) return invalid("more than 500,000,000 vertices are out of reach");
  return std::nullopt;
}

std::optional<InputError> check_radius(double radius) {
  if (radius > 0 && std::isfinite(radius)) return std::nullopt;
  return invalid("the radius of a sphere must be positive and finite");
}

}  // namespace

Expected<Mesh> icosahedral(const Icosahedral& shape) {
  if (shape.level < 0 || shape.level > kMostLevels)
    return invalid("an icosahedron is bisected from 0 to " + std::to_string(kMostLevels) + " times");
  if (auto error = check_radius(shape.radius)) return *error;
  Globe s = icosahedron();
  for (int i = 0; i < shape.level; ++i) s = bisected(std::move(s));
  for (Vec3& p : s.points) p = shape.radius * p;
  MeshInput input;
  input.space = Space::sphere(shape.radius);
  input.sphere_points = s.points;
  input.triangles = s.triangles;
  auto built = Mesh::build(input);
  if (!built) return built.error();
  return std::move(built->mesh);
}

Expected<Mesh> random_sphere(const RandomSphere& shape) {
  if (auto error = check_count(shape.vertices)) return *error;
  if (auto error = check_radius(shape.radius)) return *error;
  Rng rng(shape.seed);
  std::vector<Vec3> points;
  points.reserve(shape.vertices);
  for (std::size_t i = 0; i < shape.vertices; ++i) points.push_back(random_direction(rng));
  return spherical_delaunay(points, shape.radius);
}

Expected<Mesh> graded_sphere(const GradedSphere& shape) {
  constexpr double kLargestRatio = 1000;  // a point in 10⁶ directions tried is then kept at the coarse end
  if (auto error = check_count(shape.vertices)) return *error;
  if (auto error = check_radius(shape.radius)) return *error;
  if (!(shape.ratio >= 1 && shape.ratio <= kLargestRatio))
    return invalid("the sizes of a graded sphere should have a ratio of 1 to 1000");
  if (!(std::abs(shape.at.x) <= 360 && std::abs(shape.at.y) <= 90))
    return invalid("expected a longitude and a latitude in degrees, found " + std::to_string(shape.at.x) + "," +
                   std::to_string(shape.at.y));
  Rng rng(shape.seed);
  const Vec3 place = direction_of(shape.at);
  std::vector<Vec3> points;
  points.reserve(shape.vertices);
  while (points.size() < shape.vertices) {
    const Vec3 p = random_direction(rng);
    if (rng.uniform() < std::pow(shape.ratio, -2 * part_of_axis(p, place))) points.push_back(p);
  }
  return spherical_delaunay(points, shape.radius);
}

double graded_sphere_size(const GradedSphere& shape, Vec3 direction) {
  // n vertices have 2n triangles of √3/4 s²: the integral of 1/s² over the sphere is √3/2 n, and gives the least s.
  const double rate = 2 * std::log(shape.ratio);
  const double mean = rate > 0 ? -std::expm1(-rate) / rate : 1;  // of (least/s)² over the sphere
  const double least = shape.radius * std::sqrt(8 * std::numbers::pi * std::numbers::inv_sqrt3 * mean /
                                                static_cast<double>(shape.vertices));
  return least * std::pow(shape.ratio, part_of_axis(unit(direction), direction_of(shape.at)));
}

}  // namespace temper
