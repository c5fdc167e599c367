// The model of errors: what it measures is what measure_errors() measures, its derivatives are those of differences,
// and it knows neither units nor the numbering of a mesh.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
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

/// The largest difference between derivatives of a model and differences with a step, relative to the largest.
double error_of_derivatives(const DiscretizationError& model, const Mesh& mesh, std::size_t scheme, double step) {
  Gradients gradients;
  EXPECT_EQ(model.errors(mesh, &gradients).size(), 2u);
  EXPECT_EQ(gradients.size(), 2u);
  double largest = 0, worst = 0;
  for (const WeightedPoint& g : gradients[scheme]) {
    largest = std::max({largest, std::abs(g.x), std::abs(g.y), std::abs(g.w)});
  }
  for (const VertexId v : mesh.vertices()) {
    for (int i = mesh.is_boundary(v) ? 2 : 0; i < 3; ++i) {
      const auto moved = [&](double by) {
        Mesh other = mesh;
        WeightedPoint p = mesh.point(v);
        unknown(p, i) += by;
        other.set_point(v, p);
        return model.errors(other)[scheme];
      };
      const double difference = (moved(step) - moved(-step)) / (2 * step);
      worst = std::max(worst, std::abs(difference - unknown(gradients[scheme][v], i)));
    }
  }
  return worst / largest;
}

TEST(SolverErrorModel, DerivativesAreThoseOfDifferencesAtSecondOrder) {
  const Mesh mesh = well_centered_mesh(60);
  const auto model = *make_discretization_error(mesh);
  for (const std::size_t scheme : {0u, 1u}) {
    const double whole = error_of_derivatives(*model, mesh, scheme, 2e-5),
                 half = error_of_derivatives(*model, mesh, scheme, 1e-5);
    EXPECT_LT(half, 1e-6);
    EXPECT_NEAR(whole / half, 4, 1) << whole << " " << half;
  }
}

/// Two coefficients, a source, a value of u on the left and a flux on the right.
DiffusionProblem two_conductivities(const Mesh& mesh) {
  DiffusionProblem problem;
  for (const TriangleId t : mesh.triangles()) {
    double x = 0;
    for (const VertexId v : mesh.corners(t)) x += mesh.position(v).x / 3;
    problem.coefficient.push_back(x < 0.5 ? 1 : 100);
  }
  for (const VertexId v : mesh.vertices()) problem.source.push_back(1 + mesh.position(v).x * mesh.position(v).y);
  problem.boundary = {{{}, 3, true}, {{}, 1, false}};
  for (const HalfedgeId h : mesh.halfedges()) {
    const VertexId a = mesh.origin(h), b = mesh.target(h);
    const double x = 0.5 * (mesh.position(a).x + mesh.position(b).x);
    if (mesh.is_boundary(h) && (x < 0.3 || x > 0.7)) problem.boundary[x < 0.3 ? 1 : 0].edges.push_back({a, b});
  }
  return problem;
}

// The reference has pieces, with kinks between them. At first each vertex is at a corner of some, so it is moved off.
TEST(ProblemErrorModel, DerivativesAreThoseOfDifferences) {
  Mesh mesh = well_centered_mesh(60);
  const DiffusionProblem problem = two_conductivities(mesh);
  const auto model = *make_discretization_error(mesh, {.problem = &problem});
  Rng rng(6);
  for (const VertexId v : mesh.vertices()) {
    const WeightedPoint p = mesh.point(v);
    if (!mesh.is_boundary(v)) mesh.set_point(v, {p.x + rng.uniform(1e-3, 3e-3), p.y - rng.uniform(1e-3, 3e-3), p.w});
  }
  for (const std::size_t scheme : {0u, 1u}) EXPECT_LT(error_of_derivatives(*model, mesh, scheme, 1e-5), 3e-8);
}

