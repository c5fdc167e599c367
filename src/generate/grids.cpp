// Structured examples: a sheared grid cut along its long diagonals, and an annulus of turned and jittered rings.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/rng.hpp"
#include "generate/outline.hpp"
#include "temper/generate.hpp"

namespace temper {
namespace {

using generate::invalid;

constexpr double kMostVertices = 5e8;  // corner numbers are 32 bits, and there are three a triangle

Vec2 on_circle(double radius, double turn) {
  const double angle = 2 * std::numbers::pi * turn;
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

std::vector<Vec2> ring(double radius, int n) {
  std::vector<Vec2> points;
  for (int i = 0; i < n; ++i) points.push_back(on_circle(radius, static_cast<double>(i) / n));
  return points;
}

}  // namespace

Expected<Mesh> sheared_grid(const ShearedGrid& shape) {
  if (shape.nx < 1 || shape.ny < 1) return invalid("a grid needs nx ≥ 1 and ny ≥ 1");
  if ((shape.nx + 1.0) * (shape.ny + 1.0) > kMostVertices)
    return invalid("more than 500,000,000 vertices are out of reach");
  if (!std::isfinite(shape.shear)) return invalid("the shear of a grid must be finite");
  std::vector<Vec2> points;
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (int j = 0; j <= shape.ny; ++j) {
    for (int i = 0; i <= shape.nx; ++i) points.push_back({i + shape.shear * j, static_cast<double>(j)});
  }
  for (int j = 0; j < shape.ny; ++j) {
    for (int i = 0; i < shape.nx; ++i) {
      const int a = j * (shape.nx + 1) + i, b = a + 1, d = a + shape.nx + 1, c = d + 1;
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
  }
  MeshInput input;
  input.points = points;
  input.triangles = triangles;
  auto built = Mesh::build(input);
  if (!built) return built.error();
  return std::move(built->mesh);
}

Expected<Mesh> annulus(const Annulus& shape) {
  if (shape.around < 3 || shape.rings < 2) return invalid("an annulus needs around ≥ 3 and rings ≥ 2");
  if (1.0 * shape.around * shape.rings > kMostVertices)
    return invalid("more than 500,000,000 vertices are out of reach");
  if (!(shape.jitter >= 0 && shape.jitter <= 1)) return invalid("the jitter of an annulus is between 0 and 1");
  // Middle rings lie inside the outer polygon, whose sides come nearer to the centre than its corners.
  const double apothem = shape.outer * std::cos(std::numbers::pi / shape.around);
  if (!(shape.inner > 0 && shape.inner < apothem && std::isfinite(shape.outer))) {
    return invalid("an annulus of " + std::to_string(shape.around) +
                   " points around needs 0 < inner < outer, with room for the sides of the outer polygon");
  }
  Rng rng(shape.seed);
  generate::Outline outline;
  outline.add_loop(ring(shape.outer, shape.around));
  outline.add_loop(ring(shape.inner, shape.around));
  const double gap = (apothem - shape.inner) / (shape.rings - 1);
  for (int r = 1; r + 1 < shape.rings; ++r) {
    const double radius = shape.inner + gap * r;
    // Half of the smaller spacing: a point never leaves its own cell of the polar grid.
    const double reach = 0.45 * shape.jitter * std::min(gap, 2 * std::numbers::pi * radius / shape.around);
    const double phase = rng.uniform();
    for (int i = 0; i < shape.around; ++i) {
      const double turn = (i + phase) / shape.around;
      const double x = rng.uniform(-1, 1), y = rng.uniform(-1, 1);
      outline.points.push_back(on_circle(radius + reach * x, turn + reach * y / (2 * std::numbers::pi * radius)));
    }
  }
  return outline.triangulate();
}

}  // namespace temper
