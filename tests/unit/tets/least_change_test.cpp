// Runs of tetrahedra that change little: Change::least, and the guard of dihedral angles.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "support/tet_lattice.hpp"
#include "temper/detail/lp.hpp"
#include "temper/tets/criterion.hpp"
#include "temper/tets/optimize.hpp"
#include "temper/tets/quality.hpp"
#include "temper/tets/weights.hpp"
#include "tets/quality/measure.hpp"
#include "unit/tets/pinwheel_cone.hpp"

namespace temper::tets {
namespace {

constexpr Scheme kSchemes[] = {Scheme::all, Scheme::vertex, Scheme::cell};

OptimizeHooks with_weights() {
  OptimizeHooks hooks;
  hooks.solvers = {clp_solver, interior_point_solver, nullptr};
  return hooks;
}
OptimizeOptions least(Scheme scheme) { return {.scheme = scheme, .change = Change::least}; }

/// A lattice of weights 0 that meets all criteria, except for one vertex in its middle, off its place.
TetMesh with_one_bad_place(double shift) {
  TetMesh mesh = test::mesh_of(test::body_centered(6));
  const Vec3 middle = {3, 3, 3};
  const auto distance = [&](VertexId v) { return squared_length(mesh.position(v) - middle); };
  const auto all = mesh.vertices();
  const VertexId v = *std::min_element(all.begin(), all.end(), [&](VertexId a, VertexId b) {
    return std::pair(distance(a), a) < std::pair(distance(b), b);
  });
  WeightedPoint p = mesh.point(v);
  p.x += shift, p.y += 0.5 * shift;
  mesh.set_point(v, p);
  return mesh;
}

std::set<std::array<VertexId, 2>> edges_of(const TetMesh& mesh) {
  std::set<std::array<VertexId, 2>> edges;
  for (const TetId t : mesh.tetrahedra()) {
    auto corners = mesh.corners(t);
    std::sort(corners.begin(), corners.end());
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) edges.insert({corners[i], corners[j]});
    }
  }
  return edges;
}

TEST(TetLeastChange, MakesABadPlaceGoodAndLeavesAllElseBitForBit) {
  for (const Scheme scheme : kSchemes) {
    const TetMesh input = with_one_bad_place(0.35);
    const Criterion criterion = criterion_of(scheme);
    ASSERT_FALSE(meets(input, criterion, nullptr)) << static_cast<int>(scheme);
    TetMesh mesh = input;
    const auto report = optimize(mesh, least(scheme), with_weights());
    ASSERT_TRUE(report);
    EXPECT_TRUE(meets(mesh, criterion, nullptr)) << static_cast<int>(scheme);
    const auto& numbers = report->origins.vertices;
    const auto number = [&](VertexId v) { return numbers.empty() ? v : numbers[v]; };
    EXPECT_LE(mesh.n_vertices(), input.n_vertices() + 2);
    ASSERT_TRUE(report->changed);
    std::size_t moved = 0, weighed = 0;
    for (const VertexId v : mesh.vertices()) {
      if (!number(v).valid()) continue;
      moved += mesh.position(v) == input.position(number(v)) ? 0 : 1;
      weighed += mesh.weight(v) == input.weight(number(v)) ? 0 : 1;
    }
    EXPECT_EQ(report->changed->vertices_moved, moved);
    EXPECT_EQ(report->changed->weights_changed, weighed);
    EXPECT_LT(moved + weighed, mesh.n_vertices() / 2) << static_cast<int>(scheme);
    const auto before = edges_of(input);
    std::size_t new_edges = 0;
    for (const auto& [a, b] : edges_of(mesh)) {
      const bool was = number(a).valid() && number(b).valid() &&
                       before.contains({std::min(number(a), number(b)), std::max(number(a), number(b))});
      new_edges += was ? 0 : 1;
    }
    EXPECT_EQ(report->changed->edges_changed, new_edges);
    EXPECT_FALSE(report->notes.empty());
  }
}

