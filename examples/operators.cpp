// Mesh in, operators out: a mesh from arrays, made for unknowns at vertices, and the matrix of −Δ from its stars. Build
// with find_package(temper) and temper::solvers.
#include <array>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "temper/dec.hpp"
#include "temper/optimize.hpp"
#include "temper/solvers.hpp"

namespace {

int fail(const std::string& error) { return std::fprintf(stderr, "%s\n", error.c_str()), 1; }

}  // namespace

int main() {
  // A strip of obtuse triangles: 5 by 3 points, each row shifted by 0.9.
  std::vector<temper::Vec2> points;
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 5; ++x) points.push_back({x + 0.9 * y, 1.0 * y});
  }
  for (std::int32_t y = 0; y < 2; ++y) {
    for (std::int32_t a = 5 * y; a < 5 * y + 4; ++a) {
      triangles.push_back({a, a + 1, a + 6});
      triangles.push_back({a, a + 6, a + 5});
    }
  }

  auto built = temper::Mesh::build({.points = points, .triangles = triangles});
  if (!built) return fail(built.error().what());
  temper::Mesh& mesh = built->mesh;

  auto options = temper::options_for("vertex");  // an Expected: a name that temper lacks is an error
  if (!options) return fail(options.error().what());
  const auto report = temper::optimize(mesh, *options, {.solvers = temper::solvers()});
  if (!report) return fail(report.error().what());

  const temper::DecComplex dual = temper::dec_operators(mesh);
  const temper::DecSummary summary = temper::summarize(mesh, dual);
  std::printf("%zu bad triangles, %zu negative coefficients\n", summary.not_well_centered,
              summary.negative_star1 + summary.negative_boundary_star1);

  // Row v of d0ᵀ ★1 d0, which is −Δ integrated over the dual cell of v: a coefficient for each neighbor.
  std::vector<double> diagonal(mesh.n_vertices(), 0.0);
  for (std::size_t e = 0; e < dual.edges.size(); ++e) {
    const temper::EdgeId edge(e);
    const temper::DecEdge& ends = dual.edges[edge];
    diagonal[ends.from.index] += dual.star1[edge];
    diagonal[ends.to.index] += dual.star1[edge];
  }
  std::printf("%zu edges, diagonal of vertex 7: %.3f, its cell: %.3f\n", dual.edges.size(), diagonal[7],
              dual.star0[temper::VertexId(7)]);
  return summary.negative_star1 + summary.negative_boundary_star1 == 0 ? 0 : 1;
}
