// The meshes of the paper: a single triangle (§3.1.2), the sparse (§6.4) and the parameterised horseshoe (§6.5).
#include <cmath>
#include <numbers>

#include "generate/outline.hpp"
#include "temper/generate.hpp"

namespace temper {
namespace {

using generate::invalid;

bool is_positive(double x) { return std::isfinite(x) && x > 0; }

/// cos and sin of π i / n, exactly symmetric about i = n/2, exact at both ends and in the middle: a foot that is
/// level and an axis that is at 0 are what the example means (cos(π/2) is 6e-17 in doubles).
Vec2 half_turn(int i, int n) {
  if (2 * i == n) return {0, 1};
  const int folded = 2 * i < n ? i : n - i;
  const double angle = std::numbers::pi * folded / n;
  const double cosine = folded == 0 ? 1 : std::cos(angle), sine = folded == 0 ? 0 : std::sin(angle);
  return {folded == i ? cosine : -cosine, sine};
}

}  // namespace

Mesh sparse_horseshoe() {
  constexpr std::array<Vec2, 5> kPoints = {{{-2, 0}, {0, 2}, {2, 0}, {0, 4}, {0, 3}}};
  constexpr std::array<std::array<std::int32_t, 3>, 4> kTriangles = {{{0, 1, 4}, {1, 2, 4}, {4, 2, 3}, {4, 3, 0}}};
  MeshInput input;
  input.points = kPoints;
  input.triangles = kTriangles;
  return Mesh::build(input)->mesh;
}

Expected<Mesh> horseshoe(const Horseshoe& shape) {
  if (shape.a < 3 || shape.b < 2) {
    return invalid("a horseshoe needs a ≥ 3 and b ≥ 2, not " + std::to_string(shape.a) + " and " +
                   std::to_string(shape.b));
  }
  if (!is_positive(shape.x[0]) || !is_positive(shape.y[0]) || !is_positive(shape.x[1] - shape.x[0]) ||
      !is_positive(shape.y[1] - shape.y[0])) {
    return invalid("a horseshoe needs 0 < x0 < x1 and 0 < y0 < y1");
  }
  generate::Outline outline;
  const auto number = [&](int i, int j) { return i * shape.b + j; };  // i-th value of a, j-th of b
  for (int i = 0; i < shape.a; ++i) {
    const Vec2 direction = half_turn(shape.a - 1 - i, shape.a - 1);
    for (int j = 0; j < shape.b; ++j) {
      const double b = static_cast<double>(j) / (shape.b - 1);
      outline.points.push_back({((1 - b) * shape.x[0] + b * shape.x[1]) * direction.x,
                                ((1 - b) * shape.y[0] + b * shape.y[1]) * direction.y});
    }
  }
  for (int i = 0; i + 1 < shape.a; ++i) {
    outline.segments.push_back({number(i, 0), number(i + 1, 0)});
    outline.segments.push_back({number(i, shape.b - 1), number(i + 1, shape.b - 1)});
  }
  for (int j = 0; j + 1 < shape.b; ++j) {
    outline.segments.push_back({number(0, j), number(0, j + 1)});
    outline.segments.push_back({number(shape.a - 1, j), number(shape.a - 1, j + 1)});
  }
  return outline.triangulate();
}

Expected<Mesh> single_triangle(const SingleTriangle& shape) {
  if (!is_positive(shape.a) || !is_positive(shape.b) || !(shape.angle_deg > 0 && shape.angle_deg < 180)) {
    return invalid("a triangle needs sides a, b > 0 and an angle between 0 and 180 degrees");
  }
  const double angle = shape.angle_deg * std::numbers::pi / 180;
  const std::array<Vec2, 3> points = {{{0, 0}, {shape.a, 0}, {shape.b * std::cos(angle), shape.b * std::sin(angle)}}};
  constexpr std::array<std::array<std::int32_t, 3>, 1> kTriangles = {{{0, 1, 2}}};
  MeshInput input;
  input.points = points;
  input.triangles = kTriangles;
  auto built = Mesh::build(input);
  if (!built) return built.error();
  return std::move(built->mesh);
}

}  // namespace temper
