// Where the vertices and triangles of a changed mesh take their data from, against a look at all triangles.
#include <gtest/gtest.h>

#include <limits>

#include "support/lattice.hpp"
#include "support/shapes.hpp"
#include "support/std_threads.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/detail/location.hpp"
#include "temper/generate.hpp"
#include "temper/optimize.hpp"
#include "temper/topology.hpp"

namespace temper::test {
namespace {

double linear(Vec2 p) { return 3 + 0.25 * p.x - 0.125 * p.y; }

/// A mesh, optimized: its vertices have moved, its edges are flipped.
struct Optimized {
  Mesh before, after;
  IdVector<VertexId, VertexId> vertices;
};
Optimized optimized_of(Mesh mesh, const OptimizeOptions& options = {}) {
  Optimized result{mesh, std::move(mesh), {}};
  const auto report = optimize(result.after, options);
  EXPECT_TRUE(report);
  result.vertices = report->vertices;
  return result;
}

TEST(PlacesOfVertices, ReproduceLinearDataWhereverAnOptimizationPutsVertices) {
  OptimizeOptions splitting, removing;
  splitting.boundary = BoundaryVertices::split;
  removing.paper.removal = Removal::patch;
  removing.paper.removal_from = 0;
  OptimizeOptions sliding;
  sliding.boundary = BoundaryVertices::slide;
  int moved = 0, inserted = 0;
  for (const OptimizeOptions& options : {OptimizeOptions(), splitting, removing, sliding}) {
    for (const Mesh& mesh : {*random_mesh({150, 4, {}}), *annulus(), *wedge()}) {
      const Optimized o = optimized_of(mesh, options);
      const auto places = positions_of_vertices(o.before, o.after, o.vertices);
      ASSERT_EQ(places.size(), o.after.n_vertices());
      for (const VertexId v : o.after.vertices()) {
        const Vec2 p = o.after.position(v);
        const double value = interpolated(places[v], [&](VertexId u) { return linear(o.before.position(u)); });
        EXPECT_NEAR(value, linear(p), 1e-13 * (1 + length(p)));
        const VertexId was = o.vertices.empty() ? v : o.vertices[v];
        inserted += was.valid() ? 0 : 1;
        if (!was.valid()) continue;
        moved += o.before.position(was) != p ? 1 : 0;
        if (o.before.position(was) == p) {
          EXPECT_EQ(places[v].corners[0], was);
        }
      }
    }
  }
  EXPECT_GT(moved, 300);
  EXPECT_GT(inserted, 5);
}

TEST(PlacesOfVertices, OnASlantedBoundaryDoNotAskWhatIsAcrossFromIt) {
  // A vertex that slides along a line of slope 1/3, where nothing is exact.
  const Vec2 a{0.1, 0.7}, direction{3, 1};
  std::vector<Vec2> points;
  for (const double t : {0.0, 1.0, 2.0, 3.0}) points.push_back(a + t * direction);
  points.push_back({4, 9});
  const Mesh before = mesh_of(points, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}});
  int off = 0;
  for (int i = -60; i < 60; ++i) {
    Mesh after = before;
    after.set_position(VertexId(1), points[1] + (i / 64.0) * direction);
    after.set_position(VertexId(2), points[2] + (i / 77.0) * direction);
    const auto places = positions_of_vertices(before, after);
    for (const VertexId v : {VertexId(1), VertexId(2)}) {
      off += orient2d(points[0], points[3], after.position(v)) != Sign::zero ? 1 : 0;
      EXPECT_LE(places[v].n, 2) << i;
      const double nan = std::numeric_limits<double>::quiet_NaN();
      const double value = interpolated(places[v], [&](VertexId u) { return u.index == 4 ? nan : points[u.index].x; });
      EXPECT_NEAR(value, after.position(v).x, 1e-14);
    }
  }
  EXPECT_GT(off, 50);
}

