// Laws of Lawson's algorithm on random triangulations.
#include <gtest/gtest.h>

#include <vector>

#include "property/mesh_of_random_points.hpp"
#include "regularity/lawson.hpp"
#include "temper/regularity.hpp"

namespace temper {
namespace {

void set_random_weights(Mesh& mesh, Rng& rng, double size) {
  for (const VertexId v : mesh.vertices()) mesh.set_weight(v, rng.uniform(-size, size));
}

/// Dyadic weights: sums with other dyadic numbers of like size are exact.
void set_dyadic_weights(Mesh& mesh, Rng& rng, double step) {
  for (const VertexId v : mesh.vertices()) mesh.set_weight(v, step * rng.below(9));
}

// A vertex v keeps its power cell when w_v exceeds every other weight less the squared distance to that vertex.
double weight_that_hides_none(const Mesh& mesh) {
  double least = 8;
  for (const VertexId a : mesh.vertices()) {
    for (const VertexId b : mesh.vertices()) {
      if (a < b) least = std::min(least, squared_length(mesh.position(a) - mesh.position(b)));
    }
  }
  return 0.49 * least;
}

// v is hidden when some triangle of other vertices contains it and passes below it. For domains that are convex.
std::vector<VertexId> hidden_by_definition(const Mesh& mesh) {
  std::vector<VertexId> hidden;
  const auto covers = [&](VertexId a, VertexId b, VertexId c, VertexId v) {
    const Vec2 p = mesh.position(v);
    return orient2d(mesh.position(a), mesh.position(b), p) != Sign::negative &&
           orient2d(mesh.position(b), mesh.position(c), p) != Sign::negative &&
           orient2d(mesh.position(c), mesh.position(a), p) != Sign::negative &&
           power_test(mesh.point(a), mesh.point(b), mesh.point(c), mesh.point(v)) == Sign::negative;
  };
  const auto is_hidden = [&](VertexId v) {
    for (const VertexId a : mesh.vertices()) {
      for (const VertexId b : mesh.vertices()) {
        for (const VertexId c : mesh.vertices()) {
          if (a == v || b == v || c == v || a > b || a > c) continue;
          if (orient2d(mesh.position(a), mesh.position(b), mesh.position(c)) != Sign::positive) continue;
          if (covers(a, b, c, v)) return true;
        }
      }
    }
    return false;
  };
  for (const VertexId v : mesh.vertices()) {
    if (is_hidden(v)) hidden.push_back(v);
  }
  return hidden;
}

/// Validates the mesh after every flip, and checks that the flipped edge became regular.
struct Validator {
  std::size_t flips = 0;
  void before(const Mesh& mesh, HalfedgeId h) {
    EXPECT_FALSE(mesh.is_constrained(h));
    EXPECT_FALSE(is_regular(mesh, h));
  }
  void after(const Mesh& mesh, HalfedgeId h) {
    EXPECT_EQ(mesh.validate(), std::nullopt);
    EXPECT_TRUE(is_regular(mesh, h));
    ++flips;
  }
};

TEST(RegularityProperty, EveryFlipLeavesAValidMeshAndTheLastOneARegularOne) {
  std::size_t flips = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Rng rng(seed);
    Mesh mesh = test::mesh_of_random_points(rng, 25, seed % 2 == 0 ? 16 : 0);
    set_random_weights(mesh, rng, 0.5 * weight_that_hides_none(mesh));
    Lawson lawson;
    lawson.push_all(mesh);
    Validator validator;
    const LawsonRun run = lawson.run(mesh, validator);
    EXPECT_TRUE(run.finished);
    EXPECT_EQ(run.flips, validator.flips);
    EXPECT_TRUE(lawson.stuck(mesh).empty());
    ASSERT_EQ(count_non_regular_edges(mesh), 0u) << "seed " << seed;
    flips += run.flips;
  }
  EXPECT_GT(flips, 1000u);
}

TEST(RegularityProperty, TheResultDoesNotDependOnTheTriangulationItStartsFrom) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Rng rng(seed);
    Mesh mesh = test::mesh_of_random_points(rng, 30);
    set_random_weights(mesh, rng, 0.5 * weight_that_hides_none(mesh));
    Mesh other = mesh;
    ASSERT_GT(test::shuffle_flips(other, rng, 300), 0u);
    ASSERT_TRUE(restore_regularity(mesh).regular());
    ASSERT_TRUE(restore_regularity(other).regular());
    ASSERT_EQ(test::edge_set(mesh), test::edge_set(other)) << "seed " << seed;
  }
}

