// The examples: what each promises, that a seed is a mesh, and what they refuse.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "support/shapes.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/energy.hpp"
#include "temper/generate.hpp"
#include "temper/regularity.hpp"

namespace temper {
namespace {

using test::area;

struct Named {
  const char* name;
  std::function<Expected<Mesh>()> make;
};

std::vector<Named> all_examples() {
  return {
      {"sparse horseshoe", [] { return Expected<Mesh>(sparse_horseshoe()); }},
      {"horseshoe", [] { return horseshoe(); }},
      {"even horseshoe",
       [] {
         return horseshoe({.a = 10, .b = 4, .x = {0.5, 3}, .y = {1, 9}});
       }},
      {"least horseshoe", [] { return horseshoe({.a = 3, .b = 2}); }},
      {"triangle", [] { return single_triangle(); }},
      {"random points", [] { return random_mesh(); }},
      {"few random points", [] { return random_mesh({.vertices = 9}); }},
      {"more random points", [] { return random_mesh({.vertices = 5000, .seed = 4}); }},
      {"clockwise triangle",
       [] {
         return random_mesh({.vertices = 50, .polygon = {{0, 0}, {0, 1}, {1, 0}}});
       }},
      {"thin box",
       [] {
         return random_mesh({.vertices = 500, .polygon = {{0, 0}, {99, 0}, {99, 1e-3}, {0, 1e-3}}});
       }},
      {"sheared grid", [] { return sheared_grid(); }},
      {"one square", [] { return sheared_grid({.nx = 1, .ny = 1, .shear = -3}); }},
      {"annulus", [] { return annulus(); }},
      {"annulus of few", [] { return annulus({.inner = 0.2, .around = 5, .rings = 3, .jitter = 1}); }},
      {"bare annulus", [] { return annulus({.rings = 2}); }},
      {"airfoil", [] { return airfoil(); }},
      {"fine airfoil", [] { return airfoil({.around = 300, .growth = 1.1, .seed = 2}); }},
      {"coarse airfoil", [] { return airfoil({.around = 16, .growth = 2}); }},
      {"polygon", [] { return regular_polygon(); }},
      {"three corners", [] { return regular_polygon({.corners = 3}); }},
      {"letter A", []() -> Expected<Mesh> { return letter_a(); }},
      {"wedge", [] { return wedge(); }},
      {"needle", [] { return wedge({.angle_deg = 0.1, .pieces = 1}); }},
      {"graded", [] { return graded_mesh(); }},
      {"even", [] { return graded_mesh({.finest = 0.1, .growth = 0}); }},
  };
}

int euler_of(const Mesh& mesh) {
  return static_cast<int>(mesh.n_vertices()) - static_cast<int>(mesh.n_edges()) + static_cast<int>(mesh.n_triangles());
}

std::size_t boundary_edges(const Mesh& mesh) {
  std::size_t count = 0;
  for (const HalfedgeId h : mesh.halfedges()) count += mesh.is_boundary(h) ? 1 : 0;
  return count;
}

/// Triangles without an orthocenter strictly inside; all weights are zero, so: not acute.
std::size_t not_acute(const Mesh& mesh) {
  std::size_t count = 0;
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    if (!is_well_centered(mesh.point(a), mesh.point(b), mesh.point(c))) ++count;
  }
  return count;
}

/// Least and greatest angle, in degrees.
std::pair<double, double> angles(const Mesh& mesh) {
  double least = 180, greatest = 0;
  for (const HalfedgeId h : mesh.halfedges()) {
    const double angle =
        corner_angle(mesh.position(mesh.origin(h)), mesh.position(mesh.target(h)), mesh.position(mesh.opposite(h))) *
        180 / std::numbers::pi;
    least = std::min(least, angle);
    greatest = std::max(greatest, angle);
  }
  return {least, greatest};
}

TEST(Examples, AreValidMeshesWithoutWeightsAndTheSameEveryTime) {
  for (const Named& example : all_examples()) {
    const auto mesh = example.make();
    ASSERT_TRUE(mesh) << example.name << ": " << mesh.error().what();
    EXPECT_EQ(mesh->validate(), std::nullopt) << example.name;
    for (const VertexId v : mesh->vertices()) EXPECT_EQ(mesh->weight(v), 0);
    const auto again = example.make();
    ASSERT_TRUE(again);
    EXPECT_EQ(*mesh, *again) << example.name;
  }
}

TEST(Examples, WithSeedsDifferFromSeedToSeed) {
  EXPECT_FALSE(*random_mesh({.seed = 1}) == *random_mesh({.seed = 2}));
  EXPECT_FALSE(*annulus({.seed = 1}) == *annulus({.seed = 2}));
  EXPECT_FALSE(*airfoil({.seed = 1}) == *airfoil({.seed = 2}));
}

TEST(SparseHorseshoe, IsThePapers) {
  const Mesh mesh = sparse_horseshoe();
  EXPECT_EQ(mesh.n_vertices(), 5u);
  EXPECT_EQ(mesh.n_triangles(), 4u);
  EXPECT_FALSE(mesh.is_boundary(VertexId(4)));
  for (std::size_t v = 0; v < 4; ++v) EXPECT_TRUE(mesh.is_boundary(VertexId(v)));
  EXPECT_EQ(mesh.position(VertexId(4)), (Vec2{0, 3}));
  EXPECT_DOUBLE_EQ(area(mesh), 4);
}

TEST(HorseshoeExample, OfSevenByNineIsThePapersDenseOne) {
  const auto mesh = horseshoe();
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->n_vertices(), 63u);
  EXPECT_EQ(mesh->n_triangles(), 96u);
  EXPECT_EQ(mesh->n_edges(), 158u);
  EXPECT_EQ(boundary_edges(*mesh), 28u);  // 3 · 96 = 2 · 158 − 28
  EXPECT_EQ(not_acute(*mesh), 58u);
  const auto [least, greatest] = angles(*mesh);
  EXPECT_NEAR(least, 4.095, 5e-4);
  EXPECT_NEAR(greatest, 138.27, 5e-3);
  EXPECT_EQ(count_non_regular_edges(*mesh), 0u);
}