TEST(SourcesOfTriangles, AreTheTrianglesThatTheMiddlesAreIn) {
  const Optimized o = optimized_of(*random_mesh({150, 8, {}}));
  const auto places = positions_of_vertices(o.before, o.after);
  const auto sources = sources_of_triangles(o.before, o.after, places);
  ASSERT_EQ(sources.size(), o.after.n_triangles());
  std::size_t others = 0;
  for (const TriangleId t : o.after.triangles()) {
    const auto [a, b, c] = o.after.corners(t);
    const Vec2 middle = (1.0 / 3) * (o.after.position(a) + o.after.position(b) + o.after.position(c));
    for (int k = 0; k < 3; ++k) {
      const HalfedgeId h = Mesh::halfedge(sources[t], k);
      EXPECT_NE(orient2d(o.before.position(o.before.origin(h)), o.before.position(o.before.target(h)), middle),
                Sign::negative);
    }
    others += sources[t] != t ? 1 : 0;
  }
  EXPECT_GT(others, 20u);
}

TEST(SourcesOfTriangles, AreTheSameTrianglesWhereverTheyAreNumbered) {
  const Mesh before = *random_mesh({200, 2, {}});
  Mesh after = before;
  const MeshOrder order = hilbert_order(after);
  const auto places = positions_of_vertices(before, after, order.vertices);
  const auto sources = sources_of_triangles(before, after, places);
  for (const VertexId v : after.vertices()) EXPECT_EQ(places[v].corners[0], order.vertices[v]);
  for (const TriangleId t : after.triangles()) EXPECT_EQ(sources[t], order.triangles[t]);
}

TEST(SourcesOfTriangles, StayInTheirRegion) {
  // Two regions that meet in a line of slope 1/3, with a vertex that slid on it, and thin triangles on both sides.
  const Vec2 direction{3, 1};
  const Vec2 a{0.1, 0.7}, b = a + 1.0 * direction, c = a + 2.0 * direction;
  const Vec2 up{b.x, b.y + 4e-16}, down{b.x, b.y - 4e-16};
  const std::vector<Vec2> points = {a, b, c, {a.x + 3, a.y + 2}, {a.x + 3, a.y - 1}, up, down};
  ASSERT_EQ(orient2d(a, c, up), Sign::positive);
  ASSERT_EQ(orient2d(a, c, down), Sign::negative);
  const Mesh before =
      mesh_of(points, {{0, 1, 5}, {1, 2, 5}, {0, 5, 3}, {5, 2, 3}, {1, 0, 6}, {2, 1, 6}, {6, 0, 4}, {2, 6, 4}}, {},
              {1, 1, 1, 1, 2, 2, 2, 2});
  for (int i = -40; i < 40; ++i) {
    Mesh after = before;
    after.set_position(VertexId(1), b + (i / 97.0) * direction);
    const auto sources = sources_of_triangles(before, after, positions_of_vertices(before, after));
    for (const TriangleId t : after.triangles()) EXPECT_EQ(before.region(sources[t]), after.region(t)) << i;
  }
}

TEST(SourcesOfTriangles, DoNotDependOnThreads) {
  const Optimized o = optimized_of(*random_mesh({40000, 8, {}}), [] {
    OptimizeOptions few;
    few.max_sweeps = 2;
    return few;
  }());
  StdThreads threads(4);
  const auto one = positions_of_vertices(o.before, o.after),
             four = positions_of_vertices(o.before, o.after, {}, &threads);
  const auto of_one = sources_of_triangles(o.before, o.after, one),
             of_four = sources_of_triangles(o.before, o.after, four, &threads);
  EXPECT_GT(threads.runs(), 1u);
  for (const VertexId v : o.after.vertices()) {
    EXPECT_EQ(one[v].corners, four[v].corners);
    EXPECT_EQ(one[v].shares, four[v].shares);
  }
  EXPECT_EQ(of_one.raw(), of_four.raw());
}

}  // namespace
}  // namespace temper::test