TEST(RegularityProperty, WithTiesByNumberTheResultIsUniqueOnALattice) {
  const PerturbedPowerTest test_by_number{[](VertexId v) { return v.index; }};
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Rng rng(seed);
    Mesh mesh = test::mesh_of_random_points(rng, 40, 6);
    Mesh other = mesh;
    ASSERT_GT(test::shuffle_flips(other, rng, 300), 0u);
    for (Mesh* m : {&mesh, &other}) {
      Lawson lawson;
      lawson.push_all(*m);
      lawson.run(*m, IgnoreFlips(), Lawson::kNoCap, test_by_number);
      ASSERT_TRUE(lawson.stuck(*m, test_by_number).empty());
    }
    ASSERT_EQ(test::edge_set(mesh), test::edge_set(other)) << "seed " << seed;
  }
}

TEST(RegularityProperty, AddingAnAffineFunctionToTheWeightsChangesNothing) {
  std::size_t flips = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Rng rng(seed);
    Mesh mesh = test::mesh_of_random_points(rng, 30, 16);
    set_dyadic_weights(mesh, rng, 0x1p-8);
    Mesh other = mesh;
    const double c = 3.5, ax = -0.75, ay = 2.25;
    for (const VertexId v : other.vertices()) {
      const Vec2 p = other.position(v);
      other.set_weight(v, other.weight(v) + (ax * p.x + ay * p.y) + c);
    }
    const Restoration a = restore_regularity(mesh), b = restore_regularity(other);
    EXPECT_EQ(a.flips, b.flips);
    EXPECT_EQ(a.stuck, b.stuck);
    EXPECT_EQ(a.hidden, b.hidden);
    for (const VertexId v : other.vertices()) other.set_weight(v, mesh.weight(v));
    ASSERT_EQ(mesh, other) << "seed " << seed;
    flips += a.flips;
  }
  EXPECT_GT(flips, 1000u);
}

TEST(RegularityProperty, HiddenVerticesAreExactlyThoseWithoutPowerCell) {
  std::size_t hidden = 0, shown = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    Rng rng(seed);
    Mesh mesh = test::mesh_of_random_points(rng, 14);
    set_random_weights(mesh, rng, rng.uniform(0.02, 0.6));
    // The corners of the square can hide nowhere; make sure that they also show.
    for (std::size_t corner = 0; corner < 4; ++corner) mesh.set_weight(VertexId(corner), 0.5);
    const std::vector<VertexId> expected = hidden_by_definition(mesh);
    const Restoration restored = restore_regularity(mesh);
    ASSERT_EQ(restored.hidden, expected) << "seed " << seed;
    ASSERT_EQ(restored.regular(), expected.empty());
    ASSERT_EQ(mesh.validate(), std::nullopt);
    hidden += expected.size();
    shown += mesh.n_vertices() - expected.size();
  }
  EXPECT_GT(hidden, 300u);
  EXPECT_GT(shown, 1000u);
}

TEST(RegularityProperty, AHeavyNeighborHidesAVertexAndItIsNamed) {
  int hid = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Rng rng(seed);
    Mesh mesh = test::mesh_of_random_points(rng, 20);
    ASSERT_TRUE(restore_regularity(mesh).regular());
    const VertexId v(4 + rng.below(20));
    const VertexId heavy = mesh.target(mesh.outgoing(v));
    mesh.set_weight(heavy, 50);
    const Restoration restored = restore_regularity(mesh);
    ASSERT_FALSE(restored.regular());
    hid += std::count(restored.hidden.begin(), restored.hidden.end(), v) > 0 ? 1 : 0;
    EXPECT_EQ(std::count(restored.hidden.begin(), restored.hidden.end(), heavy), 0);
  }
  EXPECT_GT(hid, 80);
}

TEST(RegularityProperty, AVertexStepWithFlipsIsRolledBackBitForBit) {
  std::size_t flips = 0, steps = 0;
  Lawson lawson;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Rng rng(seed);
    Mesh mesh = test::mesh_of_random_points(rng, 30);
    ASSERT_TRUE(restore_regularity(mesh).regular());
    for (const VertexId v : mesh.vertices()) {
      const Mesh before = mesh;
      mesh.set_weight(v, mesh.weight(v) + rng.uniform(-0.3, 0.3));
      lawson.clear();
      lawson.push_star(mesh, v);
      flips += lawson.run(mesh, IgnoreFlips(), 64).flips;
      if (lawson.stuck(mesh).empty()) {
        EXPECT_EQ(count_non_regular_edges(mesh), 0u);
      }
      lawson.rollback(mesh);
      mesh.set_weight(v, before.weight(v));
      ASSERT_EQ(mesh, before) << "seed " << seed << " vertex " << v.index;
      ++steps;
    }
  }
  EXPECT_GT(flips, 1000u);
  EXPECT_GT(steps, 1000u);
}

