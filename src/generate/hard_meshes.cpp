// Meshes that plain sweeps do not make well-centered, or only just: polygons without inner vertices, sharp corners,
// strong grading.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/rng.hpp"
#include "generate/outline.hpp"
#include "temper/generate.hpp"

namespace temper {
namespace {

using generate::invalid;

/// Closed polygons, the first around all others, and further points inside.
Expected<Mesh> mesh_of(const std::vector<Polygon>& polygons, const std::vector<Vec2>& inside = {}) {
  std::vector<Vec2> points;
  std::vector<std::array<std::int32_t, 2>> segments;
  for (const Polygon& polygon : polygons) {
    const auto first = static_cast<std::int32_t>(points.size());
    points.insert(points.end(), polygon.begin(), polygon.end());
    const auto last = static_cast<std::int32_t>(points.size()) - 1;
    for (std::int32_t v = first; v <= last; ++v) segments.push_back({v, v == last ? first : v + 1});
  }
  points.insert(points.end(), inside.begin(), inside.end());
  return constrained_delaunay({.points = points, .segments = segments});
}

struct Side {
  Vec2 from;
  int pieces;
};

Polygon divided(const std::vector<Side>& sides) {
  Polygon polygon;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Vec2 a = sides[i].from, b = sides[(i + 1) % sides.size()].from;
    for (int k = 0; k < sides[i].pieces; ++k) polygon.push_back(a + (double(k) / sides[i].pieces) * (b - a));
  }
  return polygon;
}

/// Places from 0 to 1 whose distances follow size.
template <class Size>
std::vector<double> graded_steps(const Size& size) {
  std::vector<double> steps = {0};
  while (steps.back() < 1) steps.push_back(steps.back() + size(steps.back()));
  const double whole = steps.back();
  for (double& s : steps) s /= whole;
  return steps;
}

}  // namespace

Expected<Mesh> regular_polygon(const RegularPolygon& shape) {
  if (shape.corners < 3) {
    return invalid("a regular polygon needs at least 3 corners, not " + std::to_string(shape.corners));
  }
  Polygon polygon;
  for (int i = 0; i < shape.corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / shape.corners;
    polygon.push_back({std::cos(angle), std::sin(angle)});
  }
  return mesh_of({polygon});
}

Mesh letter_a() {
  const Polygon outline = divided({{{0, 0}, 1},
                                   {{0.25, 0}, 2},
                                   {{0.36, 0.3}, 2},
                                   {{0.64, 0.3}, 2},
                                   {{0.75, 0}, 1},
                                   {{1, 0}, 6},
                                   {{0.62, 1}, 1},
                                   {{0.38, 1}, 6}});
  const Polygon hole = divided({{{0.42, 0.48}, 2}, {{0.58, 0.48}, 3}, {{0.5, 0.72}, 3}});
  return *mesh_of({outline, hole});
}

Expected<Mesh> wedge(const Wedge& shape) {
  if (!(shape.angle_deg > 0 && shape.angle_deg < 180) || shape.pieces < 1) {
    return invalid("a wedge needs an angle between 0 and 180 degrees and sides of at least 1 piece");
  }
  const double angle = shape.angle_deg * std::numbers::pi / 180;
  const Vec2 right{1, 0}, left{std::cos(angle), std::sin(angle)};
  std::vector<Vec2> inside;
  Rng rng(shape.seed);
  for (int i = 0; i < shape.pieces; ++i) {
    const double r = rng.uniform(0.3, 0.95), s = rng.uniform(0.2, 0.8);
    inside.push_back(r * ((1 - s) * right + s * left));
  }
  return mesh_of({divided({{{0, 0}, shape.pieces}, {right, 1}, {left, shape.pieces}})}, inside);
}

Expected<Mesh> graded_mesh(const GradedMesh& shape) {
  if (!(shape.finest > 0 && shape.finest <= 0.25) || !(shape.growth >= 0 && shape.growth <= 1)) {
    return invalid("graded points need a finest size in (0, 0.25] and a growth in [0, 1]");
  }
  const auto size = [&](double distance) { return shape.finest + shape.growth * distance; };
  const std::vector<double> steps = graded_steps(size);
  Polygon square;
  for (auto s = steps.begin(); s + 1 != steps.end(); ++s) square.push_back({*s, 0});
  for (auto s = steps.begin(); s + 1 != steps.end(); ++s) square.push_back({1, *s});
  for (auto s = steps.begin(); s + 1 != steps.end(); ++s) square.push_back({1 - *s, 1});
  for (auto s = steps.rbegin(); s + 1 != steps.rend(); ++s) square.push_back({0, *s});
  constexpr int kDarts = 20000;    // more than fit
  constexpr double kApart = 0.6;   // of the size: about as dense as darts get
  constexpr double kMargin = 0.3;  // from the fine sides: boundary points are not near enough to count
  std::vector<Vec2> inside;
  Rng rng(shape.seed);
  for (int i = 0; i < kDarts; ++i) {
    const double r = rng.uniform() * rng.uniform();
    const Vec2 p{r * rng.uniform(), r * rng.uniform()};
    const double wanted = size(length(p));
    if (p.x < kMargin * wanted || p.y < kMargin * wanted) continue;
    const auto near = [&](Vec2 q) { return length(p - q) < kApart * wanted; };
    if (std::any_of(square.begin(), square.end(), near) || std::any_of(inside.begin(), inside.end(), near)) continue;
    inside.push_back(p);
  }
  return mesh_of({square}, inside);
}

}  // namespace temper
