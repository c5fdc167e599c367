// Laws of any sequence of operations on connectivity: flips, insertions, splits and removals.
#include <gtest/gtest.h>

#include "property/mesh_of_random_points.hpp"
#include "regularity/lawson.hpp"
#include "support/shapes.hpp"
#include "temper/regularity.hpp"

namespace temper {
namespace {

VertexId any_vertex(const Mesh& mesh, Rng& rng) {
  return VertexId(std::size_t{rng.below(static_cast<std::uint32_t>(mesh.n_vertices()))});
}

double perimeter(const Mesh& mesh) {
  double sum = 0;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (mesh.is_erased(Mesh::triangle(h)) || !mesh.is_boundary(h)) continue;
    sum += length(mesh.position(mesh.target(h)) - mesh.position(mesh.origin(h)));
  }
  return sum;
}

/// The total length of constrained edges.
double constrained_length(const Mesh& mesh) {
  double sum = 0;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_constrained(h) || !mesh.is_edge_representative(h)) continue;
    sum += length(mesh.position(mesh.target(h)) - mesh.position(mesh.origin(h)));
  }
  return sum;
}

/// The square in two regions along its middle, so that there is an interface to split and to straighten again.
Mesh two_regions() {
  const std::vector<Vec2> points = {{-1, -1}, {1, -1}, {1, 0}, {1, 1}, {-1, 1}, {-1, 0}};
  const std::vector<std::array<std::int32_t, 3>> triangles = {{0, 1, 2}, {0, 2, 5}, {5, 2, 3}, {5, 3, 4}};
  const std::vector<std::int32_t> regions = {1, 1, 2, 2};
  MeshInput input;
  input.points = points;
  input.triangles = triangles;
  input.regions = regions;
  return Mesh::build(input)->mesh;
}

bool regions_lie_where_they_did(const Mesh& mesh) {
  for (const TriangleId t : mesh.triangles()) {
    if (mesh.is_erased(t)) continue;
    double y = 0;
    for (const VertexId v : mesh.corners(t)) y += mesh.position(v).y;
    if (mesh.region(t) != (y < 0 ? 1 : 2)) return false;
  }
  return true;
}

struct Counts {
  std::size_t flips = 0, inserted = 0, removed = 0, on_boundary = 0, on_interface = 0;
};

// On a lattice all areas and lengths are dyadic numbers, and sums of them exact.
void one_operation(Mesh& mesh, Rng& rng, Counts& counts) {
  constexpr std::uint32_t kCells = 16;
  switch (rng.below(3)) {
    case 0: {
      const HalfedgeId h(std::size_t{rng.below(static_cast<std::uint32_t>(mesh.n_halfedges()))});
      if (can_flip(mesh, h) != FlipStatus::possible) return;
      flip(mesh, h);
      ++counts.flips;
      return;
    }
    case 1: {
      const double x = -1 + 2.0 * rng.below(kCells + 1) / kCells, y = -1 + 2.0 * rng.below(kCells + 1) / kCells;
      counts.inserted += test::insert_anywhere(mesh, {x, y, rng.uniform(-0.1, 0.1)}) ? 1 : 0;
      return;
    }
    default: {
      const VertexId v = any_vertex(mesh, rng);
      const RemovalPlan plan = plan_removal(mesh, v);
      if (plan.status != RemovalStatus::possible) return;
      const bool boundary = mesh.is_boundary(v), interface = mesh.is_constrained(plan.first);
      remove_vertex(mesh, plan);
      ++counts.removed;
      counts.on_boundary += boundary ? 1 : 0;
      counts.on_interface += interface && !boundary ? 1 : 0;
    }
  }
}

TEST(TopologyProperty, AnySequenceKeepsTheMeshTheDomainAndTheInterface) {
  Counts counts;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Rng rng(seed);
    Mesh mesh = two_regions();
    for (int i = 0; i < 150; ++i) {
      one_operation(mesh, rng, counts);
      ASSERT_EQ(mesh.validate(), std::nullopt) << "seed " << seed << " operation " << i;
      ASSERT_TRUE(test::has_canonical_outgoing(mesh)) << "seed " << seed << " operation " << i;
      ASSERT_EQ(test::area(mesh), 4) << "seed " << seed << " operation " << i;
      ASSERT_EQ(perimeter(mesh), 8);
      ASSERT_EQ(constrained_length(mesh), 2);
      ASSERT_TRUE(regions_lie_where_they_did(mesh));
      if (i % 50 == 49) mesh.compact();
    }
    ASSERT_TRUE(restore_regularity(mesh, HiddenPolicy::remove).regular()) << "seed " << seed;
    ASSERT_EQ(mesh.validate(), std::nullopt);
    ASSERT_EQ(test::area(mesh), 4);
  }
  EXPECT_GT(counts.flips, 1000u);
  EXPECT_GT(counts.inserted, 1000u);
  EXPECT_GT(counts.removed, 1000u);
  EXPECT_GT(counts.on_boundary, 30u);
  EXPECT_GT(counts.on_interface, 30u);
}

