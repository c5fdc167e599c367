// Places on the sphere: the triangle that a ray from the center meets, and data that are linear there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/lattice.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/detail/location.hpp"
#include "temper/generate.hpp"
#include "temper/optimize.hpp"

namespace temper::test {
namespace {

constexpr double kRadius = 6371;

Vec3 on_unit_sphere(Vec3 p) { return (1 / length(p)) * p; }

/// The mean of its corners, which is on the flat triangle.
Vec3 flat_mean_of(const Mesh& mesh, const Place& place) {
  Vec3 sum;
  for (std::size_t k = 0; k < static_cast<std::size_t>(place.n); ++k) {
    sum = sum + place.shares[k] * on_unit_sphere(mesh.weighted_vector(place.corners[k]));
  }
  return sum;
}

bool has(const Mesh& mesh, TriangleId t, Vec3 p) {
  const auto [a, b, c] = mesh.corners(t);
  const Vec3 pa = mesh.weighted_vector(a), pb = mesh.weighted_vector(b), pc = mesh.weighted_vector(c);
  return orientation(pa, pb, p) != Sign::negative && orientation(pb, pc, p) != Sign::negative &&
         orientation(pc, pa, p) != Sign::negative;
}

/// The triangles of a globe south of a latitude.
Mesh south_of(const Mesh& globe, double northernmost) {
  std::vector<Vec3> points;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int32_t> number(globe.n_vertices(), -1);
  for (const TriangleId t : globe.triangles()) {
    const auto corners = globe.corners(t);
    if (std::ranges::any_of(corners, [&](VertexId v) { return globe.weighted_vector(v).z > northernmost; })) continue;
    std::array<std::int32_t, 3>& triangle = triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      std::int32_t& n = number[corners[k].index];
      if (n < 0) {
        n = static_cast<std::int32_t>(points.size());
        points.push_back(globe.weighted_vector(corners[k]));
      }
      triangle[k] = n;
    }
  }
  MeshInput input;
  input.space = globe.space();
  input.sphere_points = points;
  input.triangles = triangles;
  return std::move(Mesh::build(input)->mesh);
}

TEST(PlaceOnSphere, IsWhereTheRayMeetsTheTriangle) {
  for (const std::size_t vertices : {20, 50, 2000}) {  // coarse ones are far below the sphere
    const Mesh mesh = *random_sphere({.vertices = vertices, .radius = kRadius});
    const PointLocator finder(mesh);
    Noise noise(3);
    for (int i = 0; i < 500; ++i) {
      const Vec3 p = on_unit_sphere({noise(), noise(), noise()});
      const TriangleId near(static_cast<std::size_t>(i) % mesh.n_triangles());
      const Place place = finder.find(as_point(p), i % 2 == 0 ? near : TriangleId());
      ASSERT_FALSE(place.outside);
      EXPECT_TRUE(has(mesh, place.triangle, p));
      EXPECT_LT(length(on_unit_sphere(flat_mean_of(mesh, place)) - p), 1e-14);
      EXPECT_EQ(finder.find(as_point(2.5 * p)).triangle, place.triangle) << "weights do not count";
    }
  }
}

TEST(PlaceOnSphere, OfAVertexIsThatVertexAndOfTheMiddleOfAnEdgeIsNearThatEdge) {
  const Mesh mesh = *icosahedral({.level = 2, .radius = kRadius});
  const PointLocator finder(mesh);
  for (const VertexId v : mesh.vertices()) {
    const Place place = finder.find(mesh.point(v));
    EXPECT_EQ(place.n, 1);
    EXPECT_EQ(place.corners[0], v);
  }
  for (const HalfedgeId h : mesh.halfedges()) {
    const Vec3 middle = 0.5 * (mesh.weighted_vector(mesh.origin(h)) + mesh.weighted_vector(mesh.target(h)));
    EXPECT_LT(length(flat_mean_of(mesh, finder.find(as_point(middle))) - (1 / kRadius) * middle), 1e-14);
  }
}

TEST(PlaceOnSphere, BeyondTheCoastIsTheNearestPointOfIt) {
  const Mesh ocean = south_of(*icosahedral({.level = 3, .radius = kRadius}), 0.3 * kRadius);
  const PointLocator finder(ocean);
  int outside = 0;
  Noise noise(5);
  for (int i = 0; i < 300; ++i) {
    const Vec3 p = on_unit_sphere({noise(), noise(), std::abs(noise())});
    const Place place = finder.find(as_point(p));
    bool inside = false;
    for (const TriangleId t : ocean.triangles()) inside = inside || has(ocean, t, p);
    ASSERT_EQ(place.outside, !inside);
    if (inside) continue;
    ++outside;
    for (const VertexId v : ocean.vertices()) {
      EXPECT_LE(length(flat_mean_of(ocean, place) - p), length(on_unit_sphere(ocean.weighted_vector(v)) - p) + 1e-14);
    }
  }
  EXPECT_GT(outside, 100);
}

TEST(PlacesOfVertices, OnTheSphereGiveSmoothDataWhereverAnOptimizationPutsVertices) {
  const auto field = [](Vec3 p) { return 1000 + 300 * p.x - 200 * p.y + 100 * p.z; };  // of the unit sphere
  for (const bool whole : {true, false}) {
    const Mesh globe = *random_sphere({.vertices = 1500, .seed = 4, .radius = kRadius});
    const Mesh before = whole ? globe : south_of(globe, 0.3 * kRadius);
    Mesh after = before;
    ASSERT_TRUE(optimize(after));
    const auto places = positions_of_vertices(before, after);
    const auto sources = sources_of_triangles(before, after, places);
    std::size_t moved = 0;
    for (const VertexId v : after.vertices()) {
      const Vec3 p = on_unit_sphere(after.weighted_vector(v));
      const double value =
          interpolated(places[v], [&](VertexId u) { return field(on_unit_sphere(before.weighted_vector(u))); });
      EXPECT_NEAR(value, field(p), 10);  // triangles of 0.1 are 1 % of the radius below the sphere at most
      EXPECT_EQ(interpolated(places[v], [](VertexId) { return 0.1; }), 0.1);
      const bool stayed = before.space().same_place(before.point(v), after.point(v));
      moved += stayed ? 0 : 1;
      if (stayed) {
        EXPECT_EQ(places[v].corners[0], v);
      }
    }
    EXPECT_GT(moved, after.n_vertices() / 2);
    for (const TriangleId t : after.triangles()) {
      const auto [a, b, c] = after.corners(t);
      const Vec3 middle = on_unit_sphere(after.weighted_vector(a)) + on_unit_sphere(after.weighted_vector(b)) +
                          on_unit_sphere(after.weighted_vector(c));
      if (whole) {
        EXPECT_TRUE(has(before, sources[t], middle));
      }
    }
  }
}

}  // namespace
}  // namespace temper::test
