// One flip, looked at closely: what moves, what stays, what is refused.
#include <gtest/gtest.h>

#include "property/mesh_of_random_points.hpp"

namespace temper {
namespace {

//        3            The kite 0 1 3 2: edge 0-1 in the middle, 3 above, 2 below.
//      /   \          .
//     0-----1         .
//      \   /          .
//        2            .
Mesh kite(const std::vector<std::array<std::int32_t, 2>>& constrained = {}) {
  return test::build_or_die({{0, 0}, {2, 0}, {1, -1}, {1, 1}}, {{0, 1, 3}, {1, 0, 2}}, constrained);
}

TEST(Flip, ReplacesTheEdgeByTheOtherDiagonal) {
  Mesh mesh = kite();
  const HalfedgeId h = mesh.find_halfedge(VertexId(0), VertexId(1));
  ASSERT_EQ(can_flip(mesh, h), FlipStatus::possible);
  const HalfedgeId flipped = flip(mesh, h);
  EXPECT_EQ(Mesh::triangle(flipped), Mesh::triangle(h));
  EXPECT_EQ(mesh.origin(flipped), VertexId(2));
  EXPECT_EQ(mesh.target(flipped), VertexId(3));
  EXPECT_FALSE(mesh.find_halfedge(VertexId(0), VertexId(1)).valid());
  EXPECT_EQ(mesh.validate(), std::nullopt);
}

TEST(Flip, FourTimesIsNothing) {
  const Mesh before = kite();
  Mesh mesh = before;
  HalfedgeId h = mesh.find_halfedge(VertexId(0), VertexId(1));
  for (int turn = 0; turn < 4; ++turn) {
    EXPECT_EQ(mesh == before, turn == 0);
    h = flip(mesh, h);
    EXPECT_EQ(mesh.validate(), std::nullopt);
  }
  EXPECT_EQ(mesh, before);
}

TEST(Flip, IsUndoneBitForBit) {
  const Mesh before = kite();
  for (const HalfedgeId h : before.halfedges()) {
    if (before.is_boundary(h)) continue;
    Mesh mesh = before;
    unflip(mesh, flip(mesh, h));
    EXPECT_EQ(mesh, before);
  }
}

TEST(Flip, MovesTheFlagsOfTheOuterEdgesWithThem) {
  Rng rng(7);
  Mesh mesh = test::mesh_of_random_points(rng, 40);
  std::vector<std::pair<VertexId, VertexId>> marked;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_edge_representative(h) || mesh.is_boundary(h) || rng.below(4) != 0) continue;
    mesh.set_constrained(h, true);
    marked.emplace_back(mesh.origin(h), mesh.target(h));
  }
  ASSERT_GT(marked.size(), 10u);
  ASSERT_GT(test::shuffle_flips(mesh, rng, 1000), 100u);
  EXPECT_EQ(mesh.validate(), std::nullopt);
  std::size_t constrained = 0;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (mesh.is_edge_representative(h) && mesh.is_constrained(h)) ++constrained;
  }
  EXPECT_EQ(constrained, marked.size());
  for (const auto& [a, b] : marked) {
    const HalfedgeId h = mesh.find_halfedge(a, b).valid() ? mesh.find_halfedge(a, b) : mesh.find_halfedge(b, a);
    ASSERT_TRUE(h.valid());
    EXPECT_TRUE(mesh.is_constrained(h));
  }
}

TEST(Flip, RefusesTheBoundary) {
  const Mesh mesh = kite();
  EXPECT_EQ(can_flip(mesh, mesh.find_halfedge(VertexId(1), VertexId(3))), FlipStatus::boundary);
}

TEST(Flip, RefusesAConstrainedEdge) {
  const Mesh mesh = kite({{1, 0}});
  EXPECT_EQ(can_flip(mesh, mesh.find_halfedge(VertexId(0), VertexId(1))), FlipStatus::constrained);
  EXPECT_EQ(can_flip(mesh, mesh.find_halfedge(VertexId(1), VertexId(0))), FlipStatus::constrained);
}

TEST(Flip, RefusesAQuadThatIsNotStrictlyConvex) {
  // Vertices 2 and 3 at abscissa x: the quad is reflex, flat or convex at vertex 0.
  for (const double x : {-0.5, 0.0, 0x1p-60, 0.5}) {
    const Mesh mesh = test::build_or_die({{0, 0}, {2, 0}, {x, -1}, {x, 1}}, {{0, 1, 3}, {1, 0, 2}});
    const FlipStatus expected = x > 0 ? FlipStatus::possible : FlipStatus::not_convex;
    EXPECT_EQ(can_flip(mesh, mesh.find_halfedge(VertexId(0), VertexId(1))), expected);
    EXPECT_EQ(can_flip(mesh, mesh.find_halfedge(VertexId(1), VertexId(0))), expected);
  }
}

}  // namespace
}  // namespace temper