TEST(TopologyProperty, ARemovalFromARegularMeshLeavesARegularMesh) {
  std::size_t removed = 0, mended = 0;
  Lawson lawson;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Rng rng(seed);
    Mesh mesh = test::mesh_of_random_points(rng, 60);
    for (const VertexId v : mesh.vertices()) mesh.set_weight(v, 0.005 * rng.uniform(-1, 1));
    if (!restore_regularity(mesh).regular()) continue;
    RemovalPlan plan;
    for (int i = 0; i < 30; ++i) {
      plan = plan_removal(mesh, any_vertex(mesh, rng), std::move(plan));
      if (plan.status != RemovalStatus::possible) continue;
      remove_vertex(mesh, plan);
      lawson.clear();
      lawson.push_removal(mesh, plan);
      mended += lawson.run(mesh).flips;
      ASSERT_EQ(mesh.validate(), std::nullopt);
      ASSERT_EQ(count_non_regular_edges(mesh), 0u) << "seed " << seed;
      ++removed;
    }
  }
  EXPECT_GT(removed, 1000u);
  EXPECT_EQ(mended, 0u);  // no near ties among these
}

// On a lattice nearly everything is a tie; what rounding decides, Lawson on the new edges alone must mend.
TEST(TopologyProperty, ARemovalAmongTiesNeedsLawsonOnTheNewEdgesAlone) {
  std::size_t removed = 0;
  Lawson lawson;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Rng rng(seed);
    Mesh mesh = test::mesh_of_random_points(rng, 80, 10);
    for (const VertexId v : mesh.vertices()) mesh.set_point(v, {mesh.position(v).x / 3, mesh.position(v).y / 3, 0});
    if (mesh.validate() || !restore_regularity(mesh).regular()) continue;
    for (int i = 0; i < 30; ++i) {
      const RemovalPlan plan = plan_removal(mesh, any_vertex(mesh, rng));
      if (plan.status != RemovalStatus::possible) continue;
      remove_vertex(mesh, plan);
      lawson.clear();
      lawson.push_removal(mesh, plan);
      lawson.run(mesh);
      ASSERT_EQ(mesh.validate(), std::nullopt);
      ASSERT_EQ(count_non_regular_edges(mesh), 0u) << "seed " << seed;
      ++removed;
    }
  }
  EXPECT_GT(removed, 500u);
}

// All triangulations of a cavity by recursion: of those that are counter-clockwise, the plan's has the least volume.
double least_volume(const Mesh& mesh, const std::vector<VertexId>& polygon) {
  if (polygon.size() < 3) return 0;
  double least = kNoThreshold;
  const auto height = [&](VertexId v) { return squared_length(mesh.position(v)) - mesh.weight(v); };
  const VertexId a = polygon.front(), b = polygon.back();
  for (std::size_t m = 1; m + 1 < polygon.size(); ++m) {
    const VertexId c = polygon[m];
    if (orient2d(mesh.position(a), mesh.position(c), mesh.position(b)) != Sign::positive) continue;
    const auto middle = polygon.begin() + static_cast<std::ptrdiff_t>(m);
    const double volume =
        doubled_area(mesh.position(a), mesh.position(c), mesh.position(b)) * (height(a) + height(b) + height(c)) +
        least_volume(mesh, {polygon.begin(), middle + 1}) + least_volume(mesh, {middle, polygon.end()});
    least = std::min(least, volume);
  }
  return least;
}

TEST(TopologyProperty, ThePlanHasTheLeastVolumeOfAllTriangulations) {
  std::size_t planned = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Rng rng(seed);
    Mesh mesh = test::mesh_of_random_points(rng, 30);  // not regular: stars of any shape
    for (const VertexId v : mesh.vertices()) mesh.set_weight(v, 0.3 * rng.uniform(-1, 1));
    for (const VertexId v : mesh.vertices()) {
      const RemovalPlan plan = plan_removal(mesh, v);
      if (plan.status != RemovalStatus::possible || plan.link.size() > 10) continue;
      double volume = 0;
      for (const auto& t : plan.triangles) {
        double heights = 0;
        for (const VertexId u : t) heights += squared_length(mesh.position(u)) - mesh.weight(u);
        volume += doubled_area(mesh.position(t[0]), mesh.position(t[1]), mesh.position(t[2])) * heights;
      }
      EXPECT_NEAR(volume, least_volume(mesh, plan.link), 1e-12) << "seed " << seed << " vertex " << v.index;
      ++planned;
    }
  }
  EXPECT_GT(planned, 1000u);
}

TEST(TopologyProperty, AStarOfManyTrianglesIsPlannedAsASmallOne) {
  constexpr int kCorners = 60;  // more than the tables on the stack are made for
  std::vector<Vec2> points;
  std::vector<std::array<std::int32_t, 3>> triangles;
  Rng rng(5);
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 6.283185307179586 * (i + 0.3 * rng.uniform(-1, 1)) / kCorners, radius = rng.uniform(0.4, 1);
    points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    triangles.push_back({kCorners, i, (i + 1) % kCorners});
  }
  points.push_back({0, 0});
  Mesh mesh = test::build_or_die(points, triangles);
  const double area = test::area(mesh);
  const RemovalPlan plan = plan_removal(mesh, VertexId(std::size_t{kCorners}));
  ASSERT_EQ(plan.status, RemovalStatus::possible);
  remove_vertex(mesh, plan);
  EXPECT_EQ(mesh.validate(), std::nullopt);
  EXPECT_EQ(count_non_regular_edges(mesh), 0u);
  EXPECT_NEAR(test::area(mesh), area, 1e-12);
}

}  // namespace
}  // namespace temper
