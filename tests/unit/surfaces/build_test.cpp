// SurfaceMesh::build: what it repairs, and the errors in the user's numbers.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/surface_meshes.hpp"

namespace temper::surfaces {
namespace {

ErrorCode error_of(const test::SurfaceArrays& arrays) {
  const auto built = SurfaceMesh::build(arrays.input());
  EXPECT_FALSE(built);
  return built ? ErrorCode::not_found : built.error().code;
}

TEST(SurfaceBuild, CountsComponentsAndBoundaries) {
  const auto built = SurfaceMesh::build(test::torus(12, 8).input());
  ASSERT_TRUE(built);
  EXPECT_EQ(built->components, 1U);
  EXPECT_EQ(built->reversed_triangles, 0U);
  const Mesh& mesh = built->mesh.connectivity();
  EXPECT_EQ(mesh.n_vertices() + mesh.n_triangles(), mesh.n_edges());  // Euler characteristic 0
  for (const VertexId v : mesh.vertices()) EXPECT_FALSE(mesh.is_boundary(v));

  test::SurfaceArrays two = test::icosphere(1), other = two;
  const auto shift = static_cast<std::int32_t>(two.points.size());
  for (const Vec3 p : other.points) two.points.push_back(p + Vec3{3, 0, 0});
  for (const auto& [a, b, c] : other.triangles) two.triangles.push_back({a + shift, b + shift, c + shift});
  EXPECT_EQ(SurfaceMesh::build(two.input())->components, 2U);
}

TEST(SurfaceBuild, ReversesTheFewestTriangles) {
  test::SurfaceArrays arrays = test::icosphere(2);
  const SurfaceMesh expected = test::mesh_of(arrays);
  Rng rng(1);
  std::size_t reversed = 0;
  for (auto& [a, b, c] : arrays.triangles) {
    if (rng.below(4) != 0) continue;
    std::swap(b, c);
    ++reversed;
  }
  const auto built = SurfaceMesh::build(arrays.input());
  ASSERT_TRUE(built);
  EXPECT_EQ(built->reversed_triangles, reversed);
  EXPECT_EQ(built->mesh.validate(), std::nullopt);
  for (const TriangleId t : expected.triangles()) {
    // The same cyclic order: outward normals.
    const auto [p, q, r] = built->mesh.points(t);
    const Vec3 n = cross(q.position() - p.position(), r.position() - p.position());
    EXPECT_GT(dot(n, p.position()), 0);
  }
}

TEST(SurfaceBuild, RefusesWhatIsNoSurface) {
  const test::SurfaceArrays good = test::icosphere(0);
  test::SurfaceArrays bad = good;
  bad.points[3].z = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(error_of(bad), ErrorCode::not_finite);

  bad = good;
  bad.points[3].z = 1e70;
  EXPECT_EQ(error_of(bad), ErrorCode::out_of_scale);

  bad = good;
  bad.triangles[4][1] = 12;
  EXPECT_EQ(error_of(bad), ErrorCode::index_out_of_range);

  bad = good;
  bad.triangles[4][1] = bad.triangles[4][0];
  EXPECT_EQ(error_of(bad), ErrorCode::zero_area);

  bad = good;
  bad.points.push_back({0, 0, 5});
  EXPECT_EQ(error_of(bad), ErrorCode::unused_point);

  bad = good;
  bad.points.push_back({0, 0, 5});
  bad.triangles.push_back({0, 11, 12});
  EXPECT_EQ(error_of(bad), ErrorCode::non_manifold_edge);

  bad = good;
  for (const Vec3 p : {Vec3{5, 0, 0}, Vec3{5, 1, 0}}) bad.points.push_back(p);
  bad.triangles.push_back({0, 12, 13});
  EXPECT_EQ(error_of(bad), ErrorCode::non_manifold_vertex);

  bad = good;
  bad.constrained = {{0, 3}};
  EXPECT_EQ(error_of(bad), ErrorCode::missing_edge);

  bad = good;
  bad.weights = {1, 2};
  EXPECT_EQ(error_of(bad), ErrorCode::size_mismatch);

  EXPECT_EQ(error_of({}), ErrorCode::empty_input);
}

TEST(SurfaceBuild, CountsPointsAtOnePlace) {
  const test::SurfaceArrays touching = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {-1, 0, 0}, {0, -1, 0}},
                                        {{0, 1, 2}, {3, 4, 5}}};
  EXPECT_EQ(SurfaceMesh::build(touching.input())->coincident_points, 1U);
  EXPECT_EQ(SurfaceMesh::build(test::icosphere(1).input())->coincident_points, 0U);
}

TEST(SurfaceBuild, RefusesAMoebiusStripWithItsReason) {
  test::SurfaceArrays strip;
  constexpr int kSteps = 9;
  for (int i = 0; i < kSteps; ++i) {
    const double u = 2 * std::numbers::pi * i / kSteps;
    for (const double side : {-0.3, 0.3}) {
      const double away = 1 + side * std::cos(u / 2);
      strip.points.push_back({away * std::cos(u), away * std::sin(u), side * std::sin(u / 2)});
    }
    const bool is_last = i + 1 == kSteps;
    const int a = 2 * i, b = a + 1, c = is_last ? 1 : a + 2, d = is_last ? 0 : a + 3;
    strip.triangles.insert(strip.triangles.end(), {{a, c, b}, {b, c, d}});
  }
  const auto built = SurfaceMesh::build(strip.input());
  ASSERT_FALSE(built);
  EXPECT_EQ(built.error().code, ErrorCode::unsupported);
  EXPECT_NE(built.error().message.find("Möbius"), std::string::npos);
}

TEST(SurfaceBuild, ConstrainsEdgesBetweenRegions) {
  test::SurfaceArrays arrays = test::icosphere(1);
  for (const auto& triangle : arrays.triangles)
    arrays.regions.push_back(arrays.points[static_cast<std::size_t>(triangle[0])].z > 0 ? 1 : 0);
  const SurfaceMesh surface = test::mesh_of(arrays);
  const Mesh& mesh = surface.connectivity();
  std::size_t constrained = 0;
  for (const HalfedgeId h : mesh.halfedges()) {
    const bool between = mesh.region(Mesh::triangle(h)) != mesh.region(Mesh::triangle(mesh.twin(h)));
    EXPECT_EQ(mesh.is_constrained(h), between);
    constrained += between ? 1 : 0;
  }
  EXPECT_GT(constrained, 0U);
}

}  // namespace
}  // namespace temper::surfaces
