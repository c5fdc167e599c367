// New vertices: in a triangle, on an inner edge, on the boundary.
#include <gtest/gtest.h>

#include "mesh/mesh_editor.hpp"
#include "property/mesh_of_random_points.hpp"

namespace temper {
namespace {

double total_doubled_area(const Mesh& mesh) {
  double sum = 0;
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    sum += doubled_area(mesh.position(a), mesh.position(b), mesh.position(c));
  }
  return sum;
}

// The square in two regions, with their interface 0-2 constrained.
Mesh two_regions() {
  const std::vector<Vec2> points = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  const std::vector<std::array<std::int32_t, 3>> triangles = {{0, 1, 2}, {0, 2, 3}};
  const std::vector<std::int32_t> regions = {5, 9};
  MeshInput input;
  input.points = points;
  input.triangles = triangles;
  input.regions = regions;
  return Mesh::build(input)->mesh;
}

TEST(InsertInTriangle, MakesThreeOfOneInItsRegion) {
  Mesh mesh = two_regions();
  ASSERT_TRUE(test::has_canonical_outgoing(mesh));
  const VertexId v = insert_in_triangle(mesh, TriangleId(1), {-0.5, 0.25, 0.125});
  EXPECT_EQ(v, VertexId(4));
  EXPECT_EQ(mesh.point(v), (WeightedPoint{-0.5, 0.25, 0.125}));
  EXPECT_EQ(mesh.n_triangles(), 4u);
  EXPECT_EQ(mesh.validate(), std::nullopt);
  EXPECT_EQ(total_doubled_area(mesh), 8);
  int spokes = 0;
  for (const HalfedgeId h : mesh.star(v)) {
    EXPECT_EQ(mesh.region(Mesh::triangle(h)), 9);
    EXPECT_FALSE(mesh.is_constrained(h));
    ++spokes;
  }
  EXPECT_EQ(spokes, 3);
  EXPECT_TRUE(mesh.is_constrained(mesh.find_halfedge(VertexId(0), VertexId(2))));
  EXPECT_FALSE(mesh.is_boundary(v));
}

TEST(SplitEdge, OfAnInterfaceConstrainsBothHalvesAndKeepsRegionsApart) {
  for (const bool other_side : {false, true}) {
    Mesh mesh = two_regions();
    HalfedgeId h = mesh.find_halfedge(VertexId(0), VertexId(2));
    if (other_side) h = mesh.twin(h);
    const VertexId v = split_edge(mesh, h, {0.25, 0.25, 0});
    EXPECT_EQ(mesh.n_triangles(), 4u);
    EXPECT_EQ(mesh.validate(), std::nullopt);
    EXPECT_EQ(total_doubled_area(mesh), 8);
    int constrained = 0, spokes = 0;
    for (const HalfedgeId s : mesh.star(v)) {
      constrained += mesh.is_constrained(s) ? 1 : 0;
      const bool interface = mesh.region(Mesh::triangle(s)) != mesh.region(Mesh::triangle(mesh.twin(s)));
      EXPECT_EQ(mesh.is_constrained(s), interface);
      ++spokes;
    }
    EXPECT_EQ(constrained, 2);
    EXPECT_EQ(spokes, 4);
  }
}

TEST(SplitEdge, OfTheBoundaryMakesTwoOfOneTriangle) {
  for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {2, 3}, {3, 0}}) {
    Mesh mesh = two_regions();
    const Vec2 p = mesh.position(VertexId(a)), q = mesh.position(VertexId(b));
    const VertexId v =
        split_edge(mesh, mesh.find_halfedge(VertexId(a), VertexId(b)), {0.5 * (p.x + q.x), 0.5 * (p.y + q.y), 0});
    EXPECT_EQ(mesh.n_triangles(), 3u);
    EXPECT_TRUE(mesh.is_boundary(v));
    EXPECT_EQ(mesh.validate(), std::nullopt);
    EXPECT_EQ(total_doubled_area(mesh), 8);
  }
}

// The star of vertex 0 is cut open far from what changes. Whoever walks around the vertex comes upon the cut, and takes
// it for the boundary.
TEST(Topology, InsertionsDoNotWalkAroundTheVerticesOfTheTriangle) {
  constexpr std::size_t kTriangles = 30;
  std::vector<Vec2> points = {{0, 0}};
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (std::size_t i = 0; i < kTriangles; ++i) {
    const double angle = 6.283185307179586 * static_cast<double>(i) / kTriangles;
    points.push_back({std::cos(angle), std::sin(angle)});
    triangles.push_back({0, static_cast<std::int32_t>(i + 1), static_cast<std::int32_t>((i + 1) % kTriangles + 1)});
  }
  Mesh cut = test::build_or_die(points, triangles);
  const VertexId hub(0);
  const HalfedgeId far = cut.find_halfedge(hub, VertexId(kTriangles / 2)), twin = cut.twin(far);
  MeshEditor(cut).link(far, HalfedgeId());
  MeshEditor(cut).link(twin, HalfedgeId());
  const Vec2 near = 0.25 * (points[3] + points[4]);
  for (const bool on_edge : {false, true}) {
    Mesh mesh = cut;
    const HalfedgeId first = mesh.find_halfedge(hub, VertexId(3));
    const VertexId v = on_edge ? split_edge(mesh, first, {0.5 * points[3].x, 0.5 * points[3].y, 0})
                               : insert_in_triangle(mesh, Mesh::triangle(first), {near.x, near.y, 0});
    EXPECT_NE(mesh.outgoing(hub), far);
    EXPECT_EQ(mesh.origin(mesh.outgoing(hub)), hub);
    EXPECT_TRUE(mesh.find_halfedge(v, hub).valid());
  }
}

TEST(Topology, AnyMixOfInsertionsAndFlipsKeepsTheMeshValid) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Rng rng(seed);
    const Mesh mesh = test::mesh_of_random_points(rng, 60, seed % 2 == 0 ? 16 : 0);
    ASSERT_EQ(mesh.validate(), std::nullopt) << "seed " << seed;
    ASSERT_TRUE(test::has_canonical_outgoing(mesh)) << "seed " << seed;
    ASSERT_GT(mesh.n_vertices(), 40u);
    ASSERT_EQ(mesh.n_vertices() + mesh.n_triangles(), mesh.n_edges() + 1);
    ASSERT_DOUBLE_EQ(total_doubled_area(mesh), 8);
  }
}

TEST(Topology, UndoingFlipsInReverseRestoresEveryBit) {
  std::size_t flips = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Rng rng(seed);
    Mesh mesh = test::mesh_of_random_points(rng, 30, seed % 2 == 0 ? 8 : 0);
    const Mesh before = mesh;
    std::vector<HalfedgeId> journal;
    for (int i = 0; i < 200; ++i) {
      const HalfedgeId h(std::size_t{rng.below(static_cast<std::uint32_t>(mesh.n_halfedges()))});
      if (can_flip(mesh, h) == FlipStatus::possible) journal.push_back(flip(mesh, h));
    }
    flips += journal.size();
    for (; !journal.empty(); journal.pop_back()) unflip(mesh, journal.back());
    ASSERT_EQ(mesh, before) << "seed " << seed;
  }
  EXPECT_GT(flips, 1000u);
}

}  // namespace
}  // namespace temper
