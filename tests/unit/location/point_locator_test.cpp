// Laws of places: they are means of their corners, a function of the point alone, and exact where the point is at a
// vertex or on an edge.
#include <gtest/gtest.h>

#include <limits>

#include "support/lattice.hpp"
#include "support/shapes.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/detail/location.hpp"
#include "temper/generate.hpp"

namespace temper::test {
namespace {

constexpr double kRounding = 1e-14;

Vec2 mean_of(const Mesh& mesh, const Place& place) {
  Vec2 sum;
  for (std::size_t k = 0; k < static_cast<std::size_t>(place.n); ++k) {
    sum = sum + place.shares[k] * mesh.position(place.corners[k]);
  }
  return sum;
}

/// As one would look without a walk or a tree.
bool is_in_some_triangle(const Mesh& mesh, Vec2 p) {
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    const Vec2 pa = mesh.position(a), pb = mesh.position(b), pc = mesh.position(c);
    if (orient2d(pa, pb, p) != Sign::negative && orient2d(pb, pc, p) != Sign::negative &&
        orient2d(pc, pa, p) != Sign::negative) {
      return true;
    }
  }
  return false;
}

TEST(Place, IsTheMeanOfItsCornersInAMeshWithAHole) {
  const Mesh mesh = *annulus();
  const PointLocator finder(mesh);
  Noise noise(3);
  int inside = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec2 p{1.2 * noise(), 1.2 * noise()};
    const Place place = finder.find(p, TriangleId(static_cast<std::size_t>(i) % mesh.n_triangles()));
    ASSERT_EQ(place.outside, !is_in_some_triangle(mesh, p));
    if (place.outside) continue;
    EXPECT_NEAR(length(mean_of(mesh, place) - p), 0, kRounding);
    ++inside;
  }
  EXPECT_GT(inside, 300);
}

TEST(Place, InAPeriodicPlaneDoesNotDependOnWhereTheWalkBegins) {
  // Half a period away, two neighbors see different images of a point.
  const Mesh mesh = *random_periodic({.vertices = 60});
  const PointLocator finder(mesh);
  Noise noise(4);
  for (int i = 0; i < 40; ++i) {
    const WeightedPoint p = mesh.space().in_domain({noise(), noise(), 0});
    const TriangleId there = finder.find(p).triangle;
    for (const TriangleId near : mesh.triangles()) ASSERT_EQ(finder.find(p, near).triangle, there);
  }
}

TEST(Place, OfAVertexIsThatVertexAndOfTheMiddleOfAnEdgeIsThatEdge) {
  const Mesh mesh = *sheared_grid({.nx = 8, .ny = 8, .shear = 0.5});  // midpoints of edges are exact here
  const PointLocator finder(mesh);
  for (const TriangleId near : {TriangleId(), TriangleId(0), TriangleId(77)}) {
    for (const VertexId v : mesh.vertices()) {
      const Place place = finder.find(mesh.position(v), near);
      EXPECT_EQ(place.n, 1);
      EXPECT_EQ(place.corners[0], v);
    }
    for (const HalfedgeId h : mesh.halfedges()) {
      const Place place = finder.find(0.5 * (mesh.position(mesh.origin(h)) + mesh.position(mesh.target(h))), near);
      EXPECT_EQ(place.n, 2);
      EXPECT_EQ(place.shares[0] + place.shares[1], 1);
    }
  }
}

TEST(Place, BeyondTheMeshIsTheNearestPointOfIt) {
  const Mesh mesh = mesh_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0, 1, 2}, {0, 2, 3}});
  const PointLocator finder(mesh);
  EXPECT_EQ(mean_of(mesh, finder.find(Vec2{0.25, -3})), (Vec2{0.25, 0}));
  const Place corner = finder.find(Vec2{5, 7});
  EXPECT_EQ(corner.n, 1);
  EXPECT_EQ(corner.corners[0], VertexId(2));
  EXPECT_TRUE(corner.outside);
}

TEST(Interpolated, KeepsToTheValuesOfTheCornersAndIsExactWhereTheyAgree) {
  const Mesh mesh = *random_mesh({100, 5, {}});
  const PointLocator finder(mesh);
  Noise noise(9);
  std::vector<double> values;
  for (std::size_t v = 0; v < mesh.n_vertices(); ++v) values.push_back(1e3 * noise());
  for (int i = 0; i < 500; ++i) {
    const Place place = finder.find(Vec2{0.5 + 0.4 * noise(), 0.5 + 0.4 * noise()});
    const double value = interpolated(place, [&](VertexId v) { return values[v.index]; });
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t k = 0; k < static_cast<std::size_t>(place.n); ++k) {
      low = std::min(low, values[place.corners[k].index]), high = std::max(high, values[place.corners[k].index]);
    }
    EXPECT_LE(low, value);
    EXPECT_LE(value, high);
    for (const double constant : {0.1, 1e308, std::numeric_limits<double>::infinity()}) {
      EXPECT_EQ(interpolated(place, [&](VertexId) { return constant; }), constant);
    }
  }
}

}  // namespace
}  // namespace temper::test
