// Vertex removal, looked at closely: each status, what moves, what stays, and plans read back from numbers.
#include <gtest/gtest.h>

#include <numeric>

#include "mesh/mesh_editor.hpp"
#include "property/mesh_of_random_points.hpp"
#include "support/shapes.hpp"
#include "temper/regularity.hpp"

namespace temper {
namespace {

using Corners = std::array<VertexId, 3>;

Mesh built(const std::vector<Vec2>& points, const std::vector<std::array<std::int32_t, 3>>& triangles,
           const std::vector<std::int32_t>& regions = {}, const std::vector<double>& weights = {}) {
  MeshInput input;
  input.points = points;
  input.triangles = triangles;
  input.regions = regions;
  input.weights = weights;
  return Mesh::build(input)->mesh;
}

// A hexagon of corners 0 … 5 around vertex 6.
Mesh hexagon(const std::vector<std::int32_t>& regions = {}, const std::vector<double>& weights = {}) {
  return built({{2, 0}, {1, 2}, {-1, 2}, {-2, 0}, {-1, -2}, {1, -2}, {0, 0}},
               {{6, 0, 1}, {6, 1, 2}, {6, 2, 3}, {6, 3, 4}, {6, 4, 5}, {6, 5, 0}}, regions, weights);
}

//   3-----2-----1        Vertex 5 in the middle of the bottom side; the dots are its spokes to 3, 2 and 1.
//   |  .  .  .  |        .
//   4-----5-----0        .
Mesh bottom_side(double y = 0) {
  return built({{2, 0}, {2, 2}, {0, 3}, {-2, 2}, {-2, 0}, {0, y}}, {{5, 0, 1}, {5, 1, 2}, {5, 2, 3}, {5, 3, 4}});
}

const VertexId kCenter(6), kBottom(5);

RemovalStatus removal_status(const Mesh& mesh, VertexId v) { return plan_removal(mesh, v).status; }

void constrain(Mesh& mesh, std::size_t a, std::size_t b) {
  mesh.set_constrained(mesh.find_halfedge(VertexId(a), VertexId(b)), true);
}

TEST(PlanRemoval, OfAnInnerVertexFillsItsLinkFromTheSmallestNeighborOn) {
  const RemovalPlan plan = plan_removal(hexagon(), kCenter);
  EXPECT_EQ(plan.status, RemovalStatus::possible);
  EXPECT_EQ(plan.vertex, kCenter);
  ASSERT_EQ(plan.link.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(plan.link[i], VertexId(i));
  EXPECT_EQ(plan.triangles.size(), 4u);
}

TEST(PlanRemoval, ReusesStorage) {
  const Mesh mesh = hexagon();
  RemovalPlan plan = plan_removal(mesh, kCenter);
  const VertexId* link = plan.link.data();
  const Corners* triangles = plan.triangles.data();
  plan = plan_removal(mesh, kCenter, std::move(plan));
  EXPECT_EQ(plan.status, RemovalStatus::possible);
  EXPECT_EQ(plan.triangles.size(), 4u);
  EXPECT_EQ(plan.link.data(), link);
  EXPECT_EQ(plan.triangles.data(), triangles);
}

TEST(PlanRemoval, RefusesAFixedVertex) {
  Mesh mesh = hexagon();
  mesh.set_fixed(kCenter, true);
  EXPECT_EQ(removal_status(mesh, kCenter), RemovalStatus::fixed);
}

TEST(PlanRemoval, RefusesACornerOfTheBoundaryHoweverBlunt) {
  EXPECT_EQ(removal_status(hexagon(), VertexId(0)), RemovalStatus::boundary_corner);
  EXPECT_EQ(removal_status(bottom_side(0x1p-50), kBottom), RemovalStatus::boundary_corner);
  EXPECT_EQ(removal_status(bottom_side(-0x1p-50), kBottom), RemovalStatus::boundary_corner);
  EXPECT_EQ(removal_status(bottom_side(), kBottom), RemovalStatus::possible);
}

TEST(PlanRemoval, RefusesTheTipOfASlit) {
  // The two boundary edges of vertex 4 run back to back: collinear, but not in line.
  Mesh mesh = built({{1, -1}, {1, 1}, {-1, 1}, {-1, -1}, {0, 0}}, {{4, 0, 1}, {4, 1, 2}, {4, 2, 3}, {4, 3, 0}});
  const HalfedgeId h = mesh.find_halfedge(VertexId(4), VertexId(0)), g = mesh.twin(h);
  MeshEditor(mesh).link(h, HalfedgeId()), MeshEditor(mesh).link(g, HalfedgeId());
  MeshEditor(mesh).set_outgoing(VertexId(4), canonical_outgoing(mesh, h));
  EXPECT_EQ(removal_status(mesh, VertexId(4)), RemovalStatus::boundary_corner);
}

TEST(PlanRemoval, RefusesAFoldWhoseArmsLieOnOneAnother) {
  Mesh mesh =
      built({{1, 0}, {0, 2}, {-2, 0}, {0, -2}, {2, -0.5}, {0, 0}}, {{5, 0, 1}, {5, 1, 2}, {5, 2, 3}, {5, 3, 4}});
  mesh.set_position(VertexId(4), {2, 0});  // the boundary comes from 4 over 5 back to 0, on the same line
  EXPECT_EQ(removal_status(mesh, VertexId(5)), RemovalStatus::boundary_corner);
}

TEST(PlanRemoval, RefusesAnEndABendAndACrossingOfConstrainedEdges) {
  for (const std::vector<std::size_t>& ends : {std::vector<std::size_t>{0}, {0, 2}, {0, 1, 2}, {0, 3, 1}}) {
    Mesh mesh = hexagon();
    for (const std::size_t end : ends) constrain(mesh, 6, end);
    EXPECT_EQ(removal_status(mesh, kCenter), RemovalStatus::constrained);
  }
}

TEST(PlanRemoval, RefusesRegionsWithoutAConstrainedEdgeBetween) {
  Mesh mesh = hexagon();
  mesh.set_region(TriangleId(0), 3);
  EXPECT_EQ(removal_status(mesh, kCenter), RemovalStatus::constrained);
}

TEST(PlanRemoval, RefusesABoundaryLineWhoseHalvesHaveDifferentFlags) {
  Mesh mesh = bottom_side();
  mesh.set_constrained(mesh.outgoing(kBottom), true);
  EXPECT_EQ(removal_status(mesh, kBottom), RemovalStatus::constrained);
  constrain(mesh, 4, 5);
  EXPECT_EQ(removal_status(mesh, kBottom), RemovalStatus::possible);
  constrain(mesh, 5, 2);
  EXPECT_EQ(removal_status(mesh, kBottom), RemovalStatus::constrained);
}

TEST(PlanRemoval, HasNoTriangulationOfAnIsolatedVertexOrWhereTheNewEdgeExists) {
  Mesh mesh = bottom_side();
  const VertexId lonely = MeshEditor(mesh).add_vertex({9, 9, 0});
  EXPECT_EQ(removal_status(mesh, lonely), RemovalStatus::no_triangulation);
  // A flap from vertex 4 to vertex 0, below: with vertex 5 gone the boundary would be edge 4-0 a second time.
  const VertexId below = MeshEditor(mesh).add_vertex({0, -1, 0});
  const TriangleId flap = MeshEditor(mesh).add_triangle({VertexId(4), below, VertexId(0)}, 0);
  MeshEditor(mesh).set_outgoing(VertexId(0), Mesh::halfedge(flap, 2));
  EXPECT_EQ(removal_status(mesh, kBottom), RemovalStatus::no_triangulation);
}

TEST(PlanRemoval, IsRegularInACavityThatIsNotConvex) {
  // A star of eight with reflex corners at the odd ones. Restoring finds nothing to do afterwards.
  std::vector<Vec2> points;
  std::vector<std::array<std::int32_t, 3>> triangles;
  const std::array<Vec2, 8> rim = {{{4, 0}, {1, 1}, {0, 5}, {-1, 1}, {-4, 0}, {-1, -1}, {0, -4}, {1, -1}}};
  for (int i = 0; i < 8; ++i) {
    points.push_back(rim[static_cast<std::size_t>(i)]);
    triangles.push_back({8, i, (i + 1) % 8});
  }
  points.push_back({0.125, 0.25});
  Mesh mesh = built(points, triangles);
  const double area = test::area(mesh);
  remove_vertex(mesh, plan_removal(mesh, VertexId(8)));
  EXPECT_EQ(mesh.validate(), std::nullopt);
  EXPECT_EQ(restore_regularity(mesh).flips, 0u);
  EXPECT_DOUBLE_EQ(test::area(mesh), area);
}

TEST(RemoveVertex, PutsTheTrianglesInTheSlotsOfTheStarInOrder) {
  Mesh mesh = hexagon();
  const RemovalPlan plan = plan_removal(mesh, kCenter);
  std::vector<TriangleId> slots;
  for (HalfedgeId h = plan.first; slots.size() < 6; h = mesh.rotate(h)) slots.push_back(Mesh::triangle(h));
  remove_vertex(mesh, plan);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(mesh.corners(slots[i]), plan.triangles[i]);
  EXPECT_TRUE(mesh.is_erased(slots[4]));
  EXPECT_TRUE(mesh.is_erased(slots[5]));
  EXPECT_TRUE(mesh.is_isolated(kCenter));
  EXPECT_EQ(mesh.n_edges(), 9u);
  EXPECT_EQ(mesh.validate(), std::nullopt);
  const Compaction kept = mesh.compact();
  EXPECT_EQ(kept.vertices.size(), 6u);
  EXPECT_EQ(mesh.n_triangles(), 4u);
  EXPECT_EQ(mesh.validate(), std::nullopt);
}

TEST(RemoveVertex, OfAStraightBoundaryKeepsTheDomainAndItsFlag) {
  for (const bool flag : {false, true}) {
    Mesh mesh = bottom_side();
    const double area = test::area(mesh);
    mesh.set_constrained(mesh.outgoing(kBottom), flag);
    mesh.set_constrained(mesh.find_halfedge(VertexId(4), kBottom), flag);
    constrain(mesh, 1, 2);
    remove_vertex(mesh, plan_removal(mesh, kBottom));
    EXPECT_EQ(mesh.validate(), std::nullopt);
    const HalfedgeId line = mesh.find_halfedge(VertexId(4), VertexId(0));
    ASSERT_TRUE(line.valid());
    EXPECT_TRUE(mesh.is_boundary(line));
    EXPECT_EQ(mesh.outgoing(VertexId(4)), line);
    EXPECT_EQ(mesh.is_constrained(line), flag);
    EXPECT_TRUE(mesh.is_constrained(mesh.find_halfedge(VertexId(1), VertexId(2))));
    EXPECT_EQ(mesh.n_edges(), 7u);
    mesh.compact();
    EXPECT_EQ(test::area(mesh), area);
  }
}

TEST(RemoveVertex, OfAStraightInterfaceKeepsBothRegionsAndTheLine) {
  // The line 0-6-3; regions 7 above and 8 below, and the other way round.
  for (const std::int32_t above : {7, 8}) {
    const std::int32_t below = 15 - above;
    Mesh mesh = hexagon({above, above, above, below, below, below});
    constrain(mesh, 4, 5);
    ASSERT_TRUE(mesh.is_constrained(mesh.find_halfedge(kCenter, VertexId(3))));
    const RemovalPlan plan = plan_removal(mesh, kCenter);
    ASSERT_EQ(plan.status, RemovalStatus::possible);
    remove_vertex(mesh, plan);
    EXPECT_EQ(mesh.validate(), std::nullopt);
    const HalfedgeId line = mesh.find_halfedge(VertexId(3), VertexId(0));  // its left is above
    ASSERT_TRUE(line.valid());
    ASSERT_FALSE(mesh.is_boundary(line));
    EXPECT_TRUE(mesh.is_constrained(line));
    EXPECT_EQ(mesh.region(Mesh::triangle(line)), above);
    EXPECT_EQ(mesh.region(Mesh::triangle(mesh.twin(line))), below);
    EXPECT_TRUE(mesh.is_constrained(mesh.find_halfedge(VertexId(4), VertexId(5))));
    mesh.compact();
    std::size_t constrained = 0;
    for (const HalfedgeId h : mesh.halfedges()) {
      constrained += mesh.is_edge_representative(h) && mesh.is_constrained(h) ? 1 : 0;
      if (mesh.is_boundary(h)) continue;
      EXPECT_EQ(mesh.is_constrained(h), mesh.region(Mesh::triangle(h)) != mesh.region(Mesh::triangle(mesh.twin(h))));
    }
    EXPECT_EQ(constrained, 2u);
    EXPECT_EQ(mesh.n_triangles(), 4u);
  }
}

TEST(RemoveVertex, GivesEveryTriangleTheRegionOfTheStar) {
  Mesh mesh = hexagon({4, 4, 4, 4, 4, 4});
  remove_vertex(mesh, plan_removal(mesh, kCenter));
  mesh.compact();
  for (const TriangleId t : mesh.triangles()) EXPECT_EQ(mesh.region(t), 4);
}

/// The same mesh with its triangles in other slots, their corners in the same order.
Mesh with_slots(const Mesh& mesh, const std::vector<std::size_t>& from) {
  std::vector<Vec2> points;
  std::vector<double> weights;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int32_t> regions;
  for (const VertexId v : mesh.vertices()) points.push_back(mesh.position(v)), weights.push_back(mesh.weight(v));
  for (const std::size_t t : from) {
    const auto [a, b, c] = mesh.corners(TriangleId(t));
    triangles.push_back({static_cast<int>(a.index), static_cast<int>(b.index), static_cast<int>(c.index)});
    regions.push_back(mesh.region(TriangleId(t)));
  }
  return built(points, triangles, regions, weights);
}

TEST(RemoveVertex, DoesTheSameWhateverTheSlots) {
  std::size_t removed = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Rng rng(seed);
    Mesh mesh = test::mesh_of_random_points(rng, 25, seed % 2 == 0 ? 8 : 0);
    std::vector<std::size_t> from(mesh.n_triangles());
    std::iota(from.begin(), from.end(), std::size_t{0});
    for (std::size_t i = from.size(); i > 1; --i)
      std::swap(from[i - 1], from[rng.below(static_cast<std::uint32_t>(i))]);
    Mesh other = with_slots(mesh, from);
    for (const VertexId v : mesh.vertices()) {
      const RemovalPlan plan = plan_removal(mesh, v);
      const RemovalPlan own = plan_removal(other, v);
      ASSERT_EQ(plan.status, own.status);
      if (plan.status != RemovalStatus::possible) continue;
      ASSERT_EQ(plan.triangles, own.triangles);
      const RemovalPlan told = removal_from_names(other, v, plan.link[0], plan.triangles);
      ASSERT_EQ(told.status, RemovalStatus::possible);
      EXPECT_EQ(told.link, plan.link);
      EXPECT_EQ(told.first, own.first);
      remove_vertex(mesh, plan);
      remove_vertex(other, told);
      ++removed;
    }
    EXPECT_EQ(mesh.validate(), std::nullopt);
    EXPECT_EQ(other.validate(), std::nullopt);
    for (std::size_t t = 0; t < from.size(); ++t) {
      ASSERT_EQ(other.corners(TriangleId(t)), mesh.corners(TriangleId(from[t])));
    }
    EXPECT_TRUE(test::has_canonical_outgoing(mesh));
    EXPECT_TRUE(test::has_canonical_outgoing(other));
  }
  EXPECT_GT(removed, 300u);
}

TEST(RemovalFromNames, AcceptsAnyTriangulationOfTheCavity) {
  const Mesh mesh = hexagon();
  const auto v = [](std::size_t i) { return VertexId(i); };
  const std::vector<Corners> fan = {{v(2), v(3), v(4)}, {v(4), v(5), v(2)}, {v(2), v(5), v(0)}, {v(1), v(2), v(0)}};
  for (std::size_t first = 0; first < 6; ++first) {
    Mesh copy = mesh;
    const RemovalPlan plan = removal_from_names(copy, kCenter, v(first), fan);
    ASSERT_EQ(plan.status, RemovalStatus::possible);
    EXPECT_EQ(plan.link[0], v(first));
    remove_vertex(copy, plan);
    EXPECT_EQ(copy.validate(), std::nullopt);
  }
}

TEST(RemovalFromNames, TakesALineFromEitherEnd) {
  const Mesh mesh = hexagon({1, 1, 1, 2, 2, 2});
  const auto v = [](std::size_t i) { return VertexId(i); };
  const std::vector<Corners> above = {{v(0), v(1), v(3)}, {v(1), v(2), v(3)}};
  const std::vector<Corners> below = {{v(3), v(4), v(5)}, {v(3), v(5), v(0)}};
  for (const bool other_end : {false, true}) {
    std::vector<Corners> all = other_end ? below : above;
    const std::vector<Corners>& second = other_end ? above : below;
    all.insert(all.end(), second.begin(), second.end());
    Mesh copy = mesh;
    const RemovalPlan plan = removal_from_names(copy, kCenter, v(other_end ? 3 : 0), all);
    ASSERT_EQ(plan.status, RemovalStatus::possible);
    remove_vertex(copy, plan);
    EXPECT_EQ(copy.validate(), std::nullopt);
    EXPECT_EQ(copy.region(Mesh::triangle(copy.find_halfedge(v(3), v(0)))), 1);
    EXPECT_EQ(removal_from_names(mesh, kCenter, v(other_end ? 0 : 3), all).status, RemovalStatus::no_triangulation);
    EXPECT_EQ(removal_from_names(mesh, kCenter, v(1), all).status, RemovalStatus::no_triangulation);
  }
}

TEST(RemovalFromNames, RefusesWhatIsNotATriangulation) {
  const Mesh mesh = hexagon();
  const auto v = [](std::size_t i) { return VertexId(i); };
  const auto status = [&](const std::vector<Corners>& triangles) {
    return removal_from_names(mesh, kCenter, v(0), triangles).status;
  };
  const Corners a = {v(0), v(1), v(2)}, b = {v(0), v(2), v(3)}, c = {v(0), v(3), v(4)}, d = {v(0), v(4), v(5)};
  ASSERT_EQ(status({a, b, c, d}), RemovalStatus::possible);
  EXPECT_EQ(status({}), RemovalStatus::no_triangulation);
  EXPECT_EQ(status({a, b, c}), RemovalStatus::no_triangulation);
  EXPECT_EQ(status({a, b, c, d, d}), RemovalStatus::no_triangulation);
  EXPECT_EQ(status({a, b, c, c}), RemovalStatus::no_triangulation);
  EXPECT_EQ(status({a, b, c, {v(0), v(5), v(4)}}), RemovalStatus::no_triangulation);
  EXPECT_EQ(status({a, b, c, {v(6), v(4), v(5)}}), RemovalStatus::no_triangulation);
  EXPECT_EQ(status({a, b, c, {v(0), v(4), v(99)}}), RemovalStatus::no_triangulation);
  EXPECT_EQ(status({a, b, c, {VertexId(), v(4), v(5)}}), RemovalStatus::no_triangulation);
  EXPECT_EQ(status({a, {v(2), v(3), v(4)}, c, d}), RemovalStatus::no_triangulation);
  // Every side once, but inner edges that do not meet.
  const Corners ear2 = {v(2), v(3), v(4)}, ear4 = {v(4), v(5), v(0)};
  ASSERT_EQ(status({a, ear2, ear4, {v(0), v(2), v(4)}}), RemovalStatus::possible);
  EXPECT_EQ(status({a, ear2, ear4, {v(1), v(3), v(5)}}), RemovalStatus::no_triangulation);
  const std::vector<Corners> good = {a, b, c, d};
  EXPECT_EQ(removal_from_names(mesh, v(99), v(0), good).status, RemovalStatus::no_triangulation);
  EXPECT_EQ(removal_from_names(mesh, VertexId(), v(0), good).status, RemovalStatus::no_triangulation);
  EXPECT_EQ(removal_from_names(mesh, kCenter, v(99), good).status, RemovalStatus::no_triangulation);
  EXPECT_EQ(removal_from_names(mesh, kCenter, kCenter, good).status, RemovalStatus::no_triangulation);
  EXPECT_EQ(removal_from_names(mesh, v(1), v(0), good).status, RemovalStatus::boundary_corner);
}

TEST(RemovalFromNames, RefusesADiagonalOutsideTheCavity) {
  // A dart, reflex at vertex 1: edges all fit for the diagonal 0-2, but triangle 0-1-2 is clockwise.
  const Mesh mesh =
      built({{-2, -1}, {0, -0.25}, {2, -1}, {0, 4}, {0, 1}}, {{4, 0, 1}, {4, 1, 2}, {4, 2, 3}, {4, 3, 0}});
  const auto v = [](std::size_t i) { return VertexId(i); };
  const std::vector<Corners> inside = {{v(0), v(1), v(3)}, {v(1), v(2), v(3)}};
  const std::vector<Corners> outside = {{v(0), v(1), v(2)}, {v(0), v(2), v(3)}};
  EXPECT_EQ(removal_from_names(mesh, v(4), v(0), inside).status, RemovalStatus::possible);
  EXPECT_EQ(removal_from_names(mesh, v(4), v(0), outside).status, RemovalStatus::no_triangulation);
  EXPECT_EQ(plan_removal(mesh, v(4)).triangles.size(), 2u);
}

TEST(RemovalFromNames, OfABoundaryVertexStartsAtItsBoundaryHalfedge) {
  const Mesh mesh = bottom_side();
  const RemovalPlan plan = plan_removal(mesh, kBottom);
  ASSERT_EQ(plan.link[0], VertexId(0));
  EXPECT_EQ(removal_from_names(mesh, kBottom, VertexId(0), plan.triangles).status, RemovalStatus::possible);
  EXPECT_EQ(removal_from_names(mesh, kBottom, VertexId(1), plan.triangles).status, RemovalStatus::no_triangulation);
}

}  // namespace
}  // namespace temper
