// Random points in a polygon: an unstructured mesh with about half of its triangles obtuse. A Delaunay mesh of a
// sensible boundary gets no worse, and yet the fixed boundary does not make it hopeless.
#include <algorithm>
#include <cmath>

#include "base/box.hpp"
#include "base/rng.hpp"
#include "generate/outline.hpp"
#include "temper/generate.hpp"

namespace temper {
namespace {

// Points keep this part of the mean spacing from the boundary, so that no boundary triangle is a sliver.
constexpr double kBoundaryGap = 0.5;
// A corner point at this part of the spacing lies inside the circle of a right corner and its neighbors. (The center
// and radius of the circle are 0.71 of the spacing.) It is still well away from both sides.
constexpr double kCornerGap = 0.6;

/// An L with a notch in its base: reflex at the notch and at the elbow.
Polygon default_polygon() { return {{0, 0}, {1.5, 0}, {2, 0.75}, {2.5, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}}; }

std::optional<InputError> check(const RandomMesh& shape, const Polygon& polygon) {
  using generate::invalid;
  if (polygon.size() < 3)
    return invalid("a polygon needs three corners or more, not " + std::to_string(polygon.size()));
  if (shape.vertices < polygon.size()) {
    return invalid("a mesh of this polygon needs " + std::to_string(polygon.size()) + " vertices or more, not " +
                   std::to_string(shape.vertices));
  }
  if (shape.vertices > 500'000'000) return invalid("more than 500,000,000 vertices are out of reach");
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    if (!std::isfinite(polygon[i].x) || !std::isfinite(polygon[i].y)) {
      return InputError{ErrorCode::not_finite, "", "corner " + std::to_string(i) + " of the polygon is not finite"};
    }
    if (polygon[i] == polygon[(i + 1) % polygon.size()]) {
      return InputError{ErrorCode::duplicate_point, "",
                        "corner " + std::to_string(i) + " of the polygon and the next are the same"};
    }
  }
  if (!(std::abs(generate::signed_area(polygon)) > 0)) {
    return InputError{ErrorCode::zero_area, "", "the polygon has no area"};
  }
  return std::nullopt;
}

/// The mean spacing of n points in the polygon; more, if the boundary alone would take more than n points.
double boundary_spacing(const Polygon& polygon, std::size_t n) {
  constexpr double kStep = 1.0625;
  double spacing = std::sqrt(generate::signed_area(polygon) / static_cast<double>(n));
  while (generate::count_pieces(polygon, spacing) > n) spacing *= kStep;
  return spacing;
}

/// Adds uniformly random points up to n in all. If the gap leaves no room, it is halved.
void fill(std::vector<Vec2>& points, std::size_t n, const Polygon& polygon, double spacing, Rng& rng) {
  PlaneBox box;
  for (const Vec2 p : polygon) box.add(p);
  double gap = kBoundaryGap * spacing;
  for (std::size_t misses = 0; points.size() < n;) {
    const double x = rng.uniform(box.low.x, box.high.x), y = rng.uniform(box.low.y, box.high.y);
    const Vec2 p = {x, y};
    if (generate::contains(polygon, p) && generate::squared_distance(polygon, p) >= gap * gap) {
      points.push_back(p);
      misses = 0;
    } else if (++misses == 10'000) {
      gap *= 0.5;
      misses = 0;
    }
  }
}

}  // namespace

Expected<Mesh> random_mesh(const RandomMesh& shape) {
  Polygon polygon = shape.polygon.empty() ? default_polygon() : shape.polygon;
  if (auto error = check(shape, polygon)) return *error;
  if (generate::signed_area(polygon) < 0) std::reverse(polygon.begin(), polygon.end());
  const double spacing = boundary_spacing(polygon, shape.vertices);
  Rng rng(shape.seed);
  generate::Outline outline;
  outline.add_loop(generate::divide_sides(polygon, spacing));
  for (const Vec2 p : generate::corner_points(polygon, kCornerGap * spacing)) {
    const double room = 0.25 * kCornerGap * spacing;
    if (outline.points.size() == shape.vertices || !generate::contains(polygon, p)) continue;
    if (generate::squared_distance(polygon, p) > room * room) outline.points.push_back(p);
  }
  fill(outline.points, shape.vertices, polygon, spacing, rng);
  return outline.triangulate();
}

}  // namespace temper
