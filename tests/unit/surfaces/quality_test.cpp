// The report on surfaces: the plane's numbers in the plane, after rigid motions, and on folded paper.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "support/surface_meshes.hpp"
#include "temper/generate.hpp"

namespace temper::surfaces {
namespace {

void expect_same(const temper::Quality& a, const temper::Quality& b, double relative) {
  for (const QualityMeasure& m : quality_measures()) {
    const double x = m.of(a), y = m.of(b);
    if (m.count) {
      EXPECT_EQ(x, y) << m.key;
    } else if (std::isfinite(x) && std::isfinite(y)) {
      EXPECT_NEAR(x, y, relative * std::max(1.0, std::abs(x))) << m.key;
    }
  }
  for (const Criterion criterion : {Criterion::well_centered, Criterion::coefficients, Criterion::distances})
    EXPECT_EQ(violations(a, criterion), violations(b, criterion));
}

Mesh with_weights(Mesh mesh, std::uint64_t seed) {
  Rng rng(seed);
  for (const VertexId v : mesh.vertices()) mesh.set_weight(v, rng.uniform(0, 1e-3));
  return mesh;
}

TEST(SurfaceQuality, APlaneMeshHasTheNumbersOfThePlane) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Mesh plane = with_weights(*random_mesh({.vertices = 300, .seed = seed}), seed);
    const temper::Quality expected = temper::quality(plane), q = quality(test::mesh_of(test::lifted(plane)));
    expect_same(q, expected, 1e-8);
    ASSERT_EQ(q.worst.size(), expected.worst.size());
    for (std::size_t i = 0; i < q.worst.size(); ++i) {
      EXPECT_EQ(q.worst[i].triangle, expected.worst[i].triangle);
      EXPECT_EQ(q.worst[i].vertices, expected.worst[i].vertices);
      EXPECT_EQ(q.worst[i].why.substr(0, 20), expected.worst[i].why.substr(0, 20));
    }
    EXPECT_EQ(q.min_coefficient_place.vertices, expected.min_coefficient_place.vertices);
    EXPECT_GT(violations(q, Criterion::well_centered), 0U);
  }
}

TEST(SurfaceQuality, ARigidMotionChangesNothingButRounding) {
  const Mesh plane = with_weights(*random_mesh({.vertices = 200, .seed = 4}), 4);
  const double a = 0.3, b = 1.1;
  const auto turned = [&](Vec2 p) {
    const Vec3 q = {std::cos(a) * p.x - std::sin(a) * p.y, std::sin(a) * p.x + std::cos(a) * p.y, 0};
    return Vec3{q.x + 2, std::cos(b) * q.y - 1, std::sin(b) * q.y + 0.5};
  };
  expect_same(quality(test::mesh_of(test::mapped(plane, turned))), temper::quality(plane), 1e-8);
}

TEST(SurfaceQuality, FoldedPaperHasTheNumbersOfItsUnfolding) {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const Mesh strip = test::plane_strip(8, seed);
    const SurfaceMesh folded = test::mesh_of(test::folded(strip, 0.7));
    expect_same(quality(folded), temper::quality(strip), 1e-9);
    EXPECT_GT(violations(quality(folded), Criterion::coefficients), 0U);
    for (const TriangleId t : strip.triangles()) {
      const TriangleQuality here = triangle_quality(folded, t), there = temper::triangle_quality(strip, t);
      EXPECT_EQ(here.well_centered, there.well_centered);
      EXPECT_NEAR(here.min_h_over_l, there.min_h_over_l, 1e-11);
      EXPECT_NEAR(here.min_d_over_l, there.min_d_over_l, 1e-12);
      EXPECT_NEAR(here.min_angle_deg, there.min_angle_deg, 1e-11);
    }
  }
}

TEST(SurfaceQuality, ViolationsAreThoseOfTheReport) {
  const Mesh strip = test::plane_strip(8, 9);
  const SurfaceMesh folded = test::mesh_of(test::folded(strip, 0.4));
  for (const Criterion criterion : {Criterion::coefficients, Criterion::distances}) {
    const auto here = violated_edges(folded, criterion), there = temper::violated_edges(strip, criterion);
    ASSERT_EQ(here.size(), there.size());
    EXPECT_EQ(here.size(), violations(quality(folded), criterion));
    for (std::size_t i = 0; i < here.size(); ++i) {
      EXPECT_EQ(here[i].edge, there[i].edge);
      EXPECT_EQ(here[i].kind, there[i].kind);
      EXPECT_NEAR(here[i].dual_over_l, there[i].dual_over_l, 1e-11);
    }
    EXPECT_EQ(cells_at_violations(folded, criterion), temper::cells_at_violations(strip, criterion));
    EXPECT_FALSE(meets(folded, criterion));
  }
  EXPECT_EQ(cells_at_violations(folded, Criterion::well_centered),
            temper::cells_at_violations(strip, Criterion::well_centered));
}

TEST(SurfaceQuality, AnIcosphereIsWellCenteredAndHalfATorusOfTrapezoidsIsNot) {
  const Quality sphere = quality(test::mesh_of(test::icosphere(3)));
  EXPECT_EQ(sphere.well_centered_fraction, 1);
  EXPECT_EQ(sphere.boundary_edges, 0U);
  EXPECT_EQ(sphere.vertices + sphere.triangles, sphere.edges + 2);
  const Quality torus = quality(test::mesh_of(test::torus(24, 12)));
  EXPECT_EQ(torus.well_centered_fraction, 0.5);  // the wider angle of each trapezoid is obtuse
}

TEST(SurfaceQuality, PublicSurfacesHaveTheBadTrianglesThatOthersCounted) {
  const std::filesystem::path folder = TEMPER_SHARED "/surfaces";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no public surfaces here";
  const std::pair<const char*, std::size_t> counted[] = {
      {"spot.obj", 851}, {"3holes.off", 505}, {"bunny.off", 2724}, {"cow.off", 2887}};
  for (const auto& [name, bad] : counted) {
    const Quality q = quality(test::mesh_of(test::without_unused(test::read_surface(folder / name))));
    EXPECT_EQ(violations(q, Criterion::well_centered), bad) << name;
  }
}

}  // namespace
}  // namespace temper::surfaces
