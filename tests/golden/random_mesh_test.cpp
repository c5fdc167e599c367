// A large Delaunay mesh of random points in a non-convex polygon ends well-centered, every triangle.
#include <gtest/gtest.h>

#include "temper/generate.hpp"
#include "temper/optimize.hpp"
#include "temper/quality.hpp"

namespace temper::test {
namespace {

constexpr std::size_t kVertices = 100000;

TEST(RandomMesh, OfANonConvexPolygonEndWellCentered) {
  auto mesh = random_mesh({.vertices = kVertices});
  ASSERT_TRUE(mesh);
  ASSERT_EQ(mesh->n_vertices(), kVertices);
  const Quality before = quality(*mesh);
  EXPECT_GT(before.orthocenters_outside, before.triangles * 2 / 5);
  // Converging to more digits would only take time.
  const auto report = optimize(*mesh, {.paper = {.tolerance = 1e-3}});
  ASSERT_TRUE(report);
  const Quality after = quality(*mesh);
  EXPECT_EQ(after.well_centered_fraction, 1);
  EXPECT_EQ(after.orthocenters_outside, 0u);
  EXPECT_EQ(after.edges_not_crossed, 0u);
  EXPECT_EQ(after.non_regular_edges, 0u);
  EXPECT_EQ(after.inverted_triangles, 0u);
}

}  // namespace
}  // namespace temper::test
