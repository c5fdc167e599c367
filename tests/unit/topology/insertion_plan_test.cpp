// Insertions, splits and collapses as plans, looked at closely: each status, where the point falls, and what becomes
// of weights, flags and regions.
#include <gtest/gtest.h>

#include "property/mesh_of_random_points.hpp"
#include "support/shapes.hpp"
#include "temper/regularity.hpp"

namespace temper {
namespace {

HalfedgeId edge(const Mesh& mesh, std::size_t a, std::size_t b) { return mesh.find_halfedge(VertexId(a), VertexId(b)); }

// In the square with corners 0 … 3 and the diagonal 0-2.
TEST(PlanInsertion, SaysWhereThePointFalls) {
  Mesh mesh = test::square();
  const auto status = [&](Vec2 p, double w = 0) { return plan_insertion(mesh, {p.x, p.y, w}, TriangleId(0)).status; };
  EXPECT_EQ(status({0.5, 0}), InsertionStatus::possible);
  EXPECT_EQ(status({0.5, 0.5}), InsertionStatus::possible);
  EXPECT_EQ(status({1.5, 0}), InsertionStatus::outside);
  EXPECT_EQ(status({1, 1}), InsertionStatus::at_vertex);
  EXPECT_EQ(status({1, 0}), InsertionStatus::on_boundary);
  EXPECT_EQ(status({0.5, 0}, -5), InsertionStatus::hidden);
  mesh.set_constrained(edge(mesh, 0, 2), true);
  EXPECT_EQ(status({0.5, 0.5}), InsertionStatus::on_constrained);
  EXPECT_EQ(status({0.5, 0x1p-1 - 0x1p-52}), InsertionStatus::possible);
}

TEST(PlanInsertion, OnAnEdgeSplitsItFromItsSmallerEnd) {
  const Mesh mesh = test::square();
  for (const TriangleId near : mesh.triangles()) {
    const InsertionPlan plan = plan_insertion(mesh, {0.5, 0.5, 0}, near);
    EXPECT_EQ(plan.edge, edge(mesh, 0, 2));
    EXPECT_EQ(plan.cavity.size(), 2u);
    EXPECT_EQ(plan.link.size(), 4u);
    EXPECT_TRUE(plan.flips.empty());
  }
}

TEST(PlanInsertion, StopsAtConstrainedEdges) {
  Mesh mesh = test::square();
  EXPECT_EQ(plan_insertion(mesh, {0.5, 0.25, 0}, TriangleId(0)).cavity.size(), 2u);
  mesh.set_constrained(edge(mesh, 0, 2), true);
  EXPECT_EQ(plan_insertion(mesh, {0.5, 0.25, 0}, TriangleId(0)).cavity.size(), 1u);
}

/// The unit square between two others: the left one is a quadrilateral, the middle one is cut into two triangles.
///
///     3---4---5
///     | / | / |
///     0---1---2
TEST(PlanInsertion, PutsNoVertexBesideAQuadrilateral) {
  const std::vector<Vec2> points = {{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}};
  const std::vector<std::array<std::int32_t, 3>> triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}};
  Mesh mesh = Mesh::build({.points = points, .triangles = triangles})->mesh;
  EXPECT_EQ(plan_insertion(mesh, {1.2, 0.6, 0}, TriangleId(0)).status, InsertionStatus::possible);
  mesh.set_diagonal(edge(mesh, 0, 4));
  mesh.set_constrained(edge(mesh, 1, 4), true);
  EXPECT_EQ(plan_insertion(mesh, {0.5, 0.25, 0}, TriangleId(0)).status, InsertionStatus::in_quadrilateral);
  EXPECT_EQ(plan_insertion(mesh, {1.2, 0.6, 0}, TriangleId(0)).status, InsertionStatus::in_quadrilateral);
  EXPECT_EQ(plan_split(mesh, edge(mesh, 2, 5), 0.5).status, InsertionStatus::in_quadrilateral);
  mesh.set_constrained(edge(mesh, 1, 5), true);
  EXPECT_EQ(plan_split(mesh, edge(mesh, 2, 5), 0.5).status, InsertionStatus::possible);
}

