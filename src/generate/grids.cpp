// Structured examples: a sheared grid cut along its long diagonals, and an annulus of turned and jittered rings.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/rng.hpp"
#include "generate/outline.hpp"
#include "generate/triangulation.hpp"
#include "temper/generate.hpp"
#include "temper/regularity.hpp"

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
  points.reserve(static_cast<std::size_t>(n));
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
  // Middle rings lie inside the outer polygon, whose sides come nearer to the center than its corners.
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

// Meshes of periodic planes. A Delaunay triangulation of points and enough of their images keeps one image of each
// triangle. Rows of hexagons are made directly.

namespace {

using generate::invalid;
using Corners = std::array<std::int32_t, 3>;

// Images this many mean spacings around the domain: among random points hardly a circle reaches farther.
constexpr double kUsualReach = 8;
constexpr std::size_t kMostPeriodicVertices = 500'000'000;

bool are_periods(Vec2 period) {
  return std::isfinite(period.x) && std::isfinite(period.y) && period.x > 0 && period.y > 0;
}

/// Points of the domain, then their images up to `reach` around it, and the number of each image's point.
struct Images {
  std::vector<Vec2> points;
  std::vector<std::uint32_t> of;
};
Images images_around(const std::vector<Vec2>& points, Vec2 period, double reach) {
  Images images{points, {}};
  for (std::size_t i = 0; i < points.size(); ++i) images.of.push_back(static_cast<std::uint32_t>(i));
  const auto is_near = [reach](double x, double length) { return x >= -reach && x <= length + reach; };
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    for (int m = -1; m <= 1; ++m) {
      for (int n = -1; n <= 1; ++n) {
        const Vec2 p = {points[i].x + m * period.x, points[i].y + n * period.y};
        if ((m == 0 && n == 0) || !is_near(p.x, period.x) || !is_near(p.y, period.y)) continue;
        images.points.push_back(p);
        images.of.push_back(i);
      }
    }
  }
  return images;
}

/// Keeps the image of each triangle whose corner of least number is in the domain.
std::vector<Corners> triangles_of_domain(const generate::Triangulation& all, const std::vector<std::uint32_t>& of) {
  const std::size_t n = of.size();
  std::vector<Corners> triangles;
  for (const TriangleId t : all.mesh.triangles()) {
    const auto corners = all.mesh.corners(t);
    Corners points{};
    std::uint32_t least = static_cast<std::uint32_t>(n), place = least;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t number = all.number[corners[k].index];
      points[k] = static_cast<std::int32_t>(of[number]);
      if (of[number] < least) least = of[number], place = number;
    }
    if (place == least) triangles.push_back(points);
  }
  return triangles;
}

}  // namespace

Expected<Mesh> periodic_delaunay(std::span<const Vec2> points, Vec2 period) {
  if (points.empty()) return InputError{ErrorCode::empty_input, "", "a triangulation needs points"};
  if (!are_periods(period)) return invalid("the periods of a plane must be finite and positive");
  MeshInput input;
  input.space = Space::periodic(period);
  std::vector<Vec2> inside;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!std::isfinite(points[i].x) || !std::isfinite(points[i].y)) {
      return InputError{ErrorCode::not_finite, "", "point " + std::to_string(i) + " is not finite"};
    }
    inside.push_back(input.space.in_domain({points[i].x, points[i].y, 0}).position());
  }
  input.points = inside;
  period = input.space.period();
  const double whole = std::max(period.x, period.y);
  double reach = kUsualReach * std::sqrt(period.x * period.y / static_cast<double>(points.size()));
  for (;; reach *= 4) {
    const Images images = images_around(inside, period, reach);
    const auto all = generate::triangulate_points(images.points);
    if (!all) return all.error();
    const std::vector<Corners> triangles = triangles_of_domain(*all, images.of);
    input.triangles = triangles;
    auto built = Mesh::build(input);
    if (!built && reach < whole) continue;
    if (!built) return built.error();
    restore_regularity(built->mesh, HiddenPolicy::keep);
    return std::move(built->mesh);
  }
}

Expected<Mesh> random_periodic(const RandomPeriodic& shape) {
  if (shape.vertices < 16) return invalid("a periodic mesh of random points needs 16 vertices or more");
  if (shape.vertices > kMostPeriodicVertices) return invalid("more than 500,000,000 vertices are out of reach");
  if (!are_periods(shape.period)) return invalid("the periods of a plane must be finite and positive");
  Rng rng(shape.seed);
  std::vector<Vec2> points;
  while (points.size() < shape.vertices) {
    const double x = rng.uniform(0, shape.period.x), y = rng.uniform(0, shape.period.y);
    points.push_back({x, y});
  }
  return periodic_delaunay(points, shape.period);
}

Expected<Mesh> periodic_hexagons(const PeriodicHexagons& shape) {
  const bool wraps = !shape.channel;
  if (shape.nx < 3 || shape.ny < (wraps ? 4 : 2)) {
    return invalid("rows of hexagons need 3 of them and 4 rows or more, in a channel 2 rows");
  }
  if (wraps && shape.ny % 2 != 0) return invalid("an even number of rows of hexagons fits into a period");
  if (1.0 * shape.nx * shape.ny > static_cast<double>(kMostPeriodicVertices)) {
    return invalid("more than 500,000,000 vertices are out of reach");
  }
  if (!(shape.distance > 0) || !std::isfinite(shape.distance)) return invalid("the distance of hexagons is positive");
  const double rise = 0.5 * std::numbers::sqrt3 * shape.distance;
  std::vector<Vec2> points;
  std::vector<Corners> triangles;
  const auto at = [&](int i, int j) { return (j % shape.ny) * shape.nx + i % shape.nx; };
  for (int j = 0; j < shape.ny; ++j) {
    const int lean = j % 2;  // odd rows are half a distance to the right
    for (int i = 0; i < shape.nx; ++i) {
      points.push_back({(i + 0.5 * lean) * shape.distance, j * rise});
      if (!wraps && j + 1 == shape.ny) continue;
      triangles.push_back({at(i, j), at(i + 1, j), at(i + lean, j + 1)});
      triangles.push_back({at(i + 1, j), at(i + 1 + lean, j + 1), at(i + lean, j + 1)});
    }
  }
  MeshInput input;
  input.space = Space::periodic({shape.nx * shape.distance, wraps ? shape.ny * rise : 0});
  input.points = points;
  input.triangles = triangles;
  auto built = Mesh::build(input);
  if (!built) return built.error();
  return std::move(built->mesh);
}

}  // namespace temper