TEST(HorseshoeExample, HasTheEnergiesOfThePrototype) {
  const Mesh mesh = *horseshoe();
  const auto energy = [&](EnergyKind kind, int star) {
    return total_energy(mesh, {.kind = kind, .star = Star(star), .gamma = {1, LengthScale::absolute}});
  };
  EXPECT_NEAR(energy(EnergyKind::F, 0), 0.581320957789, 1e-12);
  EXPECT_NEAR(energy(EnergyKind::F, 1), 2.836890825582, 1e-12);
  EXPECT_NEAR(energy(EnergyKind::F, 2), 2.255569867793, 1e-12);
  EXPECT_NEAR(energy(EnergyKind::T, 1), 12.143904187128, 1e-12);
  EXPECT_NEAR(energy(EnergyKind::BP, 1), 375.355882218659, 1e-10);
}

TEST(HorseshoeExample, IsSymmetricToTheLastBit) {
  const auto mesh = horseshoe({.a = 9, .b = 4, .x = {1, 2}, .y = {1, 3.3}});
  ASSERT_TRUE(mesh);
  for (std::size_t i = 0; i < 9; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      const Vec2 p = mesh->position(VertexId(4 * i + j)), q = mesh->position(VertexId(4 * (8 - i) + j));
      EXPECT_EQ(p, (Vec2{-q.x, q.y}));
      if (i == 0) {
        EXPECT_EQ(p.y, 0);
      }
    }
  }
}

TEST(SingleTriangleExample, HasTheSidesAndTheAngle) {
  const auto mesh = single_triangle({.a = 2, .b = 3, .angle_deg = 75});
  ASSERT_TRUE(mesh);
  const Vec2 p = mesh->position(VertexId(0)), q = mesh->position(VertexId(1)), r = mesh->position(VertexId(2));
  EXPECT_DOUBLE_EQ(length(q - p), 2);
  EXPECT_DOUBLE_EQ(length(r - p), 3);
  EXPECT_NEAR(corner_angle(p, q, r), 75 * std::numbers::pi / 180, 1e-15);
}

TEST(RandomMeshExample, HasAsManyVerticesAsAskedAndFillsThePolygon) {
  for (const std::size_t n : {9u, 10u, 30u, 100u, 3000u}) {
    const auto mesh = random_mesh({.vertices = n, .seed = n});
    ASSERT_TRUE(mesh) << mesh.error().what();
    EXPECT_EQ(mesh->n_vertices(), n);
    EXPECT_NEAR(area(*mesh), 12 - 0.375, 1e-12);
    EXPECT_EQ(euler_of(*mesh), 1);
    EXPECT_EQ(count_non_regular_edges(*mesh), 0u);
  }
}

TEST(RandomMeshExample, IsHalfBadButNotAtTheBoundary) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto mesh = random_mesh({.vertices = 2000, .seed = seed});
    ASSERT_TRUE(mesh);
    const double part = static_cast<double>(not_acute(*mesh)) / static_cast<double>(mesh->n_triangles());
    EXPECT_GT(part, 0.45);
    EXPECT_LT(part, 0.55);
    // No triangle has two sides on the boundary: a fixed boundary leaves room to cure all of them.
    for (const TriangleId t : mesh->triangles()) {
      int sides = 0;
      for (int k = 0; k < 3; ++k) sides += mesh->is_boundary(Mesh::halfedge(t, k)) ? 1 : 0;
      EXPECT_LT(sides, 2);
    }
  }
}

