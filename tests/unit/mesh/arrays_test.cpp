// Laws of traversal, and a mesh as a value.
#include <gtest/gtest.h>

#include <set>

#include "mesh/mesh_editor.hpp"
#include "mesh/twins.hpp"
#include "support/std_threads.hpp"
#include "unit/mesh/random_soup.hpp"

namespace temper {
namespace {

using test::Arrays;
using test::built;

/// Meshes with inner and boundary vertices, a hole, and two components; all ids of each are visited.
std::vector<Mesh> samples() {
  Rng rng(5);
  std::vector<Mesh> meshes;
  meshes.push_back(built(test::fan()));
  meshes.push_back(built({{{0, 0}, {1, 0}, {0, 1}}, {{0, 1, 2}}}));
  meshes.push_back(built(test::squares(5, {0, 0}, {{1, 1}, {3, 2}})));
  meshes.push_back(built(test::together(test::squares(3), test::squares(2, {7, 7}))));
  for (int i = 0; i < 5; ++i) meshes.push_back(test::random_triangulation(rng, 20));
  return meshes;
}

TEST(Traversal, NextThreeTimesIsTheSameHalfedgeAndPrevIsItsInverse) {
  for (const Mesh& mesh : samples()) {
    ASSERT_EQ(mesh.n_halfedges(), 3 * mesh.n_triangles());
    for (const HalfedgeId h : mesh.halfedges()) {
      EXPECT_EQ(Mesh::next(Mesh::next(Mesh::next(h))), h);
      EXPECT_EQ(Mesh::prev(Mesh::next(h)), h);
      EXPECT_EQ(Mesh::next(Mesh::prev(h)), h);
      EXPECT_EQ(Mesh::triangle(Mesh::next(h)), Mesh::triangle(h));
      EXPECT_EQ(mesh.target(h), mesh.origin(Mesh::next(h)));
      EXPECT_EQ(mesh.opposite(h), mesh.origin(Mesh::prev(h)));
      EXPECT_EQ(Mesh::halfedge(Mesh::triangle(h), static_cast<int>(h.index % 3)), h);
    }
    for (const TriangleId t : mesh.triangles()) {
      for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(mesh.corners(t)[static_cast<std::size_t>(k)], mesh.origin(Mesh::halfedge(t, k)));
      }
    }
  }
}

TEST(Traversal, TheTwinOfATwinIsTheHalfedgeAndJoinsTheSameVertices) {
  for (const Mesh& mesh : samples()) {
    std::size_t boundary = 0, representatives = 0;
    for (const HalfedgeId h : mesh.halfedges()) {
      representatives += mesh.is_edge_representative(h) ? 1 : 0;
      const HalfedgeId twin = mesh.twin(h);
      EXPECT_EQ(mesh.is_boundary(h), !twin.valid());
      if (!twin.valid()) {
        ++boundary;
        EXPECT_TRUE(mesh.is_boundary(mesh.origin(h)));
        EXPECT_TRUE(mesh.is_boundary(mesh.target(h)));
        continue;
      }
      EXPECT_EQ(mesh.twin(twin), h);
      EXPECT_EQ(mesh.origin(twin), mesh.target(h));
      EXPECT_EQ(mesh.target(twin), mesh.origin(h));
      EXPECT_NE(Mesh::triangle(twin), Mesh::triangle(h));
      EXPECT_NE(mesh.is_edge_representative(h), mesh.is_edge_representative(twin));
    }
    EXPECT_GT(boundary, 0u);
    EXPECT_EQ(mesh.n_edges(), representatives);
    EXPECT_EQ(2 * mesh.n_edges(), mesh.n_halfedges() + boundary);
  }
}

TEST(Traversal, TwinsFollowFromTheCornersForAnyNumberOfThreads) {
  test::StdThreads threads(3);
  for (const Mesh& mesh : samples()) {
    for (Executor* const executor : {static_cast<Executor*>(nullptr), static_cast<Executor*>(&threads)}) {
      Mesh without = mesh;
      for (const HalfedgeId h : without.halfedges()) MeshEditor(without).link(h, h);
      EXPECT_NE(without, mesh);
      find_twins(without, executor);
      EXPECT_EQ(without, mesh);
    }
  }
}

TEST(Traversal, AStarHoldsEveryTriangleOfTheVertexOnceCounterClockwise) {
  std::size_t inner = 0, outer = 0;
  for (const Mesh& mesh : samples()) {
    std::vector<std::set<TriangleId>> incident(mesh.n_vertices());
    for (const HalfedgeId h : mesh.halfedges()) incident[mesh.origin(h).index].insert(Mesh::triangle(h));
    for (const VertexId v : mesh.vertices()) {
      std::vector<HalfedgeId> star;
      for (const HalfedgeId h : mesh.star(v)) star.push_back(h);
      std::set<TriangleId> seen;
      for (const HalfedgeId h : star) {
        EXPECT_EQ(mesh.origin(h), v);
        seen.insert(Mesh::triangle(h));
      }
      EXPECT_EQ(seen.size(), star.size());
      EXPECT_EQ(seen, incident[v.index]);
      for (std::size_t i = 1; i < star.size(); ++i) EXPECT_EQ(mesh.target(star[i]), mesh.opposite(star[i - 1]));
      if (mesh.is_boundary(v)) {
        EXPECT_TRUE(mesh.is_boundary(star.front()));
        EXPECT_TRUE(mesh.is_boundary(Mesh::prev(star.back())));
        EXPECT_FALSE(mesh.rotate(star.back()).valid());
        ++outer;
      } else {
        EXPECT_EQ(mesh.rotate(star.back()), star.front());
        ++inner;
      }
    }
  }
  EXPECT_GT(inner, 50u);
  EXPECT_GT(outer, 50u);
}

TEST(Traversal, FindHalfedgeFindsEveryHalfedgeAndNoOther) {
  for (const Mesh& mesh : samples()) {
    std::size_t found = 0;
    for (const VertexId a : mesh.vertices()) {
      for (const VertexId b : mesh.vertices()) {
        const HalfedgeId h = mesh.find_halfedge(a, b);
        if (!h.valid()) continue;
        EXPECT_EQ(mesh.origin(h), a);
        EXPECT_EQ(mesh.target(h), b);
        ++found;
      }
    }
    EXPECT_EQ(found, mesh.n_halfedges());
  }
}

TEST(Mesh, IsAValue) {
  const Mesh mesh = built(test::squares(3));
  Mesh copy = mesh;
  EXPECT_EQ(copy, mesh);
  copy.set_weight(VertexId(5), 0.25);
  EXPECT_NE(copy, mesh);
  EXPECT_EQ(mesh.weight(VertexId(5)), 0);
  copy = mesh;
  EXPECT_EQ(copy, mesh);
  copy.set_region(TriangleId(1), 7);
  EXPECT_NE(copy, mesh);
  const Mesh moved = std::move(copy);
  EXPECT_EQ(moved.region(TriangleId(1)), 7);
  EXPECT_EQ(moved.n_triangles(), mesh.n_triangles());
}

TEST(Mesh, SettersChangeWhatTheyNameAndNothingElse) {
  const Mesh mesh = built(test::squares(3));
  const VertexId v(5);
  Mesh changed = mesh;
  changed.set_point(v, {1.25, 1.125, 0.5});
  EXPECT_EQ(changed.point(v), (WeightedPoint{1.25, 1.125, 0.5}));
  changed.set_position(v, mesh.position(v));
  EXPECT_EQ(changed.weight(v), 0.5);
  changed.set_weight(v, 0);
  EXPECT_EQ(changed, mesh);
  changed.set_fixed(v, true);
  EXPECT_TRUE(changed.is_fixed(v));
  changed.set_fixed(v, true);
  changed.set_fixed(v, false);
  EXPECT_EQ(changed, mesh);
  for (const HalfedgeId h : mesh.halfedges()) {
    changed.set_constrained(h, true);
    EXPECT_TRUE(changed.is_constrained(h));
    EXPECT_TRUE(!mesh.twin(h).valid() || changed.is_constrained(mesh.twin(h)));
    EXPECT_EQ(changed.validate(), std::nullopt);
    changed.set_constrained(h, false);
    EXPECT_EQ(changed, mesh);
  }
}

TEST(Mesh, OfNothingIsEmptyAndValid) {
  const Mesh mesh;
  EXPECT_EQ(mesh.n_vertices() + mesh.n_triangles() + mesh.n_halfedges() + mesh.n_edges(), 0u);
  EXPECT_EQ(mesh.memory_bytes(), 0u);
  EXPECT_EQ(mesh.validate(), std::nullopt);
}

TEST(Mesh, NeedsAtMost80BytesAVertexAnd14MoreForConstraintsAndRegions) {
  Mesh mesh = built(test::squares(60));
  const auto bytes = [&] { return static_cast<double>(mesh.memory_bytes()) / static_cast<double>(mesh.n_vertices()); };
  EXPECT_GT(bytes(), 70);
  EXPECT_LT(bytes(), 80);
  mesh.set_constrained(HalfedgeId(5), true);
  mesh.set_region(TriangleId(7), -1);
  EXPECT_GT(bytes(), 83);
  EXPECT_LT(bytes(), 94);
}

TEST(Mesh, DoesNotShowWhetherArraysOfZerosAreThere) {
  const Mesh untouched = built(test::squares(3));
  Mesh mesh = untouched;
  mesh.set_constrained(HalfedgeId(4), false);
  mesh.set_region(TriangleId(2), 0);
  EXPECT_EQ(mesh.memory_bytes(), untouched.memory_bytes());
  mesh.set_constrained(HalfedgeId(4), true);
  mesh.set_region(TriangleId(2), 3);
  EXPECT_NE(mesh, untouched);
  EXPECT_NE(untouched, mesh);
  EXPECT_EQ(mesh.validate(), std::nullopt);
  for (const HalfedgeId h : mesh.halfedges()) {
    EXPECT_EQ(mesh.is_constrained(h), h == HalfedgeId(4) || h == mesh.twin(HalfedgeId(4)));
  }
  for (const TriangleId t : mesh.triangles()) EXPECT_EQ(mesh.region(t), t == TriangleId(2) ? 3 : 0);
  mesh.set_constrained(HalfedgeId(4), false);
  mesh.set_region(TriangleId(2), 0);
  EXPECT_GT(mesh.memory_bytes(), untouched.memory_bytes());
  EXPECT_EQ(mesh, untouched);
  EXPECT_EQ(untouched, mesh);
}

TEST(Mesh, KeepsFlagsAndRegionsOfAddedTriangles) {
  // The second triangle is the first that has a region, the third comes after it.
  Mesh mesh;
  for (const Vec2 p : {Vec2{0, 0}, {1, 0}, {0, 1}}) MeshEditor(mesh).add_vertex({p.x, p.y, 0});
  for (const std::int32_t region : {0, 7, 0}) {
    MeshEditor(mesh).add_triangle({VertexId(0), VertexId(1), VertexId(2)}, region);
  }
  EXPECT_EQ(mesh.region(TriangleId(0)), 0);
  EXPECT_EQ(mesh.region(TriangleId(1)), 7);
  EXPECT_EQ(mesh.region(TriangleId(2)), 0);
  mesh.set_constrained(HalfedgeId(8), true);
  MeshEditor(mesh).add_triangle({VertexId(0), VertexId(1), VertexId(2)}, 9);
  EXPECT_TRUE(mesh.is_constrained(HalfedgeId(8)));
  EXPECT_FALSE(mesh.is_constrained(HalfedgeId(11)));
  MeshEditor(mesh).erase(TriangleId(1));
  const Compaction kept = mesh.compact();
  EXPECT_EQ(kept.triangles.size(), 3u);
  EXPECT_EQ(mesh.region(TriangleId(2)), 9);
  EXPECT_TRUE(mesh.is_constrained(HalfedgeId(5)));
}

}  // namespace
}  // namespace temper
