// Optimization of periodic planes: the guarantees of the plane, and the special laws of periods.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesh/bad_triangles.hpp"
#include "temper/detail/trace.hpp"
#include "temper/generate.hpp"
#include "temper/optimize.hpp"
#include "temper/quality.hpp"
#include "temper/regularity.hpp"

namespace temper {
namespace {

Mesh torus(std::size_t vertices, std::uint64_t seed, Vec2 period = {1, 1}) {
  const auto mesh = random_periodic({vertices, seed, period});
  EXPECT_TRUE(mesh) << mesh.error().what();
  return *mesh;
}

OptimizeReport optimized_periodic(Mesh& mesh, const OptimizeOptions& options = {}, const OptimizeHooks& hooks = {}) {
  auto report = optimize(mesh, options, hooks);
  EXPECT_TRUE(report) << report.error().what();
  return *std::move(report);
}

void expect_all_well_centered(const Mesh& mesh) {
  EXPECT_FALSE(mesh.validate());
  EXPECT_TRUE(bad_triangles(mesh).empty());
  EXPECT_EQ(count_non_regular_edges(mesh), 0U);
}

/// Moves all vertices by `shift`, which is on the grid of the period.
Mesh shifted(const Mesh& mesh, Vec2 shift) {
  Mesh result = mesh;
  for (const VertexId v : mesh.vertices()) {
    const WeightedPoint p = mesh.point(v);
    result.set_point(v, mesh.space().in_domain({p.x + shift.x, p.y + shift.y, p.w}));
  }
  return result;
}

TEST(PeriodicOptimize, RandomPointsBecomeWellCentered) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) {
    Mesh mesh = torus(seed < 5 ? 120 : 1000, seed, {1, seed % 2 == 0 ? 1.0 : 0.6});
    ASSERT_GT(bad_triangles(mesh).size(), mesh.n_triangles() / 4);
    optimized_periodic(mesh, {.objective = Objective::energy});
    expect_all_well_centered(mesh);
    EXPECT_EQ(mesh.n_vertices() + mesh.n_triangles(), mesh.n_edges());
  }
}

TEST(PeriodicOptimize, AFewVerticesAroundAPeriodDo) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6, 7, 8, 9}) {
    const auto mesh = random_periodic({24, seed, {1, 1}});
    if (!mesh) continue;  // too sparse for triangles of half a period
    Mesh improved = *mesh;
    optimized_periodic(improved);
    EXPECT_FALSE(improved.validate());
    EXPECT_LE(bad_triangles(improved).size(), bad_triangles(*mesh).size());
  }
}

TEST(PeriodicOptimize, TheAccuracyObjectiveLowersItsEnergyAndKeepsItsMargin) {
  for (const std::size_t vertices : {200U, 1500U}) {
    Mesh mesh = torus(vertices, 5);
    const OptimizeReport report = optimized_periodic(mesh, {.objective = Objective::accuracy, .scheme = Scheme::stars});
    expect_all_well_centered(mesh);
    EXPECT_LT(report.objective_after, 0.35 * report.objective_before);
    const Quality q = quality(mesh);
    EXPECT_GT(q.min_h_over_l, 0.02);
    EXPECT_GT(q.min_d_over_l, 0.02);
  }
}

TEST(PeriodicOptimize, ShoresOfAChannelStayWhereTheyAre) {
  auto made = periodic_hexagons({.nx = 24, .ny = 12, .channel = true});
  ASSERT_TRUE(made) << made.error().what();
  Mesh before = *made;
  for (const VertexId v : before.vertices()) {
    const WeightedPoint p = before.point(v);
    const double turn = 2.4 * v.index;
    if (!before.is_boundary(v)) before.set_point(v, {p.x + 0.3 * std::cos(turn), p.y + 0.3 * std::sin(turn), 0});
  }
  ASSERT_FALSE(before.validate());
  ASSERT_FALSE(bad_triangles(before).empty());
  Mesh mesh = before;
  optimized_periodic(mesh);
  expect_all_well_centered(mesh);
  for (const VertexId v : before.vertices()) {
    if (!before.is_boundary(v)) continue;
    EXPECT_EQ(mesh.point(v).position(), before.point(v).position());
  }
}