TEST(PlanInsertion, AVertexThatWouldHideANeighborIsPlannedAsNotRegular) {
  Mesh mesh = test::square();
  insert_in_triangle(mesh, TriangleId(0), {0.5, 0, 0});
  ASSERT_TRUE(restore_regularity(mesh).regular());
  const InsertionPlan plan = plan_insertion(mesh, {0.25, 0.125, 0.9}, TriangleId(0));
  ASSERT_EQ(plan.status, InsertionStatus::not_regular);
  insert_vertex(mesh, plan);
  EXPECT_EQ(mesh.validate(), std::nullopt);
  EXPECT_GT(count_non_regular_edges(mesh), 0u);
}

// Vertices of large weight hide their neighbors, those of small weight are hidden.
TEST(PlanInsertion, IsPossibleJustWhereEveryEdgeIsRegularAfterIt) {
  Rng rng(5);
  Mesh mesh = test::mesh_of_random_points(rng, 20);
  ASSERT_TRUE(restore_regularity(mesh).regular());
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_boundary(h) && rng.below(8) == 0) mesh.set_constrained(h, true);
  }
  std::size_t possible = 0, not_regular = 0;
  for (int i = 0; i < 400; ++i) {
    const WeightedPoint p = {rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-0.05, 0.5)};
    const InsertionPlan plan = plan_insertion(mesh, p, TriangleId(0));
    if (plan.status == InsertionStatus::hidden) continue;
    Mesh after = mesh;
    insert_vertex(after, plan);
    const bool is_regular = count_non_regular_edges(after, false) == 0;
    ASSERT_EQ(plan.status, is_regular ? InsertionStatus::possible : InsertionStatus::not_regular) << i;
    ++(is_regular ? possible : not_regular);
  }
  EXPECT_GT(possible, 20u);
  EXPECT_GT(not_regular, 20u);
}

TEST(PlanInsertion, LooksEverywhereWhenTheWayLeadsThroughAHole) {
  // A ring of eight triangles around a square hole.
  const Mesh mesh =
      test::build_or_die({{-2, -2}, {2, -2}, {2, 2}, {-2, 2}, {-1, -1}, {1, -1}, {1, 1}, {-1, 1}},
                         {{0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}});
  for (const TriangleId near : mesh.triangles()) {
    EXPECT_EQ(plan_insertion(mesh, {-1.5, 0.25, 0}, near).status, InsertionStatus::possible);
    EXPECT_EQ(plan_insertion(mesh, {1.5, 0.25, 0}, near).status, InsertionStatus::possible);
    EXPECT_EQ(plan_insertion(mesh, {0, 0, 0}, near).status, InsertionStatus::outside);
    EXPECT_EQ(plan_insertion(mesh, {9, 9, 0}, near).status, InsertionStatus::outside);
  }
}

TEST(PlanInsertion, ReusesStorage) {
  const Mesh mesh = test::square();
  InsertionPlan plan = plan_insertion(mesh, {0.5, 0.25, 0}, TriangleId(0));
  const VertexId* link = plan.link.data();
  const TriangleId* cavity = plan.cavity.data();
  plan = plan_insertion(mesh, {0.5, 0.25, 0}, TriangleId(0), std::move(plan));
  EXPECT_EQ(plan.status, InsertionStatus::possible);
  EXPECT_EQ(plan.link.data(), link);
  EXPECT_EQ(plan.cavity.data(), cavity);
}

TEST(InterpolatedWeight, IsLinearAndNeverHides) {
  Rng rng(3);
  std::size_t inserted = 0;
  Mesh mesh = test::mesh_of_random_points(rng, 40);
  const auto linear = [](Vec2 p) { return 0.25 - 0.5 * p.x + 0.125 * p.y; };
  for (const VertexId v : mesh.vertices()) mesh.set_weight(v, linear(mesh.position(v)));
  ASSERT_TRUE(restore_regularity(mesh).regular());
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    const Vec2 p = (1.0 / 3) * (mesh.position(a) + mesh.position(b) + mesh.position(c));
    const double w = interpolated_weight(mesh, t, p);
    EXPECT_NEAR(w, linear(p), 1e-13);
    EXPECT_EQ(plan_insertion(mesh, {p.x, p.y, w}, t).status, InsertionStatus::possible);
    ++inserted;
  }
  EXPECT_GT(inserted, 50u);
}

