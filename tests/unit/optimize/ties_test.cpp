// Rows of squares that cannot move: only diagonals and weights can make them well-centered, and their ties leave the
// choice of the diagonals free.
#include "optimize/step/ties.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "base/rng.hpp"
#include "optimize/repair/trial.hpp"
#include "temper/optimize.hpp"
#include "temper/regularity.hpp"
#include "temper/topology.hpp"

namespace temper {
namespace {

using Place = std::function<Vec2(double, double)>;

/// columns × rows squares with parallel diagonals. `place` gives the places of their corners.
Mesh squares(int columns, int rows, const Place& place) {
  std::vector<Vec2> points;
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) points.push_back(place(i, j));
  }
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const std::int32_t a = j * (columns + 1) + i, b = a + 1, d = a + columns + 1, c = d + 1;
      triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
    }
  }
  auto built = Mesh::build({.points = points, .triangles = triangles});
  EXPECT_TRUE(built);
  return std::move(built->mesh);
}

Vec2 as_they_are(double x, double y) { return {x, y}; }

struct Strip {
  const char* name;
  Place place;
};

/// With irrational slopes rounding breaks the ties, one way or the other.
std::vector<Strip> strips() {
  return {{"squares", as_they_are},
          {"1 x 1000",
           [](double x, double y) {
             return Vec2{1000 * x, y};
           }},
          {"1000 x 1",
           [](double x, double y) {
             return Vec2{x, 1000 * y};
           }},
          {"longer and longer",
           [](double x, double y) {
             return Vec2{std::exp(x / 100), y};
           }},
          {"turned",
           [](double x, double y) {
             return Vec2{0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y};
           }},
          {"a ring", [](double x, double y) {
             return Vec2{(300 + y) * std::cos(x / 300), (300 + y) * std::sin(x / 300)};
           }}};
}

TEST(Ties, StripsEndWellCenteredAfterSweepsThatDoNotDependOnTheirLength) {
  constexpr int kMostSweeps = 300;
  for (const auto& [name, place] : strips()) {
    for (const int n : {1, 2, 8, 300, 1200}) {
      SCOPED_TRACE(testing::Message() << n << " of " << name);
      Mesh mesh = squares(n, 1, place);
      const auto report = optimize(mesh);
      ASSERT_TRUE(report);
      EXPECT_EQ(defect_of(mesh).bad, 0u);
      EXPECT_EQ(count_non_regular_edges(mesh), 0u);
      EXPECT_LT(report->sweeps, kMostSweeps);
    }
  }
}

TEST(Ties, OfAGridAreCuredByWeightsAlone) {
  Mesh mesh = squares(40, 30, as_they_are);
  ASSERT_TRUE(optimize(mesh, {.unknowns = Unknowns::weights}));
  EXPECT_EQ(defect_of(mesh).bad, 0u);
  EXPECT_EQ(count_non_regular_edges(mesh), 0u);
}

TEST(Ties, HeavierEndsAreEveryOtherVertex) {
  const Mesh mesh = squares(10, 1, as_they_are);
  const std::vector<TieEnd> ends = heavier_ends_of_ties(mesh, {});
  ASSERT_EQ(ends.size(), 11u);
  const auto color = [&](VertexId v) { return std::lround(mesh.position(v).x + mesh.position(v).y) % 2; };
  for (const TieEnd& end : ends) {
    EXPECT_EQ(color(end.vertex), color(ends.front().vertex));
    EXPECT_EQ(end.shortest2, 1.0);
  }
}

// Each quad has its diagonal between heavier ends, and no other vertex is among them, for any former diagonals.
TEST(Ties, HeavierEndsMakeEveryDiagonalTheirs) {
  Rng rng(1);
  Mesh mesh = squares(12, 9, as_they_are);
  for (const HalfedgeId h : mesh.halfedges()) {
    const bool diagonal = squared_length(mesh.position(mesh.target(h)) - mesh.position(mesh.origin(h))) == 2;
    if (diagonal && rng.below(2) == 0) flip(mesh, h);
  }
  const OptimizeOptions weights_only = {.unknowns = Unknowns::weights};
  const std::vector<TieEnd> ends = heavier_ends_of_ties(mesh, weights_only);
  for (const TieEnd& end : ends) mesh.set_weight(end.vertex, 0.25 * end.shortest2);
  EXPECT_GT(restore_regularity(mesh).flips, 0u);
  EXPECT_EQ(defect_of(mesh).bad, 0u);
}

TEST(Ties, AreNotSoughtWhereVerticesMoveOrWeightsOrEdgesMayNotChange) {
  const Mesh strip = squares(6, 1, as_they_are), block = squares(6, 6, as_they_are);
  EXPECT_TRUE(has_tied_quads(strip, {}));
  EXPECT_FALSE(has_tied_quads(strip, {.unknowns = Unknowns::positions}));
  EXPECT_FALSE(has_tied_quads(strip, {.flips = Flips::none}));
  EXPECT_TRUE(has_tied_quads(block, {.unknowns = Unknowns::weights}));
  EXPECT_FALSE(has_tied_quads(block, {}));  // each of its squares has a corner inside, which moves
}

}  // namespace
}  // namespace temper
