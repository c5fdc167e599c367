// Regularity on meshes small enough to know the answer.
#include "temper/regularity.hpp"

#include <gtest/gtest.h>

#include "property/mesh_of_random_points.hpp"
#include "regularity/hidden.hpp"
#include "regularity/lawson.hpp"

namespace temper {
namespace {

// The square with its diagonal 0-2: four cocircular points.
TEST(Regularity, ATieIsRegularAndTheEdgeIsKept) {
  Mesh mesh = test::square();
  const Mesh before = mesh;
  EXPECT_EQ(count_non_regular_edges(mesh), 0u);
  EXPECT_EQ(restore_regularity(mesh).flips, 0u);
  EXPECT_EQ(mesh, before);
}

TEST(Regularity, TheLeastWeightThatCountsFlipsTheDiagonal) {
  Mesh mesh = test::square();
  const HalfedgeId diagonal = mesh.find_halfedge(VertexId(0), VertexId(2));
  mesh.set_weight(VertexId(1), 0x1p-400);
  EXPECT_FALSE(is_regular(mesh, diagonal));
  EXPECT_FALSE(is_regular(mesh, mesh.twin(diagonal)));
  const Restoration restored = restore_regularity(mesh);
  EXPECT_EQ(restored.flips, 1u);
  EXPECT_TRUE(restored.regular());
  EXPECT_TRUE(mesh.find_halfedge(VertexId(1), VertexId(3)).valid());
  EXPECT_EQ(mesh.validate(), std::nullopt);
}

TEST(Regularity, BoundaryEdgesAreRegularWhateverTheirDual) {
  const Mesh mesh = test::build_or_die({{0, 0}, {4, 0}, {2, 0.1}}, {{0, 1, 2}});
  for (const HalfedgeId h : mesh.halfedges()) EXPECT_TRUE(is_regular(mesh, h));
}

TEST(Regularity, ConstrainedEdgesAreCountedButNotFlipped) {
  Mesh mesh = test::square();
  mesh.set_constrained(mesh.find_halfedge(VertexId(0), VertexId(2)), true);
  mesh.set_weight(VertexId(1), 0.5);
  EXPECT_EQ(count_non_regular_edges(mesh, true), 1u);
  EXPECT_EQ(count_non_regular_edges(mesh, false), 0u);
  const Mesh before = mesh;
  const Restoration restored = restore_regularity(mesh);
  EXPECT_TRUE(restored.regular());
  EXPECT_EQ(mesh, before);
}

TEST(Regularity, ADegreeThreeVertexBelowTheThresholdIsHidden) {
  // Centroid of a triangle with power |a|² = 4 to its corners: the vertex shows while −w < 4.
  for (const double w : {-3.99, -4.0, -4.01}) {
    Mesh mesh = test::build_or_die({{2, 0}, {-1, 1.7320508}, {-1, -1.7320508}}, {{0, 1, 2}});
    const VertexId v = insert_in_triangle(mesh, TriangleId(0), {0, 0, w});
    const Restoration restored = restore_regularity(mesh);
    EXPECT_EQ(restored.flips, 0u);
    if (w > -4) {
      EXPECT_TRUE(restored.regular()) << w;
      EXPECT_TRUE(restored.hidden.empty());
    } else if (w < -4) {
      EXPECT_EQ(restored.stuck.size(), 3u);
      EXPECT_EQ(restored.hidden, std::vector<VertexId>{v});
    }
  }
}

TEST(Regularity, AFlatBoundaryVertexCanBeHidden) {
  // Vertex 1 halfway along the bottom: hidden when its power at the middle, −w, exceeds 1.
  for (const double w : {-0.5, -1.5}) {
    Mesh mesh = test::build_or_die({{-1, 0}, {0, 0}, {1, 0}, {0, 1}}, {{0, 1, 3}, {1, 2, 3}});
    mesh.set_weight(VertexId(1), w);
    const Restoration restored = restore_regularity(mesh);
    if (w > -1) {
      EXPECT_TRUE(restored.regular());
    } else {
      EXPECT_EQ(restored.hidden, std::vector<VertexId>{VertexId(1)});
      EXPECT_EQ(restored.stuck.size(), 1u);
    }
  }
}

TEST(Regularity, AReflexCornerWithoutPowerCellIsNamed) {
  // A dart: reflex at vertex 3. Its edge to vertex 1 is stuck when vertex 3 is light.
  Mesh mesh = test::build_or_die({{-2, -1}, {0, 4}, {2, -1}, {0, 0}}, {{0, 3, 1}, {3, 2, 1}});
  mesh.set_weight(VertexId(3), -40);
  const Restoration restored = restore_regularity(mesh);
  EXPECT_EQ(restored.stuck.size(), 1u);
  EXPECT_EQ(restored.hidden, std::vector<VertexId>{VertexId(3)});
}

TEST(Lawson, StopsAtTheCapAndGoesOn) {
  Rng rng(3);
  Mesh mesh = test::mesh_of_random_points(rng, 200);
  Mesh whole = mesh;
  const std::size_t all = restore_regularity(whole).flips;
  ASSERT_GT(all, 20u);
  Lawson lawson;
  lawson.push_all(mesh);
  LawsonRun run = lawson.run(mesh, IgnoreFlips(), 7);
  EXPECT_EQ(run.flips, 7u);
  EXPECT_FALSE(run.finished);
  EXPECT_GT(count_non_regular_edges(mesh), 0u);
  run = lawson.run(mesh);
  EXPECT_EQ(run.flips, all - 7);
  EXPECT_TRUE(run.finished);
  EXPECT_EQ(mesh, whole);
  EXPECT_EQ(lawson.journal().size(), all);
}

}  // namespace
}  // namespace temper
