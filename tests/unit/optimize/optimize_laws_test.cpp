// Laws that hold for every optimization of every mesh.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "energy/patch.hpp"
#include "support/lattice.hpp"
#include "support/shapes.hpp"
#include "temper/generate.hpp"
#include "temper/optimize.hpp"
#include "temper/quality.hpp"
#include "temper/regularity.hpp"

namespace temper::test {
namespace {

bool same_bits(Vec2 a, Vec2 b) { return std::memcmp(&a, &b, sizeof a) == 0; }

/// Invariants: orientation, boundary and fixed vertices, constrained edges, regularity, no vertex lost.
void expect_invariants(const Mesh& before, const Mesh& after) {
  EXPECT_EQ(after.validate(), std::nullopt);
  ASSERT_EQ(after.n_vertices(), before.n_vertices());
  ASSERT_EQ(after.n_triangles(), before.n_triangles());
  for (const VertexId v : before.vertices()) {
    EXPECT_EQ(after.is_boundary(v), before.is_boundary(v));
    EXPECT_EQ(after.is_fixed(v), before.is_fixed(v));
    if (before.is_boundary(v) || before.is_fixed(v)) {
      EXPECT_TRUE(same_bits(before.position(v), after.position(v))) << "vertex " << v.index << " moved";
    }
  }
  for (const HalfedgeId h : before.halfedges()) {
    if (!before.is_boundary(h) && !before.is_constrained(h)) continue;
    HalfedgeId kept = after.find_halfedge(before.origin(h), before.target(h));
    ASSERT_TRUE(kept.valid()) << "edge " << before.origin(h).index << "-" << before.target(h).index << " is gone";
    EXPECT_EQ(after.is_boundary(kept), before.is_boundary(h));
    EXPECT_EQ(after.is_constrained(kept), before.is_constrained(h));
    EXPECT_EQ(after.region(Mesh::triangle(kept)), before.region(Mesh::triangle(h)));
  }
  EXPECT_EQ(count_non_regular_edges(after, false), 0u);
}

TEST(Optimize, MakesAJitteredLatticeWellCentered) {
  Mesh mesh = lattice({.n = 12, .jitter = 0.3, .weight = 0});
  const Mesh before = mesh;
  ASSERT_LT(quality(mesh).well_centered_fraction, 0.9);
  const auto report = optimize(mesh);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->stopped, Stopped::converged);
  EXPECT_EQ(report->history.back().bad, 0u);
  EXPECT_EQ(quality(mesh).well_centered_fraction, 1);
  EXPECT_LT(report->objective_after, report->objective_before);
  expect_invariants(before, mesh);
}

TEST(Optimize, KeepsInvariantsOnRandomMeshesWithRegionsAndFixedVertices) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Mesh mesh = mesh_with_regions(150, seed);
    Noise noise(seed);
    for (const VertexId v : mesh.vertices()) {
      if (noise() > 0.9) mesh.set_fixed(v, true);
    }
    const Mesh before = mesh;
    const auto report = optimize(mesh, {.max_sweeps = 30});
    ASSERT_TRUE(report) << report.error().what();
    EXPECT_LE(report->history.back().bad, report->history.front().bad);
    expect_invariants(before, mesh);
  }
}

TEST(Optimize, EnergyOfABarrierFallsInEverySweepAtOneGamma) {
  Mesh mesh = lattice({.n = 10, .jitter = 0.3, .weight = 0});
  const auto report = optimize(mesh, {.paper = {.gamma = LengthParameter{0.05}, .tolerance = 1e-12}});
  ASSERT_TRUE(report);
  ASSERT_GT(report->history.size(), 5u);
  for (std::size_t i = 1; i < report->history.size(); ++i) {
    EXPECT_LE(report->history[i].energy, report->history[i - 1].energy * (1 + 1e-14));
  }
}

