// Numbers of single triangles.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "quality/measure.hpp"
#include "temper/geometry.hpp"
#include "temper/quality.hpp"

namespace temper {
namespace {

/// Calls f(a, b, c) for each edge ab, with the corner c opposite.
template <class F>
void for_edges(const Mesh& mesh, TriangleId t, F&& f) {
  const auto [a, b, c] = mesh.points(t);
  f(a, b, c);
  f(b, c, a);
  f(c, a, b);
}

double least_margin(const Mesh& mesh, TriangleId t) {
  if (!mesh.space().is_plane()) return measure_triangle(mesh, t).margin();
  const auto [p, q, r] = mesh.points(t);
  double least = std::numeric_limits<double>::infinity();
  if (orient2d(p.position(), q.position(), r.position()) != Sign::positive) return -least;
  for_edges(mesh, t, [&](const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c) {
    const double l = length(b.position() - a.position()), d = edge_split(a, b) / l;
    least = std::min({least, signed_height(a, b, c) / l, d, 1 - d});
  });
  return least;
}

double largest_angle(const Mesh& mesh, TriangleId t) {
  if (!mesh.space().is_plane()) {
    const auto angles = measure_triangle(mesh, t).angle_deg;
    return *std::max_element(angles.begin(), angles.end());
  }
  double largest = 0;
  for_edges(mesh, t, [&](const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c) {
    const Vec2 u = a.position() - c.position(), v = b.position() - c.position();
    largest = std::max(largest, std::abs(std::atan2(u.x * v.y - u.y * v.x, u.x * v.x + u.y * v.y)));
  });
  return largest * 180 / std::numbers::pi;
}

double mean_edge(const Mesh& mesh, TriangleId t) {
  double sum = 0;
  if (!mesh.space().is_plane()) {
    for_edges(mesh, t, [&](const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint&) {
      sum += mesh.space().radius() * arc_length(lifted(a), lifted(b));
    });
    return sum / 3;
  }
  for_edges(mesh, t, [&](const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint&) {
    sum += length(b.position() - a.position());
  });
  return sum / 3;
}

template <class T>
T least(const std::array<T, 3>& of) {
  return *std::min_element(of.begin(), of.end());
}

TriangleQuality summary(const TriangleMeasure& m) {
  return {m.well_centered(), least(m.h_over_l), least(m.d_over_l), least(m.angle_deg)};
}

double region(const Mesh& mesh, TriangleId t) { return mesh.region(t); }

}  // namespace

TriangleQuality triangle_quality(const Mesh& mesh, TriangleId t) { return summary(measure_triangle(mesh, t)); }

TriangleQuality triangle_quality(const Space& space, const std::array<WeightedPoint, 3>& corners) {
  return summary(measure_triangle(space, corners));
}

std::span<const TriangleValue> triangle_values() {
  static constexpr auto kValues = std::to_array<TriangleValue>({
      {"quality", "least of h/ℓ, d/ℓ, 1 − d/ℓ", least_margin},
      {"angle", "largest angle (degrees)", largest_angle},
      {"size", "mean length of edges", mean_edge},
      {"region", "region", region},
  });
  return kValues;
}

}  // namespace temper
