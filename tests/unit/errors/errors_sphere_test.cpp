// Errors on the sphere: laws, orders of convergence, and the stars by plainer means.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "errors/fields.hpp"
#include "errors/stars.hpp"
#include "support/lattice.hpp"
#include "support/spheres.hpp"
#include "temper/dec.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/errors.hpp"

namespace temper {
namespace {

ErrorReport verified(const Mesh& mesh, const MeasureErrorsOptions& options = {}) {
  auto report = measure_errors(mesh, options);
  EXPECT_TRUE(report) << report.error().what();
  return *std::move(report);
}

void expect_near(const ErrorReport& a, const ErrorReport& b, double tolerance) {
  ASSERT_EQ(a.fields.size(), b.fields.size());
  ASSERT_GT(a.fields.size(), 0u);
  for (std::size_t i = 0; i < a.fields.size(); ++i) {
    for (const ErrorMeasure& measure : error_measures()) {
      const double one = measure.of(a.fields[i].errors), other = measure.of(b.fields[i].errors);
      EXPECT_NEAR(one, other, tolerance * other) << a.fields[i].field.name << ", " << measure.key;
    }
  }
}

TEST(ErrorSphere, BothProblemsConvergeWithSecondOrderOnBisectedIcosahedra) {
  const ErrorReport report = verified(*icosahedral({.level = 2}), {.refine = 2});
  ASSERT_EQ(report.levels.size(), 3u);
  EXPECT_EQ(report.levels[2].triangles, 20u * 16 * 16);
  EXPECT_EQ(report.levels[2].non_regular_edges, 0u);
  EXPECT_EQ(report.levels[2].not_well_centered, 0u);
  EXPECT_TRUE(report.poisson.definite && report.flux.definite && report.poisson.m_matrix && report.flux.m_matrix);
  EXPECT_EQ(report.poisson.unknowns, report.vertices - 1);
  EXPECT_EQ(report.flux.unknowns, report.triangles - 1);
  for (const FieldErrors& row : report.orders) {
    EXPECT_NEAR(row.errors.poisson.l2, 2, 0.1) << row.field.name;
    EXPECT_NEAR(row.errors.flux.l2, 2, 0.1) << row.field.name;
    for (const ErrorNorms& star : row.errors.star) EXPECT_GT(star.l2, 0.97) << row.field.name;
  }
}

TEST(ErrorSphere, ACoastGivesTheSolutionThere) {
  const ErrorReport report = verified(test::ocean(*icosahedral({.level = 3}), 0.5), {.refine = 1});
  EXPECT_TRUE(report.poisson.definite && report.flux.definite);
  EXPECT_LT(report.poisson.unknowns, report.vertices - 1);
  const OperatorErrors orders = arithmetic_mean(report.orders);
  EXPECT_GT(orders.poisson.l2, 1.8);
  EXPECT_GT(orders.flux.l2, 1.4);
}

TEST(ErrorSphere, TheRadiusAndOneScaleOfAllPointsChangeNothing) {
  Mesh mesh = test::globe(300, 2);
  test::Noise noise(2);
  for (const VertexId v : mesh.vertices()) mesh.set_weight(v, 0.002 * noise());
  const ErrorReport plain = verified(mesh);
  Mesh larger = mesh;
  larger.set_space(Space::sphere(1024));
  for (const VertexId v : mesh.vertices()) larger.set_point(v, as_point(2048.0 * mesh.weighted_vector(v)));
  expect_near(verified(larger), plain, 1e-10);
}

// Flows of the potential out of a cell and out of a triangle against sums of u over small triangles.
TEST(ErrorSphere, IntegralsAreFlows) {
  using namespace error_detail;
  const auto mesh = icosahedral({.level = 1});
  const DecComplex complex = dec_operators(*mesh);
  const Setting setting = {*mesh, complex, field_frame(*mesh), 0, nullptr, true};
  for (const Field& field : all_fields(SpaceKind::sphere)) {
    const auto means = edge_means(setting, field);
    double flow = 0, sum = 0;
    const TriangleId t(7);
    for (int k = 0; k < 3; ++k) {
      const HalfedgeId h = Mesh::halfedge(t, k);
      const EdgeId e = complex.edge_of_halfedge[h];
      const double side = complex.edges[e].left == t ? 1 : -1;
      flow -= side * complex.edges[e].length * means[e].potential.y;
    }
    const auto [i, j, k] = mesh->corners(t);
    const Vec3 p = mesh->weighted_vector(i), a = mesh->weighted_vector(j) - p, b = mesh->weighted_vector(k) - p;
    constexpr int kSteps = 64;
    const auto add = [&](double s, double r, double turn) {
      const auto at = [&](double x, double y) { return p + ((s + x) / kSteps) * a + ((r + y) / kSteps) * b; };
      const Vec3 q1 = at(0, 0), q2 = at(turn, 0), q3 = at(0, turn), middle = q1 + q2 + q3;
      sum += std::abs(solid_angle(q1, q2, q3)) * field.at((1 / length(middle)) * middle).u;
    };
    for (int s = 0; s < kSteps; ++s) {
      for (int r = 0; s + r < kSteps; ++r) {
        add(s, r, 1);
        if (s > 0) add(s, r + 1.0, -1);
      }
    }
    EXPECT_NEAR(flow, sum, 1e-4 * complex.areas[t]) << field.field.name;
  }
}

TEST(ErrorSphere, FieldsOfThePlaneAreNoneOfTheSphere) {
  const auto report = measure_errors(*icosahedral({.level = 1}), {.fields = {"bump"}});
  ASSERT_FALSE(report);
  EXPECT_EQ(
      report.error().message,
      "no field 'bump'; the fields on the sphere are all, chosen, held-back, axial, saddle, quilt, tilted, belts, "
      "octants, petals, mixed");
}

}  // namespace
}  // namespace temper
