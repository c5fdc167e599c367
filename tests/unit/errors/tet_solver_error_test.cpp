// The error of the vertex-centered scheme on tetrahedra: its gradient against differences, and its invariance.
#include <gtest/gtest.h>

#include <cmath>

#include "support/tet_lattice.hpp"
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
