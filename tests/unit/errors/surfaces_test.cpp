// Errors of solvers on curved surfaces: the numbers of the plane in the plane, exact linear fields, order 2.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "errors/fields.hpp"
#include "feasibility/demand.hpp"
#include "optimize/run/judge.hpp"
#include "support/surface_meshes.hpp"
#include "temper/detail/lp.hpp"
#include "temper/generate.hpp"
#include "temper/solvers.hpp"
#include "temper/surface_errors.hpp"

namespace temper::surfaces {
namespace {

ErrorReport measured(const SurfaceMesh& mesh, const MeasureErrorsOptions& options = {}) {
  const auto report = measure_errors(mesh, options);
  EXPECT_TRUE(report) << report.error().what();
  return *report;
}

error_detail::FieldSize size_of_field(std::string_view name, std::span<const error_detail::Field> fields) {
  for (const error_detail::Field& f : fields) {
    if (f.field.name == name) return error_detail::size_of(f);
  }
  ADD_FAILURE() << name;
  return {};
}

TEST(SurfaceErrors, InThePlaneTheyAreThePlanes) {
  Mesh plane = *random_mesh({.vertices = 120, .seed = 3});
  Rng rng(3);
  for (const VertexId v : plane.vertices()) plane.set_weight(v, rng.uniform(-0.001, 0.001));
  // These fields are the same functions where z = 0, but their sizes are those over a cube.
  const std::vector<std::string> names = {"oblique", "counter", "linear"};
  const temper::ErrorReport flat = *temper::measure_errors(plane, {.fields = names, .condition = true});
  const ErrorReport lifted = measured(test::mesh_of(test::lifted(plane)), {.fields = names, .condition = true});
  ASSERT_EQ(flat.fields.size(), lifted.fields.size());
  EXPECT_EQ(flat.frame, (temper::FieldFrame{{lifted.frame.center.x, lifted.frame.center.y}, lifted.frame.half_size}));
  for (std::size_t i = 0; i < flat.fields.size(); ++i) {
    const std::string_view name = flat.fields[i].field.name;
    ASSERT_EQ(lifted.fields[i].field.name, name);
    const auto plane_size = size_of_field(name, error_detail::all_fields());
    const auto space_size = size_of_field(name, error_detail::fields_of_space());
    for (const ErrorMeasure& measure : error_measures()) {
      const bool is_star1 = measure.key.substr(0, 5) == "star1";
      const double factor = is_star1 ? space_size.gradient / plane_size.gradient : space_size.value / plane_size.value;
      const double expected = measure.of(flat.fields[i].errors);
      EXPECT_NEAR(measure.of(lifted.fields[i].errors) * factor, expected, 1e-9 * expected + 1e-11)
          << name << ' ' << measure.key;
    }
  }
  EXPECT_EQ(flat.poisson.unknowns, lifted.poisson.unknowns);
  EXPECT_EQ(flat.poisson.negative, lifted.poisson.negative);
  EXPECT_EQ(flat.flux.negative, lifted.flux.negative);
  EXPECT_EQ(flat.flux.m_matrix, lifted.flux.m_matrix);
  EXPECT_NEAR(*flat.poisson.condition, *lifted.poisson.condition, 1e-6 * *flat.poisson.condition);
  EXPECT_EQ(flat.not_well_centered, lifted.not_well_centered);
  EXPECT_EQ(flat.negative_star0, lifted.negative_star0);
}

TEST(SurfaceErrors, BothSchemesReproduceLinearFieldsOnAnySurface) {
  const auto expect_exact = [](const test::SurfaceArrays& arrays, const std::string& what) {
    const ErrorReport report = measured(test::mesh_of(arrays), {.fields = {"linear"}});
    EXPECT_LT(report.fields[0].errors.poisson.max, 1e-11) << what;
    EXPECT_LT(report.fields[0].errors.flux.max, 1e-11) << what;
    EXPECT_LT(report.fields[0].errors.star[1].max, 1e-11) << what;
    EXPECT_GT(report.fields[0].errors.star[0].max, 0) << what;
  };
  expect_exact(test::icosphere(1), "icosphere");
  expect_exact(test::torus(12, 8, true), "torus");
  expect_exact(test::folded(test::plane_strip(8, 2), 0.7), "folded paper with weights");
  Rng rng(4);
  test::SurfaceArrays rough = test::icosphere(2);
  for (Vec3& p : rough.points) p = rng.uniform(0.9, 1.1) * p;
  for (std::size_t i = 0; i < rough.points.size(); ++i) rough.weights.push_back(rng.uniform(-0.01, 0.01));
  expect_exact(rough, "rough sphere");
  rough.triangles.resize(rough.triangles.size() / 2);
  expect_exact(test::without_unused({rough.points, rough.triangles}), "with a boundary");
}

TEST(SurfaceErrors, OfBothSchemesHaveOrderTwo) {
  const auto expect_order = [](const test::SurfaceArrays& coarse, const test::SurfaceArrays& fine) {
    const OperatorErrors a = geometric_mean(measured(test::mesh_of(coarse)).fields);
    const OperatorErrors b = geometric_mean(measured(test::mesh_of(fine)).fields);
    EXPECT_NEAR(std::log2(a.poisson.l2 / b.poisson.l2), 2, 0.15);
    EXPECT_NEAR(std::log2(a.flux.l2 / b.flux.l2), 2, 0.15);
    EXPECT_GT(std::log2(a.star[1].l2 / b.star[1].l2), 0.8);
    EXPECT_GT(std::log2(a.star[0].l2 / b.star[0].l2), 0.8);
    EXPECT_GT(std::log2(a.star[2].l2 / b.star[2].l2), 0.8);
  };
  expect_order(test::icosphere(3), test::icosphere(4));
  expect_order(test::torus(32, 16, true), test::torus(64, 32, true));
}

TEST(SurfaceErrors, DoNotChangeWithPlaceOrUnit) {
  test::SurfaceArrays arrays = test::torus(14, 8, true), moved = arrays;
  for (Vec3& p : moved.points) p = 4.0 * (p + Vec3{3, -2, 5});
  const ErrorReport a = measured(test::mesh_of(arrays)), b = measured(test::mesh_of(moved));
  for (std::size_t i = 0; i < a.fields.size(); ++i) {
    for (const ErrorMeasure& measure : error_measures())
      EXPECT_NEAR(measure.of(a.fields[i].errors), measure.of(b.fields[i].errors), 1e-9) << measure.key;
  }
  const auto ratios = error_ratios(a, a);
  ASSERT_TRUE(ratios);
  EXPECT_EQ(geometric_mean(*ratios).poisson.l2, 1);
  EXPECT_FALSE(error_ratios(a, b)) << "another frame";
}

TEST(SurfaceErrors, SquaredErrorsAreThoseOfTheScheme) {
  const SurfaceMesh mesh = test::mesh_of(test::torus(16, 8));
  const ErrorReport report = measured(mesh, {.fields = {"chosen"}});
  const std::pair<Scheme, std::vector<std::string_view>> expected[] = {
      {Scheme::vertex, {"poisson.l2", "poisson.max"}},
      {Scheme::cell, {"flux.l2", "flux.max"}},
      {Scheme::all, {"poisson.l2", "poisson.max", "flux.l2", "flux.max"}},
      {Scheme::stars, {"star0.l2", "star0.max", "star1.l2", "star1.max", "star2.l2", "star2.max"}}};
  for (const auto& [scheme, keys] : expected) {
    const std::vector<double> squared = squared_solver_errors(mesh, scheme);
    ASSERT_EQ(squared.size(), 2 * keys.size());
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const auto measures = error_measures();
      const auto measure =
          std::find_if(measures.begin(), measures.end(), [&](const ErrorMeasure& m) { return m.key == keys[i]; });
      double sum = 0;
      for (const FieldErrors& row : report.fields) sum += measure->of(row.errors) * measure->of(row.errors);
      EXPECT_EQ(squared[i], sum) << keys[i];
      double product = 1;
      for (const FieldErrors& row : report.fields) product *= measure->of(row.errors);
      const double mean = std::pow(product, 2.0 / static_cast<double>(report.fields.size()));
      EXPECT_NEAR(squared[keys.size() + i], mean, 1e-12 * mean) << keys[i];
    }
  }
}

TEST(SurfaceErrors, OfTheSchemeAreNotLargerWhereTheyDecide) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    Rng rng(seed);
    test::SurfaceArrays arrays = test::torus(16, 8);
    for (Vec3& p : arrays.points) p.z += rng.uniform(-0.02, 0.02);
    const SurfaceMesh input = test::mesh_of(arrays);
    for (const Scheme scheme : {Scheme::all, Scheme::vertex, Scheme::cell, Scheme::stars}) {
      SurfaceOptions options;
      options.surface_distance = 0.02;
      options.scheme = scheme, options.criterion = criterion_of(scheme);
      SurfaceMesh with = input, without = input;
      const auto by_energy = optimize(without, *clp_solver(), options);
      options.squared_errors = squared_errors();
      const auto by_errors = optimize(with, *clp_solver(), options);
      ASSERT_TRUE(by_energy && by_errors);
      ASSERT_GT(by_energy->violations_before, 0U);
      EXPECT_LE(by_errors->violations_after, by_energy->violations_after);
      if (by_errors->violations_after + by_energy->violations_after > 0) continue;
      const std::vector<double> before = squared_solver_errors(input, scheme);
      EXPECT_LE(largest_ratio(squared_solver_errors(with, scheme), before),
                largest_ratio(squared_solver_errors(without, scheme), before));
    }
  }
}