TEST(SplitWeight, GivesBothPiecesACrossingInsideWheneverAnyWeightDoes) {
  int linear = 0, moved = 0, none = 0;
  for (const double difference : {0.0, 0.1, 0.3, 0.49, 0.6, 0.9, 1.5}) {
    for (const double t : {0.5, 0.25, 0.7, 0.1, 0.02}) {
      for (const double sign : {1.0, -1.0}) {
        const double a = 0.25, b = a + sign * difference;
        const double w = split_weight(a, b, 1, t);
        const bool exists = difference < t * t + (1 - t) * (1 - t);
        const bool both = std::abs(w - a) < t * t && std::abs(w - b) < (1 - t) * (1 - t);
        EXPECT_EQ(both, exists) << difference << " at " << t;
        const bool is_linear = w == a + t * (b - a);
        if (!exists) {
          EXPECT_TRUE(is_linear);
        }
        ++(!exists ? none : is_linear ? linear : moved);
      }
    }
  }
  EXPECT_GT(linear, 5);
  EXPECT_GT(moved, 5);
  EXPECT_GT(none, 5);
}

TEST(PlanSplit, IsTheSameFromBothSides) {
  Rng rng(7);
  const Mesh mesh = test::mesh_of_random_points(rng, 30);
  std::size_t edges = 0;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (mesh.is_boundary(h)) continue;
    const InsertionPlan one = plan_split(mesh, h, 0.25), other = plan_split(mesh, mesh.twin(h), 0.75);
    EXPECT_EQ(one.point, other.point);
    EXPECT_EQ(one.status, other.status);
    ++edges;
  }
  EXPECT_GT(edges, 100u);
}

TEST(PlanSplit, RefusesAPointRoundedToAnEndOrOverATriangle) {
  Mesh mesh = test::square();
  EXPECT_EQ(plan_split(mesh, edge(mesh, 0, 1), 0x1p-60).status, InsertionStatus::at_vertex);
  EXPECT_EQ(plan_split(mesh, edge(mesh, 0, 1), WeightedPoint{0, 1.5, 0}).status, InsertionStatus::inverted);
  EXPECT_EQ(plan_split(mesh, edge(mesh, 0, 1), 0.5).status, InsertionStatus::possible);
}

TEST(PlanCollapse, FansTheNeighborAndKeepsTheLinkCondition) {
  // A hexagon around 6. Collapsed into 0 its triangles are those of vertex 0.
  Mesh mesh = test::build_or_die({{2, 0}, {1, 2}, {-1, 2}, {-2, 0}, {-1, -2}, {1, -2}, {0, 0}},
                                 {{6, 0, 1}, {6, 1, 2}, {6, 2, 3}, {6, 3, 4}, {6, 4, 5}, {6, 5, 0}});
  const RemovalPlan plan = plan_collapse(mesh, VertexId(6), VertexId(0));
  ASSERT_EQ(plan.status, RemovalStatus::possible);
  ASSERT_EQ(plan.triangles.size(), 4u);
  for (const auto& t : plan.triangles) EXPECT_EQ(t[0], VertexId(0));
  EXPECT_EQ(plan_collapse(mesh, VertexId(0), VertexId(6)).status, RemovalStatus::boundary_corner);
  EXPECT_EQ(plan_collapse(mesh, VertexId(6), VertexId(6)).status, RemovalStatus::no_triangulation);
  mesh.set_constrained(edge(mesh, 6, 0), true);
  mesh.set_constrained(edge(mesh, 6, 3), true);
  EXPECT_EQ(plan_collapse(mesh, VertexId(6), VertexId(1)).status, RemovalStatus::constrained);
  EXPECT_EQ(plan_collapse(mesh, VertexId(6), VertexId(3)).status, RemovalStatus::possible);
  const double area = test::area(mesh);
  remove_vertex(mesh, plan_collapse(mesh, VertexId(6), VertexId(3)));
  EXPECT_EQ(mesh.validate(), std::nullopt);
  EXPECT_EQ(test::area(mesh), area);
  EXPECT_TRUE(mesh.is_constrained(edge(mesh, 0, 3)));
}

TEST(PlanCollapse, RefusesWhereTheFanTurnsATriangleOver) {
  // A star of eight with reflex corners: no corner sees all others.
  std::vector<Vec2> points = {{4, 0}, {1, 1}, {0, 4}, {-1, 1}, {-4, 0}, {-1, -1}, {0, -4}, {1, -1}, {0, 0}};
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (int i = 0; i < 8; ++i) triangles.push_back({8, i, (i + 1) % 8});
  const Mesh mesh = test::build_or_die(points, triangles);
  EXPECT_EQ(plan_collapse(mesh, VertexId(8), VertexId(0)).status, RemovalStatus::no_triangulation);
  EXPECT_EQ(plan_removal(mesh, VertexId(8)).status, RemovalStatus::possible);
}

}  // namespace
}  // namespace temper