TEST(Optimize, IsStationaryWhenConverged) {
  Mesh mesh = lattice({.n = 8, .jitter = 0.2, .weight = 0});
  const LengthParameter gamma{0.05};
  ASSERT_TRUE(optimize(mesh, {.max_sweeps = 5000, .paper = {.gamma = gamma, .tolerance = 0}}));
  const EnergyModel model{.kind = EnergyKind::BP, .gamma = gamma};
  const double total = total_energy(mesh, model);
  int free = 0;
  for (const VertexId v : mesh.vertices()) {
    const VertexDerivatives d = vertex_energy(mesh, model, v);
    EXPECT_LT(std::abs(d.gradient[2]), 1e-6 * total);
    if (mesh.is_boundary(v)) continue;
    EXPECT_LT(std::abs(d.gradient[0]) + std::abs(d.gradient[1]), 1e-6 * total);
    ++free;
  }
  EXPECT_GT(free, 10);
}

TEST(Optimize, AgainChangesLittle) {
  Mesh mesh = lattice({.n = 10, .jitter = 0.3, .weight = 0});
  ASSERT_TRUE(optimize(mesh, {.paper = {.tolerance = 1e-10}}));
  const auto again = optimize(mesh, {.paper = {.tolerance = 1e-6}});
  ASSERT_TRUE(again);
  EXPECT_LE(again->sweeps, 2);
  EXPECT_LE(again->objective_after, again->objective_before);
  EXPECT_EQ(again->history.back().bad, 0u);
}

TEST(Optimize, GivesTheSameBytesTwiceAndForAnyExecutor) {
  class Backwards final : public Executor {
   public:
    void run(std::size_t n, const std::function<void(std::size_t)>& block) override {
      for (std::size_t i = n; i > 0; --i) block(i - 1);
    }
  } backwards;
  const auto made = random_mesh({.vertices = 3000, .seed = 4});
  ASSERT_TRUE(made);
  Mesh first = *made, second = *made, third = *made;
  ASSERT_TRUE(optimize(first, {.max_sweeps = 20}));
  ASSERT_TRUE(optimize(second, {.max_sweeps = 20}));
  ASSERT_TRUE(optimize(third, {.max_sweeps = 20}, {.executor = &backwards}));
  EXPECT_EQ(first, second);
  EXPECT_EQ(first, third);
}

TEST(Optimize, CommutesWithScalingByPowersOfTwo) {
  const LatticeOptions unit{.n = 8, .jitter = 0.3, .weight = 0};
  for (const double scale : {0x1p20, 0x1p-180}) {
    LatticeOptions scaled = unit;
    scaled.scale = scale;
    for (const EnergyInfo& info : energies()) {
      if (info.is_hard()) continue;  // the lattice is outside its barrier
      Mesh a = lattice(unit), b = lattice(scaled);
      ASSERT_TRUE(optimize(a, {.energy = info.kind, .max_sweeps = 10}));
      ASSERT_TRUE(optimize(b, {.energy = info.kind, .max_sweeps = 10}));
      for (const VertexId v : a.vertices()) {
        EXPECT_EQ(scale * a.position(v).x, b.position(v).x) << info.name;
        EXPECT_EQ(scale * a.position(v).y, b.position(v).y) << info.name;
        EXPECT_EQ(scale * scale * a.weight(v), b.weight(v)) << info.name;
      }
    }
  }
}

class Elsewhere : public testing::TestWithParam<LatticeOptions> {};

TEST_P(Elsewhere, WorksAndKeepsTheBoundaryBitForBit) {
  Mesh mesh = lattice(GetParam());
  const Mesh before = mesh;
  const auto report = optimize(mesh);
  ASSERT_TRUE(report);
  EXPECT_GT(report->history.front().bad, 0u);
  EXPECT_EQ(report->history.back().bad, 0u);
  EXPECT_EQ(quality(mesh).well_centered_fraction, 1);  // in the user's coordinates, after all rounding
  expect_invariants(before, mesh);
}