// The usual order of a sweep follows a curve over the domain. The order of the input does not depend on the place of
// the domain.
TEST(PeriodicOptimize, TranslationsChangeNothingButRounding) {
  Mesh before = torus(300, 4);
  optimized_periodic(before, {.unknowns = Unknowns::positions});
  for (const Vec2 shift : {Vec2{0.5, 0}, Vec2{0.328125, 0.84375}}) {
    Mesh here = before, there = shifted(before, shift);
    OptimizeOptions o;
    o.paper.order = SweepOrder::input;
    o.max_sweeps = 4;
    o.repair = Repair::none;
    const OptimizeReport a = optimized_periodic(here, o), b = optimized_periodic(there, o);
    EXPECT_EQ(a.sweeps, b.sweeps);
    double farthest = 0;
    for (const VertexId v : here.vertices()) {
      const WeightedPoint p = shifted(here, shift).point(v), q = there.point(v, p);
      farthest = std::max({farthest, std::abs(p.x - q.x), std::abs(p.y - q.y)});
    }
    EXPECT_LT(farthest, 1e-10);
    EXPECT_GT(length(here.point(VertexId(0)).position() - before.point(VertexId(0)).position()), 1e-6);
  }
}

TEST(PeriodicOptimize, ResultsAreInTheDomain) {
  Mesh mesh = torus(400, 6, {3, 0.7});
  optimized_periodic(mesh);
  for (const VertexId v : mesh.vertices()) EXPECT_EQ(mesh.space().in_domain(mesh.point(v)), mesh.point(v));
}

TEST(PeriodicOptimize, EveryEnergyAndSolverKeepsTheMeshRegular) {
  Mesh before = torus(120, 5);
  optimized_periodic(before, {.unknowns = Unknowns::positions});
  for (const EnergyInfo& energy : energies()) {
    for (const Solver solver : {Solver::newton, Solver::alternating, Solver::golden}) {
      OptimizeOptions o;
      o.energy = energy.kind;
      if (energy.positions_alone) o.unknowns = Unknowns::positions;
      o.paper.solver = solver;
      o.max_sweeps = 5;
      Mesh mesh = before;
      const OptimizeReport report = optimized_periodic(mesh, o);
      SCOPED_TRACE(std::string(energy.name));
      EXPECT_FALSE(mesh.validate());
      EXPECT_EQ(count_non_regular_edges(mesh), 0U);
      if (!energy.barrier) continue;
      EXPECT_LE(report.objective_after, report.objective_before);
    }
  }
}

TEST(PeriodicOptimize, SweepsRemoveAndRepairsInsertVertices) {
  Mesh mesh = torus(300, 6);
  OptimizeOptions o;
  o.paper.removal = Removal::patch;
  o.paper.collapse_from = 0;
  const OptimizeReport report = optimized_periodic(mesh, o);
  EXPECT_FALSE(mesh.validate());
  EXPECT_GT(report.vertices_removed, 0);
  EXPECT_EQ(mesh.n_vertices() + mesh.n_triangles(), mesh.n_edges());
  EXPECT_EQ(count_non_regular_edges(mesh), 0U);

  Mesh swept = torus(400, 3), mended = swept;
  optimized_periodic(swept, {.unknowns = Unknowns::positions, .repair = Repair::none});
  optimized_periodic(mended, {.unknowns = Unknowns::positions, .repair = Repair::vertices});
  EXPECT_FALSE(bad_triangles(swept).empty());
  expect_all_well_centered(mended);
}

TEST(PeriodicOptimize, ReplayEndsWithTheSameBytes) {
  const Mesh before = torus(300, 7);
  Mesh mesh = before;
  std::vector<TraceEvent> events;
  optimized_periodic(mesh, {}, {.tracer = [&](const TraceEvent& e) { events.push_back(e); }});
  const auto again = replay(before, events);
  ASSERT_TRUE(again) << again.error().what();
  EXPECT_TRUE(*again == mesh);
}

TEST(PeriodicOptimize, WhatIsNotThereSaysSo) {
  const auto message = [](const OptimizeOptions& o) {
    Mesh mesh = torus(60, 1);
    const auto report = optimize(mesh, o, {});
    return report ? std::string() : report.error().message;
  };
  EXPECT_EQ(message({.boundary = BoundaryVertices::split}),
            "`boundary=split` is for meshes of the plane; where it is periodic expected `boundary=keep` or "
            "`boundary=slide`");
  EXPECT_NE(message({.size_band = 1.3}).find("`size_band` is for meshes of the plane"), std::string::npos);
  EXPECT_EQ(message({.size_field = input_size_field(torus(60, 2, {1, 1.25}))}),
            "`size_field` is on a mesh with other periods; expected those of the mesh");
  EXPECT_EQ(message({.size_field = input_size_field(torus(60, 2))}), "");
  EXPECT_NE(message({.size_field = input_size_field(*annulus())}).find("is on a mesh of the plane"), std::string::npos);
  Mesh hides = torus(60, 1);
  hides.set_weight(VertexId(7), -1);
  const auto refused = optimize(hides, {}, {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(
      refused.error().message,
      "weights hide point 7 (weight -1); expected weights that leave every vertex a power cell, and edges shorter "
      "than half a period");
  EXPECT_NE(message(*options_for("paper")).find("`inversion=allow` is for meshes of the plane"), std::string::npos);
}

}  // namespace
}  // namespace temper
