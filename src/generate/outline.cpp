// Plane geometry of example outlines, in doubles: it chooses the places of points, and never decides what is valid.
#include "generate/outline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace temper::generate {
namespace {

std::size_t pieces_of(Vec2 from, Vec2 to, double spacing) {
  return static_cast<std::size_t>(std::max(1.0, std::round(length(to - from) / spacing)));
}

}  // namespace

void Outline::add_loop(const std::vector<Vec2>& loop) {
  const auto first = static_cast<std::int32_t>(points.size());
  const auto n = static_cast<std::int32_t>(loop.size());
  for (std::int32_t i = 0; i < n; ++i) segments.push_back({first + i, first + (i + 1) % n});
  points.insert(points.end(), loop.begin(), loop.end());
}

double signed_area(const Polygon& polygon) {
  double doubled = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    doubled += cross(polygon[i] - polygon[0], polygon[(i + 1) % polygon.size()] - polygon[0]);
  }
  return 0.5 * doubled;
}

std::size_t count_pieces(const Polygon& polygon, double spacing) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    count += pieces_of(polygon[i], polygon[(i + 1) % polygon.size()], spacing);
  }
  return count;
}

Polygon divide_sides(const Polygon& polygon, double spacing) {
  Polygon divided;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 from = polygon[i], to = polygon[(i + 1) % polygon.size()];
    const std::size_t n = pieces_of(from, to, spacing);
    for (std::size_t k = 0; k < n; ++k) {
      divided.push_back(from + (static_cast<double>(k) / static_cast<double>(n)) * (to - from));
    }
  }
  return divided;
}

bool contains(const Polygon& polygon, Vec2 p) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    if ((a.y > p.y) == (b.y > p.y)) continue;
    if (p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  }
  return inside;
}

double squared_distance(const Polygon& polygon, Vec2 p) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i], ab = polygon[(i + 1) % polygon.size()] - a;
    const double along = std::clamp(dot(p - a, ab) / squared_length(ab), 0.0, 1.0);
    least = std::min(least, squared_length(p - a - along * ab));
  }
  return least;
}

std::vector<Vec2> corner_points(const Polygon& polygon, double distance) {
  // Beyond 150° the circle of a corner and its neighbors is so large that other points are in it anyway.
  constexpr double kWidestCosine = -0.8660254037844386;
  std::vector<Vec2> points;
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i) {
    Vec2 before = polygon[(i + n - 1) % n] - polygon[i], after = polygon[(i + 1) % n] - polygon[i];
    before = (1 / length(before)) * before;
    after = (1 / length(after)) * after;
    if (cross(after, before) <= 0 || dot(after, before) < kWidestCosine) continue;
    const Vec2 bisector = before + after;
    points.push_back(polygon[i] + (distance / length(bisector)) * bisector);
  }
  return points;
}

}  // namespace temper::generate
