// Meshes of periodic planes from nothing.
#include <gtest/gtest.h>

#include <cmath>

#include "mesh/bad_triangles.hpp"
#include "temper/generate.hpp"
#include "temper/quality.hpp"
#include "temper/regularity.hpp"

namespace temper {
namespace {

TEST(PeriodicMeshes, RandomPointsAreDelaunayAndCoverTheDomainOnce) {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const auto mesh =
        random_periodic({.vertices = 40 * seed * seed, .seed = seed, .period = {1.0 * static_cast<double>(seed), 1}});
    ASSERT_TRUE(mesh) << mesh.error().what();
    EXPECT_FALSE(mesh->validate());
    EXPECT_EQ(mesh->n_triangles(), 2 * mesh->n_vertices());
    EXPECT_EQ(count_non_regular_edges(*mesh), 0U);
    EXPECT_GT(bad_triangles(*mesh).size(), mesh->n_triangles() / 4);
  }
}

TEST(PeriodicMeshes, HexagonsAreWellCenteredAndAlike) {
  for (const bool channel : {false, true}) {
    const auto mesh = periodic_hexagons({.nx = 9, .ny = 6, .distance = 3, .channel = channel});
    ASSERT_TRUE(mesh) << mesh.error().what();
    EXPECT_EQ(mesh->n_vertices(), 54U);
    EXPECT_EQ(mesh->n_triangles(), channel ? 90U : 108U);
    const Quality q = quality(*mesh);
    EXPECT_EQ(q.boundary_edges, channel ? 18U : 0U);
    EXPECT_NEAR(q.min_angle_deg, 60, 1e-10);
    EXPECT_EQ(q.well_centered_fraction, 1);
  }
}

TEST(PeriodicMeshes, WhatCannotBeIsRefused) {
  EXPECT_EQ(periodic_hexagons({.nx = 4, .ny = 5}).error().message,
            "an even number of rows of hexagons fits into a period");
  EXPECT_FALSE(periodic_hexagons({.nx = 2}));
  EXPECT_FALSE(periodic_hexagons({.distance = 0}));
  EXPECT_FALSE(random_periodic({.vertices = 15}));
  EXPECT_FALSE(random_periodic({.period = {1, 0}}));
  const std::vector<Vec2> few = {{0, 0}, {0.3, 0.1}, {0.4, 0.7}, {0.8, 0.4}}, twice = {{0, 0}, {0.5, 0.5}, {1, 1}};
  EXPECT_FALSE(periodic_delaunay(few, {1, 1}));
  EXPECT_EQ(periodic_delaunay(twice, {1, 1}).error().code, ErrorCode::duplicate_point);
}

}  // namespace
}  // namespace temper
