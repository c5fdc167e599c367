// Numbers of single triangles.
#include <algorithm>
#include <array>
#include <numbers>

#include "quality/measure.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/quality.hpp"

namespace temper {
namespace {

double least_margin(const Mesh& mesh, TriangleId t) { return measure_triangle(mesh, t).margin(); }

double largest_angle(const Mesh& mesh, TriangleId t) {
  const auto [a, b, c] = mesh.points(t);
  const Space& space = mesh.space();
  const double angle =
      std::max({corner_angle(space, a, b, c), corner_angle(space, b, c, a), corner_angle(space, c, a, b)});
  return angle * 180 / std::numbers::pi;
}

double mean_edge(const Mesh& mesh, TriangleId t) {
  const auto [a, b, c] = mesh.points(t);
  return (distance(mesh.space(), a, b) + distance(mesh.space(), b, c) + distance(mesh.space(), c, a)) / 3;
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
