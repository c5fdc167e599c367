// The error of the vertex-centered scheme on tetrahedra: its gradient against differences, and its invariance.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>

#include "support/tet_lattice.hpp"
#include "temper/detail/lp.hpp"
#include "temper/tets/criterion.hpp"
#include "temper/tets/errors.hpp"
#include "temper/tets/optimize.hpp"
#include "temper/tets/quality.hpp"

namespace temper::tets {
namespace {

TetMesh lattice() { return test::mesh_of(test::shaken(test::body_centered(3), 0.1, 0.1)); }

TEST(TetSolverError, DifferencesConvergeToTheGradientWithOrderTwo) {
  const auto model = make_discretization_error(Scheme::vertex);
  ASSERT_NE(model, nullptr);
  TetMesh mesh = lattice();
  std::vector<DiscretizationError::Gradient> gradients;
  const std::vector<double> here = model->errors(mesh, &gradients);
  ASSERT_EQ(here.size(), 2U);  // of waves, and of fronts
  ASSERT_EQ(gradients.size(), 2U);
  EXPECT_EQ(model->errors(mesh), here);
  const auto on_boundary = boundary_vertices(mesh);
  for (std::size_t k = 0; k < 2; ++k) {
    ASSERT_TRUE(std::isfinite(here[k]));
    double coarse = 0, fine = 0, size = 0;
    for (const VertexId v : mesh.vertices()) {
      const WeightedPoint at = mesh.point(v);
      for (double WeightedPoint::*i : {&WeightedPoint::x, &WeightedPoint::y, &WeightedPoint::z, &WeightedPoint::w}) {
        if (on_boundary[v] != 0 && i != &WeightedPoint::w) continue;
        const auto difference = [&](double step) {
          WeightedPoint high = at, low = at;
          high.*i += step, low.*i -= step;
          mesh.set_point(v, high);
          const double above = model->errors(mesh).at(k);
          mesh.set_point(v, low);
          const double below = model->errors(mesh).at(k);
          mesh.set_point(v, at);
          return (above - below) / (2 * step);
        };
        coarse += std::abs(difference(0x1p-6) - gradients[k][v].*i);
        fine += std::abs(difference(0x1p-7) - gradients[k][v].*i);
        size += std::abs(gradients[k][v].*i);
      }
    }
    EXPECT_LT(coarse, 0.1 * size);
    EXPECT_LT(fine, 0.27 * coarse + 1e-10 * size);
  }
}

TEST(TetSolverError, ARunLowersItAndReturnsTheBestMesh) {
  TetMesh before = lattice();
  OptimizeOptions only_good;
  only_good.tets.accuracy_steps = 0;
  ASSERT_TRUE(optimize(before, only_good));
  TetMesh mesh = before, again = before;
  OptimizeOptions options;
  options.scheme = Scheme::vertex, options.tets.accuracy_steps = 5;
  OptimizeHooks hooks;
  hooks.solvers.error = make_discretization_error(Scheme::vertex);
  ASSERT_TRUE(optimize(mesh, options, hooks));
  EXPECT_LT(hooks.solvers.error->errors(mesh).at(0), 0.95 * hooks.solvers.error->errors(before).at(0));
  EXPECT_TRUE(meets(mesh, Criterion::coefficients));
  options.tets.accuracy_steps = 0;
  hooks.solvers.error = make_discretization_error(Scheme::vertex);
  ASSERT_TRUE(optimize(again, options, hooks));
  EXPECT_LE(hooks.solvers.error->errors(again).at(0), hooks.solvers.error->errors(before).at(0));
}

/// Cubes of side 1, each with 24 tetrahedra around its center, four at each side.
test::TetArrays cubes_of_24(int n) {
  test::TetArrays a;
  std::map<std::array<int, 3>, std::int32_t> number;  // by twice the place
  const auto point = [&](const std::array<int, 3>& p) {
    const auto [at, is_new] = number.emplace(p, static_cast<std::int32_t>(a.points.size()));
    if (is_new) a.points.push_back({0.5 * p[0], 0.5 * p[1], 0.5 * p[2]});
    return at->second;
  };
  for (int i = 0; i < n * n * n; ++i) {
    const std::array<int, 3> center = {2 * (i % n) + 1, 2 * (i / n % n) + 1, 2 * (i / n / n) + 1};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const int side : {-1, 1}) {
        std::array<int, 3> middle = center;
        middle[axis] += side;
        std::array<std::int32_t, 4> around = {};
        constexpr int kAround[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
        for (std::size_t k = 0; k < 4; ++k) {
          std::array<int, 3> p = middle;
          p[(axis + 1) % 3] += kAround[k][0], p[(axis + 2) % 3] += kAround[k][1];
          around[k] = point(p);
        }
        for (std::size_t k = 0; k < 4; ++k)
          a.tetrahedra.push_back({point(center), point(middle), around[k], around[(k + 1) % 4]});
      }
    }
  }
  test::make_positive(a);
  return a;
}

TEST(TetSolverError, VerticesStayWhereErrorsOfTheInputCancel) {
  OptimizeHooks hooks;
  hooks.solvers = {clp_solver, interior_point_solver, make_discretization_error(Scheme::vertex)};
  const TetMesh input = test::mesh_of(cubes_of_24(3));
  ASSERT_FALSE(violated_edges(input, nullptr).empty());
  TetMesh mesh = input;
  ASSERT_TRUE(optimize(mesh, {.scheme = Scheme::vertex}, hooks));
  EXPECT_TRUE(violated_edges(mesh, nullptr).empty());
  ASSERT_EQ(mesh.n_vertices(), input.n_vertices());
  for (const VertexId v : mesh.vertices()) EXPECT_EQ(mesh.position(v), input.position(v)) << v.index;
}

TEST(TetSolverError, NoSchemeReturnsALargerErrorThanThatOfAGoodInput) {
  const TetMesh input = test::mesh_of(test::shaken(test::body_centered(3), 0, 0));
  ASSERT_EQ(quality(input).orthocenters_outside, 0U);
  for (const Scheme scheme : {Scheme::vertex, Scheme::cell}) {
    TetMesh mesh = input;
    OptimizeOptions options;
    options.scheme = scheme, options.tets.accuracy_steps = 3;
    OptimizeHooks hooks;
    hooks.solvers.error = make_discretization_error(scheme);
    ASSERT_TRUE(optimize(mesh, options, hooks));
    EXPECT_LE(hooks.solvers.error->errors(mesh).at(0), hooks.solvers.error->errors(input).at(0));
  }
  EXPECT_EQ(make_discretization_error(Scheme::stars), nullptr);
}

}  // namespace
}  // namespace temper::tets