INSTANTIATE_TEST_SUITE_P(
    Scales, Elsewhere,
    testing::Values(LatticeOptions{.n = 10, .jitter = 0.3, .weight = 0, .offset = {1e6, -2e6}},
                    LatticeOptions{.n = 10, .jitter = 0.3, .weight = 0, .offset = {1e9, 1e9}},
                    LatticeOptions{.n = 10, .jitter = 0.3, .weight = 0, .scale = 1e-12},
                    LatticeOptions{.n = 10, .jitter = 0.3, .weight = 0, .scale = 1e12},
                    LatticeOptions{.n = 10, .jitter = 0.3, .weight = 0, .scale = 1e-3, .offset = {5e5, 5e5}}));

TEST(Optimize, DoesNotDependOnTheUsersNumbering) {
  // Vertices and triangles in reverse: the same mesh up to names, so the same result up to names and rounding.
  Mesh mesh = lattice({.n = 8, .jitter = 0.3, .weight = 0});
  std::vector<Vec2> points;
  std::vector<std::array<std::int32_t, 3>> triangles;
  const auto n = static_cast<std::int32_t>(mesh.n_vertices());
  for (const VertexId v : mesh.vertices()) points.push_back(mesh.position(v));
  std::reverse(points.begin(), points.end());
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    triangles.push_back({n - 1 - std::int32_t(a.index), n - 1 - std::int32_t(b.index), n - 1 - std::int32_t(c.index)});
  }
  std::reverse(triangles.begin(), triangles.end());
  Mesh reversed = Mesh::build({.points = points, .triangles = triangles})->mesh;
  ASSERT_TRUE(optimize(mesh, {.max_sweeps = 12}));
  ASSERT_TRUE(optimize(reversed, {.max_sweeps = 12}));
  for (const VertexId v : mesh.vertices()) {
    const VertexId u(mesh.n_vertices() - 1 - v.index);
    EXPECT_NEAR(mesh.position(v).x, reversed.position(u).x, 1e-9);
    EXPECT_NEAR(mesh.position(v).y, reversed.position(u).y, 1e-9);
    EXPECT_NEAR(mesh.weight(v), reversed.weight(u), 1e-9);
  }
}

TEST(Optimize, OfAMeshWithoutInteriorVerticesMovesWeightsOnly) {
  // A fan-free hexagon: four triangles, six boundary vertices.
  std::vector<Vec2> points;
  for (int i = 0; i < 6; ++i)
    points.push_back({std::cos(i * std::numbers::pi / 3) * (i % 2 ? 1 : 0.8), std::sin(i * std::numbers::pi / 3)});
  const std::vector<std::array<std::int32_t, 3>> triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}};
  Mesh mesh = Mesh::build({.points = points, .triangles = triangles})->mesh;
  const Mesh before = mesh;
  const auto report = optimize(mesh);
  ASSERT_TRUE(report);
  EXPECT_LE(report->history.back().bad, report->history.front().bad);
  expect_invariants(before, mesh);
}

TEST(Optimize, BringsWeightsThatViolateEdgesIntoTheBarriersDomain) {
  // A few heavy vertices: their neighbors have power cells, but lie outside of them.
  Mesh mesh = lattice({.n = 8, .jitter = 0.1, .weight = 0});
  for (const VertexId v : mesh.vertices()) {
    if (v.index % 3 == 1 && (v.index / 8) % 3 == 1) mesh.set_weight(v, 1.3);
  }
  const EnergyModel model{.kind = EnergyKind::BP};
  ASSERT_TRUE(std::isinf(total_energy(mesh, model)));
  const auto report = optimize(mesh);
  ASSERT_TRUE(report) << report.error().what();
  EXPECT_TRUE(std::isfinite(report->objective_after));
  EXPECT_EQ(report->history.back().bad, 0u);
}

}  // namespace
}  // namespace temper::test
