// Points and triangles in, a well-centered mesh out. Build with find_package(temper) and temper::solvers.
#include "temper/optimize.hpp"

#include <array>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "temper/quality.hpp"
#include "temper/solvers.hpp"

int main() {
  // The paper's sparse horseshoe: one interior vertex, four triangles, all of them bad.
  const std::vector<temper::Vec2> points = {{-2, 0}, {0, 2}, {2, 0}, {0, 4}, {0, 3}};
  const std::vector<std::array<std::int32_t, 3>> triangles = {{0, 1, 4}, {1, 2, 4}, {4, 2, 3}, {4, 3, 0}};

  auto built = temper::Mesh::build({.points = points, .triangles = triangles});
  if (!built) return std::fprintf(stderr, "%s\n", built.error().what().c_str()), 1;
  temper::Mesh& mesh = built->mesh;

  const auto show = [](const temper::Progress& progress) {
    std::printf("sweep %d: %zu triangles to go\n", progress.last.sweep, progress.last.bad);
    return temper::Continue::yes;  // Continue::no stops with the best mesh so far
  };
  const auto report = temper::optimize(mesh, {.max_sweeps = 100}, {.observer = show, .solvers = temper::solvers()});
  if (!report) return std::fprintf(stderr, "%s\n", report.error().what().c_str()), 1;

  const temper::Quality quality = temper::quality(mesh);
  std::printf("%d sweeps, %zu orthocenters outside, least h/l %.3f\n", report->sweeps, quality.orthocenters_outside,
              quality.min_h_over_l);
  for (const temper::VertexId v : mesh.vertices()) {
    std::printf("%zu: (%g, %g) weight %g\n", std::size_t{v.index}, mesh.position(v).x, mesh.position(v).y,
                mesh.weight(v));
  }
  return quality.well_centered_fraction == 1 ? 0 : 1;
}
