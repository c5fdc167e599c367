// The errors of solvers on tetrahedra: exactness, invariance, orders, and the fields.
#include <gtest/gtest.h>

#include <cmath>

#include "errors/fields.hpp"
#include "support/tet_lattice.hpp"
#include "temper/tets/errors.hpp"

namespace temper::tets {
namespace {

ErrorReport measured(const test::TetArrays& arrays, const MeasureErrorsOptions& options = {}) {
  return *measure_errors(test::mesh_of(arrays), options);
}

/// Cubes in six, with random places and weights: some dual lengths are negative.
test::TetArrays rough() { return test::shaken(test::cubes(4, test::kSixTets), 0.1, 0.2); }

TEST(TetErrors, LinearFieldsAreExactForFluxesAndBothSchemesOnAnyMesh) {
  for (const test::TetArrays& arrays : {rough(), test::cubes(3, test::kSixTets), test::cubes(2, test::kFiveTets)}) {
    const ErrorReport report = measured(arrays, {.fields = {"exact"}});
    ASSERT_EQ(report.fields.size(), 1U);
    const OperatorErrors& errors = report.fields[0].errors;
    for (const ErrorNorms& norms : {errors.star[1], errors.star[2], errors.poisson, errors.flux}) {
      EXPECT_LT(norms.l2, 1e-10);
      EXPECT_LT(norms.max, 1e-9);
    }
    EXPECT_GT(errors.star[0].l2, 1e-3) << "a cell on the boundary is not around its vertex";
  }
}

TEST(TetErrors, OrthocentersThatCoincideAreOneUnknown) {
  const ErrorReport report = measured(test::cubes(3, test::kSixTets));
  EXPECT_EQ(report.flux.merged, 6U * 27);
  EXPECT_EQ(report.flux.largest_over_median, HUGE_VAL);
  EXPECT_FALSE(report.flux.singular);
  EXPECT_EQ(report.flux.negative, 0U);
  // The cells are the cubes: the scheme of seven points, whose cells on the boundary have half of the distance.
  EXPECT_TRUE(report.flux.m_matrix);
  for (const FieldErrors& row : report.fields) EXPECT_LT(row.errors.flux.l2, 0.15) << row.field.name;
}

TEST(TetErrors, CountsAreThoseOfTheMeshAndSignsMakeAnMMatrix) {
  const ErrorReport bad = measured(rough()), good = measured(test::body_centered(3));
  EXPECT_EQ(bad.vertices, 125U);
  EXPECT_EQ(bad.tetrahedra, 384U);
  EXPECT_EQ(bad.poisson.unknowns, 27U);
  EXPECT_EQ(bad.flux.unknowns, 384U);
  EXPECT_GT(bad.non_regular_faces, 0U);
  EXPECT_EQ(bad.flux.negative, bad.non_regular_faces + bad.negative_boundary_duals);
  EXPECT_FALSE(bad.flux.m_matrix);
  EXPECT_EQ(good.not_well_centered + good.flux.negative + good.poisson.negative, 0U);
  EXPECT_TRUE(good.flux.m_matrix && good.poisson.m_matrix && good.flux.definite && good.poisson.definite);
}

TEST(TetErrors, NoErrorDependsOnUnitsPlaceOrAnOffsetOfWeights) {
  const test::TetArrays arrays = rough();
  test::TetArrays moved = arrays;
  for (Vec3& p : moved.points) p = 8.0 * p + Vec3{16, -8, 32};
  for (double& w : moved.weights) w = 64 * w + 4;
  const ErrorReport a = measured(arrays), b = measured(moved);
  ASSERT_EQ(a.fields.size(), b.fields.size());
  for (std::size_t i = 0; i < a.fields.size(); ++i) {
    for (const ErrorMeasure& m : error_measures()) {
      const double expected = m.of(a.fields[i].errors);
      EXPECT_NEAR(m.of(b.fields[i].errors), expected, 1e-7 * expected) << a.fields[i].field.name << " " << m.key;
    }
  }
  const auto same = error_ratios(a, a);
  ASSERT_TRUE(same);
  EXPECT_NEAR(geometric_mean(*same).flux.l2, 1, 1e-15);
  EXPECT_FALSE(error_ratios(a, b)) << "other frames";
}

/// The order of the errors between meshes of n and 2 n cubes in [−1, 1]³.
template <class Make>
OperatorErrors orders(int n, const Make& make) {
  const auto mean = [&](int cubes) {
    test::TetArrays arrays = make(cubes);
    for (Vec3& p : arrays.points) p = (2.0 / cubes) * p - Vec3{1, 1, 1};
    const MeasureErrorsOptions options = {.fields = {"oblique", "counter", "rising"}, .frame = FieldFrame{{}, 1}};
    return geometric_mean(measured(arrays, options).fields);
  };
  const OperatorErrors coarse = mean(n), fine = mean(2 * n);
  OperatorErrors result;
  for (const ErrorMeasure& m : error_measures()) m.at(result) = std::log2(m.of(coarse) / m.of(fine));
  return result;
}

TEST(TetErrors, BothSchemesAreOfSecondOrder) {
  const OperatorErrors cubes = orders(4, [](int n) { return test::cubes(n, test::kSixTets); });
  EXPECT_NEAR(cubes.poisson.l2, 2, 0.2);
  EXPECT_NEAR(cubes.flux.l2, 2, 0.2);
  EXPECT_NEAR(cubes.poisson.max, 2, 0.3);
  // The domain of these is without pyramids on the sides of the cube: it grows with n, and the errors with it.
  const OperatorErrors lattice = orders(4, [](int n) { return test::shaken(test::body_centered(n), 0.05, 0); });
  EXPECT_GT(lattice.poisson.l2, 1.5);
  EXPECT_GT(lattice.flux.l2, 1.5);
  for (const ErrorNorms& star : lattice.star) EXPECT_GT(star.l2, 0.8);
}

TEST(TetErrors, DerivativesOfTheFieldsAreThoseOfTheirValues) {
  constexpr double kStep = 1e-4;
  const Vec3 p = {0.31, -0.42, 0.57};
  for (const error_detail::Field& field : error_detail::fields_of_space()) {
    const auto value = [&](double x, double y, double z) { return field.at(Vec3{x, y, z}).u; };
    const auto here = field.at(p);
    const std::array<std::array<double, 2>, 3> around = {
        {{value(p.x - kStep, p.y, p.z), value(p.x + kStep, p.y, p.z)},
         {value(p.x, p.y - kStep, p.z), value(p.x, p.y + kStep, p.z)},
         {value(p.x, p.y, p.z - kStep), value(p.x, p.y, p.z + kStep)}}};
    const std::array<double, 3> gradient = {here.gradient.x, here.gradient.y, here.gradient.z};
    double laplacian = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR((around[k][1] - around[k][0]) / (2 * kStep), gradient[k], 1e-6) << field.field.name;
      laplacian += (around[k][0] + around[k][1] - 2 * here.u) / (kStep * kStep);
    }
    EXPECT_NEAR(laplacian, here.laplacian, 1e-5) << field.field.name;
  }
}

TEST(TetErrors, UnknownFieldsAndFramesAreRefused) {
  const TetMesh mesh = test::mesh_of(test::cubes(1, test::kSixTets));
  EXPECT_EQ(measure_errors(mesh, {.fields = {"bump"}}).error().message.substr(0, 16), "no field 'bump';");
  EXPECT_EQ(measure_errors(mesh, {.frame = FieldFrame{{0, 0, 0}, 0}}).error().code, ErrorCode::invalid_option);
  EXPECT_EQ(measure_errors({}).error().code, ErrorCode::empty_input);
}

}  // namespace
}  // namespace temper::tets