TEST(RegularityProperty, ConstrainedEdgesStayAndTheRestIsRegular) {
  std::size_t constrained = 0, flips = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Rng rng(seed);
    Mesh mesh = test::mesh_of_random_points(rng, 30, seed % 2 == 0 ? 16 : 0);
    std::vector<std::pair<VertexId, VertexId>> kept;
    for (const HalfedgeId h : mesh.halfedges()) {
      if (mesh.is_boundary(h) || rng.below(12) != 0) continue;
      mesh.set_constrained(h, true);
      kept.emplace_back(mesh.origin(h), mesh.target(h));
    }
    const Restoration restored = restore_regularity(mesh);
    // All weights are equal: nothing can hide, whatever is constrained.
    ASSERT_TRUE(restored.regular()) << "seed " << seed;
    EXPECT_EQ(count_non_regular_edges(mesh, false), 0u);
    for (const auto& [a, b] : kept) {
      const HalfedgeId h = mesh.find_halfedge(a, b);
      ASSERT_TRUE(h.valid());
      EXPECT_TRUE(mesh.is_constrained(h));
    }
    constrained += kept.size();
    flips += restored.flips;
  }
  EXPECT_GT(constrained, 1000u);
  EXPECT_GT(flips, 1000u);
}

TEST(RegularityProperty, WithConstrainedEdgesTooTheResultDoesNotDependOnTheStart) {
  std::size_t constrained = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Rng rng(seed);
    Mesh mesh = test::mesh_of_random_points(rng, 40);
    set_random_weights(mesh, rng, 0.5 * weight_that_hides_none(mesh));
    for (const HalfedgeId h : mesh.halfedges()) {
      if (mesh.is_boundary(h) || rng.below(12) != 0) continue;
      mesh.set_constrained(h, true);
      ++constrained;
    }
    Mesh other = mesh;
    ASSERT_GT(test::shuffle_flips(other, rng, 400), 0u);
    const Restoration a = restore_regularity(mesh), b = restore_regularity(other);
    // Behind a constrained edge a vertex can lose its cell even to small weights; then both must say so.
    ASSERT_EQ(a.hidden, b.hidden) << "seed " << seed;
    ASSERT_EQ(a.regular(), b.regular());
    if (a.regular()) {
      ASSERT_EQ(test::edge_set(mesh), test::edge_set(other)) << "seed " << seed;
    }
  }
  EXPECT_GT(constrained, 1000u);
}

// Outside its precondition: the signed volume under the surface falls all the same.
TEST(RegularityProperty, LawsonEndsEvenAmongInvertedTriangles) {
  std::size_t inverted = 0, flips = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Rng rng(seed);
    Mesh mesh = test::mesh_of_random_points(rng, 30);
    for (const VertexId v : mesh.vertices()) {
      if (rng.below(4) == 0) mesh.set_point(v, {rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-0.1, 0.1)});
    }
    for (const TriangleId t : mesh.triangles()) {
      const auto [a, b, c] = mesh.corners(t);
      inverted += orient2d(mesh.position(a), mesh.position(b), mesh.position(c)) == Sign::negative ? 1 : 0;
    }
    Lawson lawson;
    lawson.push_all(mesh);
    const LawsonRun run = lawson.run(mesh, IgnoreFlips(), 100000);
    ASSERT_TRUE(run.finished) << "seed " << seed;
    flips += run.flips;
  }
  EXPECT_GT(inverted, 1000u);
  EXPECT_GT(flips, 1000u);
}

TEST(RegularityProperty, RestoringTwiceIsRestoringOnce) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Rng rng(seed);
    Mesh mesh = test::mesh_of_random_points(rng, 40, 8);
    set_random_weights(mesh, rng, 0.05);
    restore_regularity(mesh);
    const Mesh once = mesh;
    EXPECT_EQ(restore_regularity(mesh).flips, 0u);
    EXPECT_EQ(mesh, once);
  }
}

}  // namespace
}  // namespace temper