TEST(ProblemErrorModel, MeasuresAsErrorsOfAProblemAre) {
  const Mesh mesh = well_centered_mesh(150);
  const DiffusionProblem problem = two_conductivities(mesh);
  const std::vector<double> errors = (*make_discretization_error(mesh, {.problem = &problem}))->errors(mesh);
  const DiffusionErrors measured = *measure_diffusion_errors(mesh, problem, 2);
  ASSERT_EQ(errors.size(), 2u);
  EXPECT_NEAR(std::sqrt(errors[0]) / measured.vertex.l2, 1, 0.03);
  EXPECT_NEAR(std::sqrt(errors[1]) / measured.cell.l2, 1, 0.03);
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

TEST(SolverErrorModel, KnowsNoUnitNoPlaceAndNoNumbers) {
  const Mesh mesh = well_centered_mesh(100);
  Mesh large = hilbert_ordered(mesh).mesh;
  ASSERT_NE(large, mesh);
  for (const VertexId v : large.vertices()) {
    const WeightedPoint p = large.point(v);
    large.set_point(v, {1024 * p.x - 500, 1024 * p.y + 300, 1024 * 1024 * p.w + 7});
  }
  const DiffusionProblem problem = two_conductivities(mesh);
  for (const DiffusionProblem* given : {static_cast<const DiffusionProblem*>(nullptr), &problem}) {
    const auto model = *make_discretization_error(mesh, {.problem = given});
    const auto here = model->errors(mesh), there = model->errors(large);
    ASSERT_EQ(here.size(), 2u);
    ASSERT_EQ(there.size(), 2u);
    for (std::size_t i = 0; i < here.size(); ++i) EXPECT_NEAR(there[i] / here[i], 1, 1e-6);
  }
}

TEST(SolverErrorModel, IsTheSameForAnyThreads) {
  const Mesh mesh = well_centered_mesh(150);
  const auto model = *make_discretization_error(mesh);
  Gradients one, many;
  const auto alone = model->errors(mesh, &one);
  ASSERT_EQ(alone, model->errors(mesh));
  for (const std::size_t threads : {2, 3, 8}) {
    StdThreads executor(threads);
    EXPECT_EQ(model->errors(mesh, &many, &executor), alone);
    EXPECT_EQ(many, one);
  }
}

TEST(SolverErrorModel, KnowsNoRightAngle) {
  const Mesh mesh = well_centered_mesh(100);
  Mesh turned = mesh;
  for (const VertexId v : mesh.vertices()) {
    const WeightedPoint p = mesh.point(v);
    turned.set_point(v, {-p.y, p.x, p.w});
  }
  const auto model = *make_discretization_error(mesh);
  const auto here = model->errors(mesh), there = model->errors(turned);
  ASSERT_EQ(here.size(), 2u);
  for (std::size_t i = 0; i < here.size(); ++i) EXPECT_NEAR(there.at(i) / here[i], 1, 1e-9);
}

TEST(SolverErrorModel, RemembersNothingOfTheMeshesBefore) {
  const Mesh mesh = well_centered_mesh(100);
  const auto model = *make_discretization_error(mesh);
  const auto first = model->errors(mesh);
  EXPECT_EQ(model->errors(mesh), first);
  for (const Mesh& other : {well_centered_mesh(100, 4), well_centered_mesh(50)}) {
    EXPECT_EQ(model->errors(other), (*make_discretization_error(other))->errors(other));
  }
  EXPECT_EQ(model->errors(mesh), first);
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
  EXPECT_FALSE(make_discretization_error(*icosahedral({.level = 1})));
  DiffusionProblem zero = two_conductivities(mesh);
  zero.boundary[1].value = 0, zero.boundary[0].edges.clear(), zero.source.clear();
  const auto model = make_discretization_error(mesh, {.problem = &zero});
  ASSERT_FALSE(model);
  EXPECT_EQ(model.error().message,
            "the solution of the problem is 0 everywhere, and has no error. Next: give a source, or a boundary value "
            "other than 0");
}

}  // namespace
}  // namespace temper::test
