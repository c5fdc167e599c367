// The fate of hidden vertices under each policy, and what an observer sees of it.
#include <gtest/gtest.h>

#include "property/mesh_of_random_points.hpp"
#include "support/shapes.hpp"
#include "temper/regularity.hpp"

namespace temper {
namespace {

/// Triangulations of the square, with points on its sides; weights that hide several vertices.
Mesh weighted_mesh(std::uint64_t seed) {
  Rng rng(seed);
  Mesh mesh = test::mesh_of_random_points(rng, 40);
  for (int i = 0; i < 8; ++i) test::insert_anywhere(mesh, {rng.uniform(-1, 1), i % 2 == 0 ? -1.0 : 1.0, 0});
  for (const VertexId v : mesh.vertices()) mesh.set_weight(v, 0.15 * rng.uniform(-1, 1));
  for (std::size_t corner = 0; corner < 4; ++corner) mesh.set_weight(VertexId(corner), 0);
  return mesh;
}

constexpr std::uint64_t kSeeds = 40;

TEST(HiddenPolicy, UndoPutsTheMeshBackBitForBitAndNamesThem) {
  std::size_t undone = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Mesh before = weighted_mesh(seed);
    Mesh mesh = before, kept = before;
    const Restoration keep = restore_regularity(kept);
    std::size_t flips = 0, undos = 0;
    RestorationObserver observer;
    observer.flipped = [&](VertexId, VertexId, VertexId, VertexId) { ++flips; };
    observer.undone = [&] { ++undos; };
    const Restoration undo = restore_regularity(mesh, HiddenPolicy::undo, &observer);
    EXPECT_EQ(undo.hidden, keep.hidden);
    EXPECT_EQ(undo.regular(), keep.regular());
    EXPECT_EQ(undo.undone, !keep.hidden.empty());
    EXPECT_EQ(flips, keep.flips);
    EXPECT_EQ(undos, undo.undone ? 1u : 0u);
    EXPECT_EQ(undo.flips, undo.undone ? 0 : keep.flips);
    EXPECT_TRUE(undo.stuck.empty());
    EXPECT_EQ(mesh, undo.undone ? before : kept);
    undone += undo.undone ? 1 : 0;
  }
  EXPECT_GT(undone, kSeeds / 2);
}

TEST(HiddenPolicy, UndoKeepsWhatHidesNothing) {
  Mesh mesh = test::square();
  mesh.set_weight(VertexId(1), 0.5);
  const Restoration restored = restore_regularity(mesh, HiddenPolicy::undo);
  EXPECT_FALSE(restored.undone);
  EXPECT_TRUE(restored.regular());
  EXPECT_EQ(restored.flips, 1u);
}

TEST(HiddenPolicy, RemoveLeavesARegularMeshOfTheOthers) {
  std::size_t removed = 0, on_boundary = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    Mesh mesh = weighted_mesh(seed);
    const Mesh before = mesh;
    Mesh kept = mesh;
    const std::vector<VertexId> hidden = restore_regularity(kept).hidden;
    Restoration restored = restore_regularity(mesh, HiddenPolicy::remove);
    EXPECT_EQ(mesh.validate(), std::nullopt);
    EXPECT_TRUE(restored.regular());
    EXPECT_FALSE(restored.undone);
    EXPECT_EQ(count_non_regular_edges(mesh), 0u);
    EXPECT_TRUE(test::has_canonical_outgoing(mesh));
    EXPECT_EQ(restored.hidden, hidden);
    for (const VertexId v : restored.removed) {
      EXPECT_TRUE(mesh.is_isolated(v));
      on_boundary += before.is_boundary(v) ? 1 : 0;
    }
    removed += restored.removed.size();
    std::sort(restored.removed.begin(), restored.removed.end());
    EXPECT_EQ(restored.removed, hidden);
    EXPECT_NEAR(test::area(mesh), 4, 1e-12);
    mesh.compact();
    EXPECT_EQ(mesh.n_vertices(), before.n_vertices() - hidden.size());
    EXPECT_EQ(mesh.validate(), std::nullopt);
    EXPECT_EQ(count_non_regular_edges(mesh), 0u);
  }
  EXPECT_GT(removed, 100u);
  EXPECT_GT(on_boundary, 10u);
}