TEST(ShearedGridExample, IsCutAlongTheLongDiagonals) {
  const auto mesh = sheared_grid({.nx = 3, .ny = 2, .shear = 0.5});
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->n_vertices(), 12u);
  EXPECT_EQ(mesh->n_triangles(), 12u);
  EXPECT_EQ(mesh->position(VertexId(11)), (Vec2{4, 2}));
  EXPECT_EQ(count_non_regular_edges(*mesh), 6u);
  EXPECT_EQ(not_acute(*mesh), 12u);
}

TEST(AnnulusExample, HasAHole) {
  const auto mesh = annulus();
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->n_vertices(), 48u * 6u);
  EXPECT_EQ(euler_of(*mesh), 0);
  EXPECT_EQ(boundary_edges(*mesh), 96u);
  const double polygons = 24 * std::sin(2 * std::numbers::pi / 48) * (1 - 0.16);
  EXPECT_NEAR(area(*mesh), polygons, 1e-13);
}

TEST(AirfoilExample, IsGradedAroundAHoleWithASharpEnd) {
  const auto mesh = airfoil();
  ASSERT_TRUE(mesh);
  EXPECT_EQ(euler_of(*mesh), 0);
  EXPECT_EQ(mesh->position(VertexId(0)), (Vec2{2, 0}));
  double least = 100, greatest = 0, around_trailing_edge = 0;
  for (const HalfedgeId h : mesh->halfedges()) {
    const double l = length(mesh->position(mesh->target(h)) - mesh->position(mesh->origin(h)));
    least = std::min(least, l);
    greatest = std::max(greatest, l);
    if (mesh->origin(h) != VertexId(0)) continue;
    around_trailing_edge +=
        corner_angle(mesh->position(VertexId(0)), mesh->position(mesh->target(h)), mesh->position(mesh->opposite(h)));
  }
  EXPECT_GT(greatest / least, 50);
  EXPECT_GT(around_trailing_edge * 180 / std::numbers::pi, 340);
  EXPECT_LT(area(*mesh), 400);
  EXPECT_GT(area(*mesh), 395);
}

TEST(Examples, RefuseWhatMakesNoSense) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const Polygon crossed = {{0, 0}, {2, 2}, {2, 0}, {0, 1}};
  const std::vector<std::pair<const char*, Expected<Mesh>>> cases = {
      {"a = 2", horseshoe({.a = 2})},
      {"b = 1", horseshoe({.b = 1})},
      {"x not increasing", horseshoe({.x = {2, 2}})},
      {"y negative", horseshoe({.y = {-1, 4}})},
      {"x infinite", horseshoe({.x = {1, inf}})},
      {"side 0", single_triangle({.a = 0})},
      {"side NaN", single_triangle({.b = nan})},
      {"angle 180", single_triangle({.angle_deg = 180})},
      {"two corners", regular_polygon({.corners = 2})},
      {"wedge of angle 0", wedge({.angle_deg = 0})},
      {"wedge without edges", wedge({.pieces = 0})},
      {"finest 0", graded_mesh({.finest = 0})},
      {"growth NaN", graded_mesh({.growth = nan})},
      {"fewer vertices than corners", random_mesh({.vertices = 8})},
      {"two corners", random_mesh({.polygon = {{0, 0}, {1, 0}}})},
      {"NaN corner", random_mesh({.polygon = {{0, 0}, {1, 0}, {nan, 1}}})},
      {"double corner", random_mesh({.polygon = {{0, 0}, {1, 0}, {1, 0}, {0, 1}}})},
      {"flat polygon", random_mesh({.polygon = {{0, 0}, {1, 0}, {2, 0}}})},
      {"crossed polygon", random_mesh({.polygon = crossed})},
      {"no columns", sheared_grid({.nx = 0})},
      {"infinite shear", sheared_grid({.shear = inf})},
      {"huge grid", sheared_grid({.nx = 2000000000, .ny = 2000000000})},
      {"two around", annulus({.around = 2})},
      {"one ring", annulus({.rings = 1})},
      {"inner beyond outer", annulus({.inner = 1, .outer = 0.5})},
      {"inner through the sides of outer", annulus({.inner = 0.9, .around = 3})},
      {"too much jitter", annulus({.jitter = 1.5})},
      {"NaN jitter", annulus({.jitter = nan})},
      {"three around", airfoil({.around = 3})},
      {"no growth", airfoil({.growth = 1})},
      {"NaN growth", airfoil({.growth = nan})},
      {"too fine", airfoil({.around = 1000000, .growth = 1.02})},
  };
  for (const auto& [name, mesh] : cases) {
    EXPECT_FALSE(mesh.has_value()) << name;
    if (!mesh.has_value()) {
      EXPECT_FALSE(mesh.error().message.empty()) << name;
    }
  }
}

}  // namespace
}  // namespace temper