TEST(TetLeastChange, AnInputThatMeetsTheCriterionComesBack) {
  for (const Scheme scheme : kSchemes) {
    const TetMesh input = with_one_bad_place(0);
    TetMesh mesh = input;
    const auto report = optimize(mesh, least(scheme), with_weights());
    ASSERT_TRUE(report);
    EXPECT_EQ(report->sweeps, 0);
    EXPECT_EQ(report->changed->vertices_moved + report->changed->weights_changed + report->changed->edges_changed, 0U);
    for (const VertexId v : mesh.vertices()) EXPECT_EQ(mesh.point(v), input.point(v));
    ASSERT_EQ(report->notes.size(), 1U);
    EXPECT_NE(report->notes[0].find("comes back as it was"), std::string::npos);
  }
}

TEST(TetLeastChange, ChangesTheWholeMeshIfManyPlacesAreBadAndSaysSo) {
  TetMesh mesh = test::mesh_of(test::shaken(test::body_centered(4), 0.18, 0.1));
  const std::size_t bad = cells_at_violations(mesh, Criterion::well_centered, nullptr).size();
  ASSERT_GT(13 * bad, mesh.n_tetrahedra());
  const auto report = optimize(mesh, least(Scheme::all), {});  // without weights alone
  ASSERT_TRUE(report);
  EXPECT_LT(cells_at_violations(mesh, Criterion::well_centered, nullptr).size(), bad);
  ASSERT_FALSE(report->notes.empty());
  EXPECT_NE(report->notes[0].find(std::to_string(bad) + " tetrahedra violated"), std::string::npos);
}

TEST(TetSurface, GetsVerticesWhereNoWeightsMakeItsEdgesRegularOnRequestAlone) {
  const TetMesh input = pinwheel_cone();
  OptimizeOptions options = {.scheme = Scheme::vertex};
  options.tets.accuracy_steps = 0;
  for (const bool splits : {false, true}) {
    options.boundary = splits ? BoundaryVertices::split : BoundaryVertices::keep;
    options.tets.repair_trials = splits ? 1 : 0;
    TetMesh mesh = input;
    const auto report = optimize(mesh, options, with_weights());
    ASSERT_TRUE(report);
    EXPECT_EQ(mesh.validate(), std::nullopt);
    EXPECT_NEAR(quality(mesh).volume, quality(input).volume, 1e-9);
    EXPECT_EQ(meets(mesh, Criterion::coefficients, nullptr), splits);
    EXPECT_EQ(report->vertices_inserted > 0, splits);
    EXPECT_EQ(report->vertices_removed, 0U);
  }
}

// Below a thin layer: all orthocenters inside at one place need vertices and flips that distances alone do not ask for.
TEST(TetDistances, ArePositiveIfPlacesThatPatchesForThemLeaveAreMadeWellCentered) {
  const test::TetArrays arrays = {
      {{20, 13, 9},
       {7, 0, 9},
       {7, 12, 9},
       {14, 0, 9},
       {18, 19, 9},
       {18, 6, 9},
       {11, 6, 9},
       {11, 19, 9},
       {13, 13, 9},
       {20, 13, 13},
       {7, 12, 13},
       {14, 0, 13},
       {18, 19, 13},
       {18, 6, 13},
       {11, 6, 13},
       {11, 19, 13},
       {13, 13, 13}},
      {},
      {{13, 9, 0, 8},   {6, 14, 5, 8},  {11, 1, 14, 3},  {6, 14, 1, 3},   {3, 14, 11, 5}, {16, 13, 14, 8},
       {13, 5, 14, 8},  {5, 13, 0, 8},  {9, 13, 16, 8},  {6, 14, 3, 5},   {8, 4, 9, 0},   {8, 15, 12, 7},
       {8, 7, 12, 4},   {12, 8, 4, 9},  {5, 14, 11, 13}, {8, 14, 10, 6},  {8, 6, 10, 2},  {7, 2, 8, 15},
       {15, 8, 12, 16}, {12, 8, 9, 16}, {8, 10, 15, 2},  {14, 8, 10, 16}, {10, 8, 15, 16}}};
  const TetMesh input = test::mesh_of(arrays);
  OptimizeOptions options = {.scheme = Scheme::cell};
  options.tets.accuracy_steps = 0;
  TetMesh mesh = input;
  ASSERT_TRUE(optimize(mesh, options, with_weights()));
  EXPECT_FALSE(meets(input, Criterion::distances, nullptr));
  EXPECT_TRUE(meets(mesh, Criterion::distances, nullptr));
  EXPECT_EQ(mesh.validate(), std::nullopt);
}

