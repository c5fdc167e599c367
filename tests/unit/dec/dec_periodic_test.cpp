// Laws of the operators in periodic planes: sums, kernels, eigenfunctions, and that nothing knows where the domain
// begins.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "support/lattice.hpp"
#include "temper/dec.hpp"
#include "temper/generate.hpp"

namespace temper {
namespace {

/// Random weights of the size of edges: triangles that are not well-centered, edges that are not regular.
Mesh rough_torus(std::uint64_t seed, Vec2 period = {1, 1.5}) {
  Mesh mesh = *random_periodic({300, seed, period});
  test::Noise noise(seed);
  for (const VertexId v : mesh.vertices()) mesh.set_weight(v, 0.002 * noise());
  return mesh;
}

template <class Values>
double total_of(const Values& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(DecPeriodic, CellsAndTrianglesCoverTheDomain) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    const Mesh mesh = rough_torus(seed);
    const DecComplex c = dec_operators(mesh);
    EXPECT_GT(summarize(mesh, c).negative_star1, 0U);
    EXPECT_EQ(mesh.n_vertices() + mesh.n_triangles(), c.edges.size());  // Euler's number is 0
    EXPECT_NEAR(total_of(c.areas), 1.5, 1e-12);
    EXPECT_NEAR(total_of(c.star0), 1.5, 1e-12);
    EXPECT_NEAR(total_of(power_cells(mesh, c).areas), 1.5, 1e-12);
  }
}

TEST(DecPeriodic, CellsOfAWellCenteredMeshAreStar0) {
  const Mesh mesh = *periodic_hexagons({.nx = 7, .ny = 6, .distance = 2});
  const DecComplex c = dec_operators(mesh);
  const PowerCells cells = power_cells(mesh, c);
  EXPECT_EQ(cells.faces.size(), c.edges.size());
  for (const VertexId v : mesh.vertices()) {
    EXPECT_NEAR(c.star0[v], 2 * std::sqrt(3.0), 1e-12);
    EXPECT_NEAR(cells.areas[v], c.star0[v], 1e-12);
  }
  for (const double ratio : c.star1) EXPECT_NEAR(ratio, 1 / std::sqrt(3.0), 1e-12);
}

// Rows of the Laplacian of hexagons are those of the six neighbors: Fourier modes are its eigenfunctions exactly.
TEST(DecPeriodic, FourierModesAreEigenfunctionsOfHexagons) {
  const Mesh mesh = *periodic_hexagons({.nx = 12, .ny = 10});
  const DecComplex c = dec_operators(mesh);
  const Vec2 period = mesh.space().period();
  for (const Vec2 waves : {Vec2{1, 0}, Vec2{0, 1}, Vec2{2, -1}, Vec2{3, 2}}) {
    const Vec2 k = {2 * std::numbers::pi * waves.x / period.x, 2 * std::numbers::pi * waves.y / period.y};
    const auto mode = [&](VertexId v) { return std::sin(dot(k, mesh.position(v)) + 0.3); };
    double eigenvalue = 0;
    for (int i = 0; i < 6; ++i) {
      const double turn = std::numbers::pi * i / 3;
      eigenvalue += (1 - std::cos(k.x * std::cos(turn) + k.y * std::sin(turn))) / std::sqrt(3.0);
    }
    IdVector<VertexId, double> image(mesh.n_vertices(), 0.0);
    for (std::size_t i = 0; i < c.edges.size(); ++i) {
      const DecEdge& e = c.edges[EdgeId(i)];
      const double flow = c.star1[EdgeId(i)] * (mode(e.from) - mode(e.to));
      image[e.from] += flow;
      image[e.to] -= flow;
    }
    for (const VertexId v : mesh.vertices()) EXPECT_NEAR(image[v], eigenvalue * mode(v), 1e-12);
  }
}

TEST(DecPeriodic, TranslationsChangeNothing) {
  const Mesh mesh = rough_torus(6);
  Mesh moved = mesh;
  for (const VertexId v : mesh.vertices()) {
    const WeightedPoint p = mesh.point(v);
    moved.set_point(v, mesh.space().in_domain({p.x + 0.375, p.y + 1.25, p.w}));
  }
  const DecComplex a = dec_operators(mesh), b = dec_operators(moved);
  for (std::size_t i = 0; i < a.edges.size(); ++i) EXPECT_EQ(a.star1[EdgeId(i)], b.star1[EdgeId(i)]);
  for (const VertexId v : mesh.vertices()) EXPECT_EQ(a.star0[v], b.star0[v]);
}

}  // namespace
}  // namespace temper
