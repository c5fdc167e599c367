// The model of errors: what it measures is what measure_errors() measures, its derivatives are those of differences,
// and it knows neither units nor the numbering of a mesh.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/rng.hpp"
#include "support/std_threads.hpp"
#include "temper/detail/connectivity.hpp"
#include "temper/detail/discretization_error.hpp"
#include "temper/errors.hpp"
#include "temper/generate.hpp"
#include "temper/optimize.hpp"

namespace temper::test {
namespace {

Mesh well_centered_mesh(std::size_t vertices, std::uint64_t seed = 3) {
  Mesh mesh = *random_mesh({.vertices = vertices, .seed = seed});
  EXPECT_TRUE(optimize(mesh));
  return mesh;
}

using Gradients = std::vector<DiscretizationError::Gradient>;

double& unknown(WeightedPoint& p, int i) { return i == 0 ? p.x : i == 1 ? p.y : p.w; }

TEST(SolverErrorModel, DerivativesAreThoseOfDifferencesAtSecondOrder) {
  const Mesh mesh = well_centered_mesh(60);
  const auto model = *make_discretization_error(mesh, {.fields = 5});
  Gradients gradients;
  ASSERT_EQ(model->errors(mesh, gradients).size(), 2u);
  ASSERT_EQ(gradients.size(), 2u);
  for (std::size_t scheme = 0; scheme < 2; ++scheme) {
    double largest = 0;
    for (const WeightedPoint& g : gradients[scheme]) {
      largest = std::max({largest, std::abs(g.x), std::abs(g.y), std::abs(g.w)});
    }
    const double steps[2] = {2e-5, 1e-5};
    double worst[2] = {0, 0};
    for (const VertexId v : mesh.vertices()) {
      for (int i = mesh.is_boundary(v) ? 2 : 0; i < 3; ++i) {
        for (int halved = 0; halved < 2; ++halved) {
          const auto moved = [&](double by) {
            Mesh other = mesh;
            WeightedPoint p = mesh.point(v);
            unknown(p, i) += by;
            other.set_point(v, p);
            return model->errors(other)[scheme];
          };
          const double h = steps[halved], difference = (moved(h) - moved(-h)) / (2 * h);
          worst[halved] = std::max(worst[halved], std::abs(difference - unknown(gradients[scheme][v], i)));
        }
      }
    }
    EXPECT_LT(worst[1], 1e-6 * largest);
    EXPECT_NEAR(worst[0] / worst[1], 4, 1) << worst[0] << " " << worst[1] << " of " << largest;
  }
}

// Smooth fields are sums of waves: a mesh that is better for many of these is for the fields of measure_errors().
TEST(SolverErrorModel, RanksRefinementAsMeasuredErrorsDo) {
  const Mesh coarse = well_centered_mesh(200), fine = well_centered_mesh(800);
  const auto model = *make_discretization_error(coarse);
  const std::vector<double> before = model->errors(coarse), after = model->errors(fine);
  ASSERT_EQ(before.size(), 2u);
  const OperatorErrors a = geometric_mean(measure_errors(coarse)->fields),
                       b = geometric_mean(measure_errors(fine)->fields);
  EXPECT_NEAR(std::sqrt(after[0] / before[0]) / (b.poisson.l2 / a.poisson.l2), 1, 0.35);
  EXPECT_NEAR(std::sqrt(after[1] / before[1]) / (b.flux.l2 / a.flux.l2), 1, 0.35);
}

TEST(SolverErrorModel, KnowsNoUnitAndNoPlace) {
  const Mesh mesh = well_centered_mesh(100);
  Mesh large = mesh;
  for (const VertexId v : mesh.vertices()) {
    const WeightedPoint p = mesh.point(v);
    large.set_point(v, {1024 * p.x - 500, 1024 * p.y + 300, 1024 * 1024 * p.w + 7});
  }
  const auto model = *make_discretization_error(mesh);
  const auto here = model->errors(mesh), there = model->errors(large);
  ASSERT_EQ(here.size(), there.size());
  for (std::size_t i = 0; i < here.size(); ++i) EXPECT_NEAR(there[i] / here[i], 1, 1e-6);
}

TEST(SolverErrorModel, IsTheSameForAnyThreads) {
  const Mesh mesh = well_centered_mesh(150);
  const auto model = *make_discretization_error(mesh);
  Gradients one, many;
  const auto alone = model->errors(mesh, one);
  ASSERT_EQ(alone, model->errors(mesh));
  for (const std::size_t threads : {2, 3, 8}) {
    StdThreads executor(threads);
    EXPECT_EQ(model->errors(mesh, many, &executor), alone);
    EXPECT_EQ(many, one);
  }
}

TEST(SolverErrorModel, HasNoErrorsWhereAMatrixIsNotDefinite) {
  Mesh mesh = well_centered_mesh(100);
  const auto model = *make_discretization_error(mesh);
  for (const VertexId v : mesh.vertices()) {
    if (v.index % 3 == 0) mesh.set_weight(v, mesh.weight(v) + 1);
  }
  EXPECT_TRUE(model->errors(mesh).empty());
}

TEST(SolverErrorModel, RefusesWhatItIsNotFor) {
  const Mesh mesh = well_centered_mesh(20);
  EXPECT_FALSE(make_discretization_error(mesh, {.scheme = Scheme::stars}));
  EXPECT_FALSE(make_discretization_error(mesh, {.fields = 0}));
  EXPECT_FALSE(make_discretization_error(*icosahedral({.level = 1})));
}

}  // namespace
}  // namespace temper::test
