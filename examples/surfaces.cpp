// A curved surface in, a well-centered one near it out. Build with find_package(temper), and with temper::surfaces and
// temper::lp.
#include "temper/surfaces.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <vector>

#include "temper/detail/lp.hpp"

int main() {
  // A torus of trapezoids, each cut in two: in one half of them an angle is obtuse.
  constexpr int kAround = 48, kThrough = 20;
  std::vector<temper::Vec3> points;
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (int i = 0; i < kAround; ++i) {
    for (int j = 0; j < kThrough; ++j) {
      const double u = 2 * std::numbers::pi * i / kAround, v = 2 * std::numbers::pi * j / kThrough;
      const double away = 1 + 0.4 * std::cos(v);
      points.push_back({away * std::cos(u), away * std::sin(u), 0.4 * std::sin(v)});
      const int next = (i + 1) % kAround * kThrough, up = (j + 1) % kThrough;
      const int a = i * kThrough + j, b = next + j, c = next + up, d = i * kThrough + up;
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
  }
  auto built = temper::surfaces::SurfaceMesh::build({.points = points, .triangles = triangles});
  if (!built) return std::fprintf(stderr, "%s\n", built.error().what().c_str()), 1;
  temper::surfaces::SurfaceMesh& mesh = built->mesh;

  const auto report = temper::surfaces::optimize(mesh, *temper::clp_solver());
  if (!report) return std::fprintf(stderr, "%s\n", report.error().what().c_str()), 1;
  std::printf("%zu bad triangles before, %zu after; distance %.2f %% of the diagonal\n", report->violations_before,
              report->violations_after, 100 * report->surface_distance / report->diagonal);

  const temper::DecComplex dual = temper::surfaces::dec_operators(mesh);
  std::size_t negative = 0;
  for (const double coefficient : dual.star1) negative += coefficient < 0 ? 1 : 0;
  std::printf("%zu of %zu coefficients are negative\n", negative, dual.star1.size());
  return report->violations_after + negative == 0 ? 0 : 1;
}