TEST(HiddenPolicy, WhatTheObserverSawReplaysToTheSameMesh) {
  struct Event {
    std::array<VertexId, 4> flip;
    RemovalPlan removal;
  };
  std::size_t removals = 0, flips = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    Mesh mesh = weighted_mesh(seed);
    Mesh replayed = mesh;
    std::vector<Event> events;
    RestorationObserver observer;
    observer.flipped = [&](VertexId a, VertexId b, VertexId c, VertexId d) { events.push_back({{a, b, c, d}, {}}); };
    observer.removing = [&](const RemovalPlan& plan) { events.push_back({{}, plan}); };
    const Restoration restored = restore_regularity(mesh, HiddenPolicy::remove, &observer);
    for (const Event& e : events) {
      if (e.removal.status == RemovalStatus::possible) {
        const RemovalPlan plan = removal_from_names(replayed, e.removal.vertex, e.removal.link[0], e.removal.triangles);
        ASSERT_EQ(plan.status, RemovalStatus::possible);
        remove_vertex(replayed, plan);
        ++removals;
      } else {
        const HalfedgeId h = replayed.find_halfedge(e.flip[0], e.flip[1]);
        ASSERT_TRUE(h.valid());
        EXPECT_EQ(replayed.opposite(h), e.flip[2]);
        EXPECT_EQ(replayed.opposite(replayed.twin(h)), e.flip[3]);
        flip(replayed, h);
        ++flips;
      }
    }
    ASSERT_EQ(replayed, mesh) << "seed " << seed;
    EXPECT_EQ(events.size(), restored.flips + restored.removed.size());
  }
  EXPECT_GT(removals, 100u);
  EXPECT_GT(flips, 1000u);
}

TEST(HiddenPolicy, RemoveTakesAFlatBoundaryVertexOut) {
  Mesh mesh = test::build_or_die({{-1, 0}, {0, 0}, {1, 0}, {0, 1}}, {{0, 1, 3}, {1, 2, 3}});
  mesh.set_weight(VertexId(1), -1.5);
  const Restoration restored = restore_regularity(mesh, HiddenPolicy::remove);
  EXPECT_TRUE(restored.regular());
  EXPECT_EQ(restored.removed, std::vector<VertexId>{VertexId(1)});
  EXPECT_EQ(mesh.validate(), std::nullopt);
  EXPECT_TRUE(mesh.find_halfedge(VertexId(0), VertexId(2)).valid());
}

TEST(HiddenPolicy, RemoveLeavesCornersAndFixedVerticesAndReportsThem) {
  // A dart: reflex at vertex 3, whose edge to vertex 1 is stuck when vertex 3 is light.
  Mesh dart = test::build_or_die({{-2, -1}, {0, 4}, {2, -1}, {0, 0}}, {{0, 3, 1}, {3, 2, 1}});
  dart.set_weight(VertexId(3), -40);
  Mesh fixed = test::build_or_die({{2, 0}, {-1, 1.75}, {-1, -1.75}}, {{0, 1, 2}});
  const VertexId center = insert_in_triangle(fixed, TriangleId(0), {0, 0, -9});
  fixed.set_fixed(center, true);
  for (const auto& [input, vertex] : {std::pair{dart, VertexId(3)}, {fixed, center}}) {
    Mesh mesh = input;
    const Restoration restored = restore_regularity(mesh, HiddenPolicy::remove);
    EXPECT_EQ(mesh, input);
    EXPECT_FALSE(restored.regular());
    EXPECT_FALSE(restored.stuck.empty());
    EXPECT_EQ(restored.hidden, std::vector<VertexId>{vertex});
    EXPECT_TRUE(restored.removed.empty());
  }
}

TEST(HiddenPolicy, RemoveFindsThoseInTheShadowOfAnother) {
  // Vertex 4 hides so deep that its star hides vertex 5 from Lawson's test: both go, and one is named by the other.
  std::size_t in_shadow = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    Mesh mesh = weighted_mesh(seed);
    Mesh kept = mesh;
    const Restoration keep = restore_regularity(kept);
    std::vector<VertexId> at_stuck;
    for (const HalfedgeId h : keep.stuck) at_stuck.push_back(kept.origin(h)), at_stuck.push_back(kept.target(h));
    const Restoration restored = restore_regularity(mesh, HiddenPolicy::remove);
    for (const VertexId v : restored.removed) {
      in_shadow += std::count(at_stuck.begin(), at_stuck.end(), v) == 0 ? 1 : 0;
    }
  }
  EXPECT_GT(in_shadow, 0u);
}

}  // namespace
}  // namespace temper
