// Errors in periodic planes: fields, laws and orders of convergence.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "errors/fields.hpp"
#include "support/lattice.hpp"
#include "temper/errors.hpp"
#include "temper/generate.hpp"
#include "temper/optimize.hpp"

namespace temper {
namespace {

ErrorReport report_of(const Mesh& mesh, const MeasureErrorsOptions& options = {}) {
  auto report = measure_errors(mesh, options);
  EXPECT_TRUE(report) << report.error().what();
  return *std::move(report);
}

/// The fields of a plane with these periods.
std::vector<error_detail::Field> fourier_fields(Vec2 period) {
  auto fields = error_detail::select_fields({}, SpaceKind::periodic_plane);
  const FieldFrame frame{{0, 0}, 0.5 * std::max(period.x, period.y)};
  for (auto& field : *fields) field.wave = error_detail::first_waves(Space::periodic(period), frame);
  return *fields;
}

TEST(ErrorPeriodic, FieldsRepeatAndTheirDerivativesAgreeWithDifferences) {
  constexpr double kStep = 1e-3;
  const Vec2 period = {3, 2}, in_frame = {2, 4.0 / 3};  // half of the longer period is 1 in the frame
  test::Noise noise(7);
  const auto derivative = [](const auto& of, Vec2 p, Vec2 step) {
    return (8 * (of(p + step) - of(p - step)) - (of(p + 2.0 * step) - of(p - 2.0 * step))) / (12 * kStep);
  };
  for (const auto& field : fourier_fields(period)) {
    for (int i = 0; i < 20; ++i) {
      const Vec2 p = {noise(), noise()}, dx{kStep, 0}, dy{0, kStep};
      const auto value = field.at(p), there = field.at(p + Vec2{in_frame.x, -2 * in_frame.y});
      EXPECT_NEAR(value.u, there.u, 1e-13) << field.field.name;
      EXPECT_NEAR(value.potential.x, there.potential.x, 1e-13) << field.field.name;
      const auto u = [&](Vec2 q) { return field.at(q).u; };
      EXPECT_NEAR(derivative(u, p, dx), value.gradient.x, 1e-8) << field.field.name;
      EXPECT_NEAR(derivative(u, p, dy), value.gradient.y, 1e-8) << field.field.name;
      const auto divergence = [&](auto member) {
        return derivative([&](Vec2 q) { return (field.at(q).*member).x; }, p, dx) +
               derivative([&](Vec2 q) { return (field.at(q).*member).y; }, p, dy);
      };
      EXPECT_NEAR(divergence(&error_detail::FieldValue::gradient), value.laplacian, 1e-6) << field.field.name;
      EXPECT_NEAR(divergence(&error_detail::FieldValue::potential), value.u, 1e-8) << field.field.name;
    }
  }
}

TEST(ErrorPeriodic, FieldsAreTheFormulasTheyAreCalledByAndHaveTheirSizes) {
  const auto fields = fourier_fields({2, 2});
  const double x = 0.3, y = -0.7, pi = std::numbers::pi;
  const std::vector<double> values = {std::sin(x + 0.2),
                                      std::cos(y - 0.3),
                                      std::sin(x + y + 0.4),
                                      std::sin(x) + 0.5 * std::sin(x - y + 0.6),
                                      std::sin(2 * x + y + 0.9),
                                      std::cos(x - 2 * y + 0.2),
                                      std::sin(x + 0.3) * std::sin(y - 0.5),
                                      std::sin(x + 0.7) + 0.5 * std::cos(y + 0.1) + 0.25 * std::sin(2 * x - y)};
  ASSERT_EQ(fields.size(), values.size());
  constexpr int kSide = 16;  // of a trigonometric polynomial the mean is exact
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_NEAR(fields[i].at(Vec2{x / pi, y / pi}).u, values[i], 1e-14) << fields[i].field.name;
    double value = 0, gradient = 0;
    for (int k = 0; k < kSide * kSide; ++k) {
      const auto at = fields[i].at(Vec2{2.0 * (k % kSide) / kSide, 2.0 * (k / kSide) / kSide});
      value += at.u * at.u / kSide / kSide;
      gradient += squared_length(at.gradient) / kSide / kSide;
    }
    EXPECT_NEAR(size_of(fields[i]).value, std::sqrt(value), 1e-12) << fields[i].field.name;
    EXPECT_NEAR(size_of(fields[i]).gradient, std::sqrt(gradient), 1e-12) << fields[i].field.name;
  }
}

TEST(ErrorPeriodic, BothProblemsConvergeWithSecondOrder) {
  const Mesh hexagons = *periodic_hexagons({.nx = 6, .ny = 6});
  Mesh random = *random_periodic({.vertices = 100, .seed = 2, .period = {1.5, 1}});
  ASSERT_TRUE(optimize(random, {.unknowns = Unknowns::positions}));
  for (const Mesh& mesh : {hexagons, random}) {
    const ErrorReport report = report_of(mesh, {.refine = 2});
    EXPECT_EQ(report.levels.back().triangles, 16 * mesh.n_triangles());
    EXPECT_EQ(report.levels.back().not_well_centered, 0U);
    EXPECT_TRUE(report.poisson.definite && report.flux.definite && report.poisson.m_matrix && report.flux.m_matrix);
    EXPECT_EQ(report.poisson.unknowns, report.vertices - 1);
    EXPECT_EQ(report.flux.unknowns, report.triangles - 1);
    for (const FieldErrors& row : report.orders) {
      EXPECT_GT(row.errors.poisson.l2, 1.85) << row.field.name;
      EXPECT_FALSE(row.errors.flux.l2 < 1.85) << row.field.name;  // NaN where errors are rounding
      for (const ErrorNorms& star : row.errors.star) EXPECT_GT(star.l2, 0.9) << row.field.name;
    }
  }
}

TEST(ErrorPeriodic, ShoresGiveTheSolutionThere) {
  const Mesh channel = *periodic_hexagons({.nx = 8, .ny = 7, .channel = true});
  const ErrorReport report = report_of(channel, {.refine = 2});
  EXPECT_EQ(report.poisson.unknowns, 8U * 5U);
  for (const FieldErrors& row : report.orders) EXPECT_NEAR(row.errors.poisson.l2, 2, 0.2) << row.field.name;
}

// Errors are relative, and fields go with the domain: nothing knows units, or how often the domain is repeated.
TEST(ErrorPeriodic, UnitsOfLengthChangeNothing) {
  const auto at = [](double distance) {
    return report_of(*periodic_hexagons({.nx = 7, .ny = 6, .distance = distance}));
  };
  const ErrorReport small = at(1), large = at(1000);
  for (std::size_t i = 0; i < small.fields.size(); ++i) {
    for (const ErrorMeasure& measure : error_measures()) {
      const double one = measure.of(small.fields[i].errors), other = measure.of(large.fields[i].errors);
      EXPECT_NEAR(one, other, 1e-10) << small.fields[i].field.name << ", " << measure.key;
    }
  }
}

TEST(ErrorPeriodic, OptimizedMeshesHaveASmallPartOfTheErrors) {
  const Mesh before = *random_periodic({.vertices = 600, .seed = 4});
  Mesh after = before;
  ASSERT_TRUE(optimize(after));
  const auto ratios = error_ratios(report_of(after), report_of(before));
  ASSERT_TRUE(ratios);
  const OperatorErrors mean = geometric_mean(*ratios);
  EXPECT_LT(mean.star[1].l2, 0.5);
  EXPECT_LT(mean.poisson.l2, 0.7);
  EXPECT_LT(mean.flux.l2, 0.4);
}

}  // namespace
}  // namespace temper