TEST(TetDescent, LeavesNoCoefficientNegativeOnTheSurfaceOrInOneRegion) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    TetMesh input = test::mesh_of(test::shaken(test::cubes(3, test::kSixTets), 0.15, 0, seed));
    for (const TetId t : input.tetrahedra()) input.set_region(t, t.index < input.n_tetrahedra() / 2 ? 1 : 2);
    std::array<std::size_t, 2> left = {};
    for (const int steps : {0, 60}) {
      OptimizeOptions options = {.scheme = Scheme::vertex};
      options.tets.accuracy_steps = steps;
      options.tets.repair_trials = 0;
      TetMesh mesh = input;
      ASSERT_TRUE(optimize(mesh, options, with_weights()));
      left[steps > 0] = violated_edges(mesh, nullptr).size();
    }
    EXPECT_LE(left[1], left[0]) << seed;
  }
}

double least_dihedral(const TetMesh& mesh) {
  return 180 / std::numbers::pi * std::acos(largest_dihedral_cosine(mesh, nullptr));
}

TEST(TetGuard, NoDihedralAngleFallsBelowItsLimitOrTheInputs) {
  const TetMesh input = test::mesh_of(test::shaken(test::cubes(2, test::kSixTets), 0.25, 0));
  const double before = least_dihedral(input);
  for (const Scheme scheme : kSchemes) {
    OptimizeOptions options = {.scheme = scheme};
    options.tets.accuracy_steps = 20;
    TetMesh free = input;
    const auto report = optimize(free, options, with_weights());
    ASSERT_TRUE(report);
    const double without = least_dihedral(free);
    EXPECT_EQ(without < 0.8 * before, !report->notes.empty())
        << static_cast<int>(scheme) << ": " << before << " to " << without;
    for (const double limit : {60.0, 0.9 * before}) {
      options.guard.angle = limit;
      TetMesh guarded = input;
      ASSERT_TRUE(optimize(guarded, options, with_weights()));
      EXPECT_GE(least_dihedral(guarded), std::min(limit, before) - 1e-6) << static_cast<int>(scheme);
      EXPECT_LE(cells_at_violations(guarded, criterion_of(scheme), nullptr).size(),
                cells_at_violations(input, criterion_of(scheme), nullptr).size() - (limit < before ? 1 : 0));
    }
    if (scheme == Scheme::all) {
      EXPECT_LT(without, 0.9 * before);  // the guard had something to do
    }
  }
}

TEST(TetLeastWeights, AreGivenUpAtOnceIfTheyMustStop) {
  const TetMesh mesh = test::mesh_of(test::shaken(test::cubes(4, test::kFiveTets), 0.12, 0));
  const auto [lp, convex] = std::pair(clp_solver(), interior_point_solver());
  WeightOptions options = {.goal = WeightGoal::least, .constraints = Constraints::coefficients};
  ASSERT_GT(find_weights(mesh, *lp, options, convex.get())->moved, 0U);
  for (const int calls : {0, 1, 3}) {
    int asked = 0;
    options.must_stop = [&] { return asked++ >= calls; };
    const auto report = find_weights(mesh, *lp, options, convex.get());
    ASSERT_TRUE(report);
    EXPECT_LE(asked, calls + 8);
    EXPECT_FALSE(report->solved);
    EXPECT_EQ(report->moved, 0U);
  }
}

}  // namespace
}  // namespace temper::tets