// Each change of weights disturbs coefficients whose errors cancel.
TEST(SurfaceErrors, AreNotLargerThanWithTheLeastChangeOfWeights) {
  int n_with_weights = 0;
  for (const std::uint64_t seed : {1, 4}) {
    Mesh plane = *random_mesh({.vertices = 45, .seed = seed});
    test::SurfaceArrays arrays = test::lifted(plane);
    for (Vec3& p : arrays.points) p.z = 0.25 * std::sin(4 * p.x) * std::cos(3 * p.y);
    const SurfaceMesh input = test::mesh_of(arrays);
    SurfaceOptions options;
    options.scheme = Scheme::vertex, options.criterion = criterion_of(options.scheme);
    options.squared_errors = squared_errors();
    WeightOptions least;
    least.goal = WeightGoal::change, least.from_input = true;
    least.margin = 0.1 * options.margin, least.constraints = constraints_of(options.criterion);
    const auto weights = find_weights(input, *clp_solver(), least);
    if (!weights) continue;
    SurfaceMesh weighted = input, result = input;
    for (const VertexId v : input.vertices()) weighted.set_weight(v, weights->weights[v]);
    ASSERT_TRUE(optimize(result, *clp_solver(), options));
    const std::vector<double> before = squared_solver_errors(input, options.scheme);
    const double ratio = largest_ratio(squared_solver_errors(weighted, options.scheme), before);
    EXPECT_LE(largest_ratio(squared_solver_errors(result, options.scheme), before), ratio * (1 + 1e-9)) << seed;
    ++n_with_weights;
  }
  EXPECT_GT(n_with_weights, 1);
}

TEST(SurfaceErrors, BadInputIsNamed) {
  const SurfaceMesh mesh = test::mesh_of(test::icosphere(0));
  EXPECT_EQ(measure_errors({}).error().code, ErrorCode::empty_input);
  const auto error = measure_errors(mesh, {.fields = {"product"}}).error();
  EXPECT_EQ(error.message.substr(0, 91),
            "no field 'product'; the fields of tetrahedra and curved surfaces are all, chosen, held-back");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(measure_errors(mesh, {.frame = FieldFrame{{0, 0, nan}, 1}}).error().code, ErrorCode::invalid_option);
  EXPECT_EQ(measure_errors(mesh, {.frame = FieldFrame{{0, 0, 0}, 0}}).error().code, ErrorCode::invalid_option);
}

}  // namespace
}  // namespace temper::surfaces
