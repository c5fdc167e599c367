// Meshes of the sphere: what Mesh::build accepts and refuses, and what it says.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "temper/generate.hpp"
#include "temper/mesh.hpp"

namespace temper {
namespace {

using Numbers = std::array<std::int32_t, 3>;

/// A MeshInput of the sphere that owns its arrays.
struct SphereArrays {
  std::vector<Vec3> points;
  std::vector<Numbers> triangles;
  double radius = 1;
  std::vector<double> weights = {};

  [[nodiscard]] Expected<BuiltMesh> build() const {
    MeshInput input;
    input.space = Space::sphere(radius);
    input.sphere_points = points;
    input.weights = weights;
    input.triangles = triangles;
    return Mesh::build(input);
  }
};

SphereArrays octahedron(double radius = 1) {
  SphereArrays a;
  a.radius = radius;
  for (const double s : {radius, -radius}) {
    a.points.push_back({s, 0, 0});
    a.points.push_back({0, s, 0});
    a.points.push_back({0, 0, s});
  }
  // +x +y +z −x −y −z
  a.triangles = {{0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {4, 0, 2}, {1, 0, 5}, {3, 1, 5}, {4, 3, 5}, {0, 4, 5}};
  return a;
}

SphereArrays arrays_of(const Mesh& mesh) {
  SphereArrays a;
  a.radius = mesh.space().radius();
  for (const VertexId v : mesh.vertices()) a.points.push_back(mesh.weighted_vector(v));
  for (const TriangleId t : mesh.triangles()) {
    const auto [i, j, k] = mesh.corners(t);
    a.triangles.push_back(
        {static_cast<std::int32_t>(i.index), static_cast<std::int32_t>(j.index), static_cast<std::int32_t>(k.index)});
  }
  return a;
}

void expect_refused(const SphereArrays& arrays, ErrorCode code, const std::string& part) {
  const auto built = arrays.build();
  ASSERT_FALSE(built) << part;
  EXPECT_EQ(name(built.error().code), name(code)) << built.error().what();
  EXPECT_NE(built.error().what().find(part), std::string::npos) << built.error().what();
}

TEST(SphereMesh, MayBeClosedAndKeepsPointsBitForBit) {
  const SphereArrays a = octahedron(6371220);
  const auto built = a.build();
  ASSERT_TRUE(built) << built.error().what();
  EXPECT_EQ(built->reversed_triangles, 0U);
  EXPECT_FALSE(built->mesh.validate());
  for (const VertexId v : built->mesh.vertices()) {
    EXPECT_FALSE(built->mesh.is_boundary(v));
    EXPECT_EQ(built->mesh.weighted_vector(v), a.points[v.index]);
    EXPECT_EQ(built->mesh.weight(v), 0);
  }
  EXPECT_EQ(built->mesh.n_edges(), 12U);
}

TEST(SphereMesh, ReversesTrianglesSeenFromInside) {
  SphereArrays a = octahedron();
  std::swap(a.triangles[3][0], a.triangles[3][1]);
  const auto built = a.build();
  ASSERT_TRUE(built) << built.error().what();
  EXPECT_EQ(built->reversed_triangles, 1U);
}

TEST(SphereMesh, HasWeightsAsLengths) {
  SphereArrays a = octahedron(2);
  a.weights = {0, 0.5, -1, 0, 0, 12};
  const auto built = a.build();
  ASSERT_TRUE(built) << built.error().what();
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(built->mesh.weight(VertexId(i)), a.weights[i], 1e-14);
    EXPECT_NEAR(length(built->mesh.weighted_vector(VertexId(i))), std::sqrt(4 + a.weights[i]), 1e-15);
  }
  a.weights[2] = -4;
  expect_refused(a, ErrorCode::out_of_scale, "point 2 has weight -4; expected more than -4");
}

TEST(SphereMesh, HasPolesAndAxesAtAnyPlace) {
  // Spokes along the axes and opposite to them, where turns are told apart by the last coordinate.
  for (const auto level : {0, 1, 3}) {
    const auto globe = icosahedral({.level = level});
    ASSERT_TRUE(globe) << globe.error().what();
    EXPECT_FALSE(globe->validate());
    EXPECT_EQ(globe->n_vertices(), static_cast<std::size_t>(10 * std::pow(4, level) + 2));
    EXPECT_EQ(globe->n_vertices() + globe->n_triangles() - globe->n_edges(), 2U);
  }
  SphereArrays a = octahedron();
  for (Vec3& p : a.points) p = {p.z, p.x, p.y};
  EXPECT_TRUE(a.build());
}

TEST(SphereMesh, RefusesPointsThatAreNotOnTheSphere) {
  SphereArrays a = octahedron();
  a.points[4] = {0, 0, 0};
  expect_refused(a, ErrorCode::not_on_sphere,
                 "point 4 is at (0, 0, 0), 0 from the center of the sphere; expected its radius, 1");
  a.points[4] = {0, -1.001, 0};
  expect_refused(a, ErrorCode::not_on_sphere, "1.001 from the center");
  a.points[4] = {0, -1 + 5e-7, 0};
  EXPECT_TRUE(a.build());
  a.points[4] = {0, std::nan(""), 0};
  expect_refused(a, ErrorCode::not_finite, "point 4 has coordinates (0, nan, 0)");
  a = octahedron();
  a.radius = 0x1p300;
  expect_refused(a, ErrorCode::out_of_scale, "the sphere has radius");
}

TEST(SphereMesh, RefusesTrianglesAcrossHalfOfTheSphere) {
  SphereArrays a = octahedron();
  a.triangles[0] = {0, 3, 2};
  expect_refused(a, ErrorCode::zero_area,
                 "triangle 0 has zero area: its corners point 0, point 3 and point 2 are on one great circle");
}

TEST(SphereMesh, RefusesWhatCoversASpotTwice) {
  // All of the octahedron, and a second layer with vertices of its own.
  SphereArrays a = octahedron();
  const SphereArrays other = arrays_of(*icosahedral({.level = 0}));
  for (const Vec3 p : other.points) a.points.push_back(p);
  for (const auto& [i, j, k] : other.triangles) a.triangles.push_back({i + 6, j + 6, k + 6});
  expect_refused(a, ErrorCode::overlap, "lies on top of another component");

  // A cap on a closed globe.
  SphereArrays b = octahedron();
  for (const double angle : {0.1, 2.2, 4.3})
    b.points.push_back({0.1 * std::cos(angle), 0.1 * std::sin(angle), std::sqrt(0.99)});
  b.triangles.push_back({6, 7, 8});
  expect_refused(b, ErrorCode::overlap, "lies on top of another component");

  // Two caps whose boundaries cross.
  SphereArrays c;
  for (const double shift : {0.0, 0.5}) {
    for (const double angle : {0.1, 2.2, 4.3}) {
      const Vec3 p{0.1 * std::cos(angle + shift), 0.1 * std::sin(angle + shift), 1};
      c.points.push_back((1 / length(p)) * p);
    }
  }
  c.triangles = {{0, 1, 2}, {3, 4, 5}};
  expect_refused(c, ErrorCode::overlap, "cross or touch");
}

TEST(SphereMesh, RefusesStarsThatWindTwice) {
  // A fan of five corners, each two fifths of the way round after the last: a star polygon.
  SphereArrays a;
  a.points.push_back({0, 0, 1});
  for (int k = 0; k < 5; ++k) {
    const double angle = 4 * std::numbers::pi * k / 5;
    a.points.push_back({0.1 * std::cos(angle), 0.1 * std::sin(angle), std::sqrt(0.99)});
  }
  for (std::int32_t k = 0; k < 5; ++k) a.triangles.push_back({0, k + 1, (k + 1) % 5 + 1});
  expect_refused(a, ErrorCode::overlap, "overlap");
}

TEST(SphereMesh, WithABoundaryMayBeMoreThanHalfOfTheSphere) {
  const SphereArrays whole = arrays_of(*icosahedral({.level = 2}));
  for (const double northernmost : {0.999, 0.9, 0.1, -0.5}) {
    SphereArrays part;
    std::vector<std::int32_t> number(whole.points.size(), -1);
    for (Numbers corners : whole.triangles) {
      const auto is_north = [&](std::int32_t i) { return whole.points[static_cast<std::size_t>(i)].z > northernmost; };
      if (std::any_of(corners.begin(), corners.end(), is_north)) continue;
      for (std::int32_t& i : corners) {
        if (number[static_cast<std::size_t>(i)] < 0) {
          number[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(part.points.size());
          part.points.push_back(whole.points[static_cast<std::size_t>(i)]);
        }
        i = number[static_cast<std::size_t>(i)];
      }
      part.triangles.push_back(corners);
    }
    const auto built = part.build();
    ASSERT_TRUE(built) << northernmost << ": " << built.error().what();
    EXPECT_LT(built->mesh.n_triangles(), whole.triangles.size());
    EXPECT_FALSE(built->mesh.validate());
  }
}

TEST(SphereMesh, NamesDuplicatePoles) {
  SphereArrays a = octahedron();
  a.points.push_back(a.points[2]);
  a.triangles[2][2] = a.triangles[3][2] = 6;
  expect_refused(a, ErrorCode::duplicate_point, "point 2 and point 6 are both at (0, 0, 1)");
}

TEST(SphereMesh, KeepsItsNeighborsTogetherInHilbertOrder) {
  const auto globe = random_sphere({.vertices = 3000});
  ASSERT_TRUE(globe) << globe.error().what();
  Mesh ordered = *globe;
  const MeshOrder order = hilbert_order(ordered);
  EXPECT_EQ(hilbert_ordered(*globe).mesh, ordered);
  double before = 0, after = 0;
  const auto spread = [](const Mesh& mesh) {
    double sum = 0;
    for (const HalfedgeId h : mesh.halfedges()) {
      sum += std::abs(static_cast<double>(mesh.origin(h).index) - static_cast<double>(mesh.target(h).index));
    }
    return sum / static_cast<double>(mesh.n_halfedges());
  };
  before = spread(*globe), after = spread(ordered);
  EXPECT_LT(after, 0.25 * before);
  restore_order(ordered, order);
  EXPECT_EQ(ordered, *globe);
}

}  // namespace
}  // namespace temper
