// Boundary grading: the ratio that is promised, no more cuts than needed, and what stays.
#include <gtest/gtest.h>

#include "property/mesh_of_random_points.hpp"
#include "support/shapes.hpp"
#include "temper/regularity.hpp"

namespace temper {
namespace {

/// A strip of `n` triangles between two lines, whose edges along the lines have random lengths over many octaves.
Mesh random_strip(Rng& rng, int n, double octaves) {
  std::vector<Vec2> points;
  std::vector<std::array<std::int32_t, 3>> triangles;
  double x[2] = {0, 0};
  for (int i = 0; i < n + 2; ++i) {
    points.push_back({x[i % 2], i % 2 == 0 ? 0.0 : 1.0});
    x[i % 2] += std::exp2(octaves * rng.uniform(-1, 0));
    if (i < 2) continue;
    if (i % 2 == 0) {
      triangles.push_back({i - 2, i, i - 1});
    } else {
      triangles.push_back({i - 2, i - 1, i});
    }
  }
  return test::build_or_die(points, triangles);
}

TEST(BoundaryGrading, BringsEveryPairWithinTheRatioAndThenHasNothingLeftToDo) {
  std::size_t cut = 0, vertices = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Rng rng(seed);
    const double ratio = seed % 3 == 0 ? 2 : seed % 3 == 1 ? 3 : 4;
    Mesh mesh = random_strip(rng, 12, 8);
    const std::size_t before = mesh.n_vertices();
    const double area = test::area(mesh);
    const Mesh old = mesh;
    const GradingPlan plan = plan_boundary_grading(mesh, ratio);
    EXPECT_LE(plan.ratio_after, ratio);
    EXPECT_EQ(plan.vertices > 0, plan.ratio_before > ratio);
    cut += plan.vertices > 0 ? 1 : 0;
    vertices += plan.vertices;
    for (const EdgeSplits& cuts : plan.cuts) {
      EXPECT_LT(cuts.a, cuts.b);
      EXPECT_TRUE(std::is_sorted(cuts.at.begin(), cuts.at.end()));
      VertexId last = cuts.a;
      for (const double t : cuts.at) {
        HalfedgeId h = mesh.find_halfedge(last, cuts.b);
        if (!h.valid()) h = mesh.find_halfedge(cuts.b, last);
        const Vec2 p = old.position(cuts.a) + t * (old.position(cuts.b) - old.position(cuts.a));
        const InsertionPlan split = plan_split(mesh, h, WeightedPoint{p.x, p.y, 0});
        ASSERT_TRUE(split.status == InsertionStatus::possible || split.status == InsertionStatus::not_regular);
        last = insert_vertex(mesh, split);
      }
    }
    EXPECT_EQ(mesh.n_vertices(), before + plan.vertices);
    ASSERT_EQ(mesh.validate(), std::nullopt);
    EXPECT_NEAR(test::area(mesh), area, 1e-12 * area);
    EXPECT_EQ(plan_boundary_grading(mesh, ratio).vertices, 0u) << "seed " << seed;
  }
  EXPECT_GT(cut, 50u);
  EXPECT_GT(vertices, 300u);
}

TEST(BoundaryGrading, CutsALongEdgeIntoAGeometricProgression) {
  // Between sides of 1 and 30 an edge of 19: two pieces q and q² with q + q² = 19, where q < 4.
  const Mesh mesh = test::build_or_die({{0, 0}, {1, 0}, {20, 0}, {20, 30}}, {{0, 1, 3}, {1, 2, 3}});
  const GradingPlan plan = plan_boundary_grading(mesh, 4);
  const double q = 0.5 * (std::sqrt(77.0) - 1);
  for (const EdgeSplits& cuts : plan.cuts) {
    if (cuts.a != VertexId(1) || cuts.b != VertexId(2)) continue;
    ASSERT_EQ(cuts.at.size(), 1u);
    EXPECT_NEAR(cuts.at[0], q / 19, 1e-12);
    return;
  }
  FAIL() << "the edge of length 19 is not cut";
}

TEST(BoundaryGrading, LeavesWhatIsWithinTheRatio) {
  const Mesh mesh = test::square();
  EXPECT_EQ(plan_boundary_grading(mesh, 2).vertices, 0u);
  EXPECT_EQ(plan_boundary_grading(mesh, 0).vertices, 0u);  // as 2
}

TEST(BoundaryGrading, HalvesEdgesSeenAtWideAngles) {
  const Mesh mesh =
      test::build_or_die({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {2, 0.5}}, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
  EXPECT_EQ(plan_boundary_grading(mesh, 4).vertices, 0u);
  const GradingPlan plan = plan_boundary_grading(mesh, 4, 120);  // the bottom side is seen at 152 degrees
  ASSERT_EQ(plan.cuts.size(), 1u);
  EXPECT_EQ(plan.cuts[0].a, VertexId(0));
  EXPECT_EQ(plan.cuts[0].b, VertexId(1));
  EXPECT_EQ(plan.cuts[0].at, std::vector<double>{0.5});
}

TEST(GradeBoundary, FreesTrianglesOfTheBoundaryAndKeepsOldVerticesAndRegularity) {
  std::size_t split = 0, inside = 0, freed = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rng rng(seed);
    Mesh mesh = random_strip(rng, 12, 5);
    ASSERT_TRUE(restore_regularity(mesh).regular());
    const Mesh old = mesh;
    const std::size_t before = triangles_without_free_corner(mesh).size();
    EXPECT_EQ(before, mesh.n_triangles());
    std::size_t seen = 0;
    InsertionObserver observer;
    observer.inserting = [&](const InsertionPlan&) { ++seen; };
    const Grading grading = grade_boundary(mesh, 4, &observer);
    EXPECT_EQ(grading.refused, 0u);
    EXPECT_EQ(seen, grading.vertices + grading.inside);
    ASSERT_EQ(mesh.validate(), std::nullopt);
    ASSERT_EQ(count_non_regular_edges(mesh), 0u) << "seed " << seed;
    ASSERT_EQ(mesh.n_vertices(), old.n_vertices() + grading.vertices + grading.inside);
    for (const VertexId v : old.vertices()) EXPECT_EQ(mesh.point(v), old.point(v));
    split += grading.vertices;
    inside += grading.inside;
    freed += triangles_without_free_corner(mesh).size() < mesh.n_triangles() ? 1 : 0;
  }
  EXPECT_GT(split, 50u);
  EXPECT_GT(inside, 20u);
  EXPECT_EQ(freed, 20u);
}

// The orthocenter is then in the middle of the boundary edge, up to rounding, which may put it inside.
TEST(GradeBoundary, InsertsNoNeedleIntoATriangleWithARightAngleOppositeTheBoundary) {
  Rng rng(7);
  int inside = 0;
  for (int i = 0; i < 100; ++i) {
    const Vec2 right = {rng.uniform(-9, 9), rng.uniform(-9, 9)}, along = {rng.uniform(-1, 1), rng.uniform(-1, 1)};
    const Mesh mesh = test::mesh_of({right, right + along, right + 0.8 * Vec2{-along.y, along.x}}, {{0, 1, 2}});
    const InsertionPlan plan = plan_center(mesh, {VertexId(0), VertexId(1), VertexId(2)});
    if (plan.status != InsertionStatus::possible) continue;
    ++inside;
    const Vec2 a = mesh.position(VertexId(1)), side = mesh.position(VertexId(2)) - a;
    EXPECT_GT(cross(side, plan.point.position() - a), 0.1 * squared_length(side)) << i;
  }
  EXPECT_GT(inside, 20);
}

}  // namespace
}  // namespace temper
