// Gradient and Hessian of every energy, star and treatment against central differences of the naive total
// energy: the error must fall with the square of the step, at unit scale, far from the origin, and at 1e±12.
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "support/lattice.hpp"
#include "unit/energy/naive.hpp"

namespace temper::test {
namespace {

struct Place {
  const char* name;
  double scale;
  Vec2 offset;
  double radius = 0;  ///< of a sphere

  friend void PrintTo(const Place& place, std::ostream* out) { *out << place.name; }
};

class Derivatives : public testing::TestWithParam<Place> {
 protected:
  /// Central differences with steps (step·s, step·s, step·s²).
  struct Differences {
    std::array<Real, 3> gradient;
    std::array<Real, 6> hessian;
  };

  static Differences differences(const Mesh& mesh, const EnergyModel& model, VertexId v, Real step, Real scale) {
    const std::array<Real, 3> h = {step * scale, step * scale, step * scale * scale};
    const auto at = [&](std::array<int, 3> k) {
      return naive_total(mesh, model, v, naive_step(mesh, v, k[0] * h[0], k[1] * h[1], k[2] * h[2]));
    };
    const auto unit = [](std::size_t i, int s) {
      std::array<int, 3> k = {0, 0, 0};
      k[i] += s;
      return k;
    };
    Differences d{};
    std::size_t entry = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      d.gradient[i] = (at(unit(i, 1)) - at(unit(i, -1))) / (2 * h[i]);
      for (std::size_t j = i; j < 3; ++j, ++entry) {
        if (i == j) {
          d.hessian[entry] = (at(unit(i, 1)) - 2 * at({0, 0, 0}) + at(unit(i, -1))) / (h[i] * h[i]);
          continue;
        }
        Real sum = 0;
        for (const int s : {-1, 1}) {
          for (const int t : {-1, 1}) {
            auto k = unit(i, s);
            k[j] += t;
            sum += s * t * at(k);
          }
        }
        d.hessian[entry] = sum / (4 * h[i] * h[j]);
      }
    }
    return d;
  }
};

// Errors in units of the size of the derivative times the scale of its variables.
struct Errors {
  Real gradient = 0, hessian = 0;
};

TEST_P(Derivatives, ConvergeWithOrderTwoToTheNaiveTwin) {
  const Place place = GetParam();
  const Mesh mesh = lattice({.scale = place.scale, .offset = place.offset, .radius = place.radius});
  const VertexId interior(12), boundary(2);
  ASSERT_FALSE(mesh.is_boundary(interior));
  ASSERT_TRUE(mesh.is_boundary(boundary));
  int cases = 0;
  for (const EnergyModel& model : all_models(place.scale)) {
    for (const VertexId v : {interior, boundary}) {
      const VertexDerivatives exact = vertex_energy(mesh, model, v);
      ASSERT_TRUE(exact.feasible);
      const Real s = place.scale;
      const std::array<Real, 3> unit = {s, s, s * s};
      Real size_g = 0, size_h = 0;  // the largest scaled entries
      const auto errors = [&](Real step) {
        const Differences d = differences(mesh, model, v, step, s);
        Errors e;
        std::size_t entry = 0;
        for (std::size_t i = 0; i < 3; ++i) {
          e.gradient = std::max(e.gradient, std::abs(d.gradient[i] - exact.gradient[i]) * unit[i]);
          size_g = std::max(size_g, std::abs(d.gradient[i]) * unit[i]);
          for (std::size_t j = i; j < 3; ++j, ++entry) {
            e.hessian = std::max(e.hessian, std::abs(d.hessian[entry] - exact.hessian[entry]) * unit[i] * unit[j]);
            size_h = std::max(size_h, std::abs(d.hessian[entry]) * unit[i] * unit[j]);
          }
        }
        return e;
      };
      const Errors coarse = errors(4e-3L), fine = errors(2e-3L);
      const std::string what = "energy " + std::string(energies()[static_cast<std::size_t>(model.kind)].name) +
                               " star " + std::to_string(static_cast<int>(model.star)) + " at " + place.name;
      ASSERT_GT(size_g, 0) << what;
      ASSERT_GT(size_h, 0) << what;
      // Where the differences are exact to rounding (polynomials of low degree) there is no order to see.
      constexpr Real kExact = 1e-9L;
      if (coarse.gradient > kExact * size_g) {
        EXPECT_NEAR(static_cast<double>(coarse.gradient / fine.gradient), 4.0, 0.3) << what << ", gradient";
      }
      if (coarse.hessian > kExact * size_h) {
        EXPECT_NEAR(static_cast<double>(coarse.hessian / fine.hessian), 4.0, 0.3) << what << ", Hessian";
      }
      EXPECT_LT(fine.gradient, 1e-3L * (size_g + size_h)) << what;
      EXPECT_LT(fine.hessian, 1e-3L * size_h) << what;
      ++cases;
    }
  }
  EXPECT_EQ(cases, 2 * static_cast<int>(all_models(1).size()));
}

INSTANTIATE_TEST_SUITE_P(Places, Derivatives,
                         testing::Values(Place{"unit", 1, {0, 0}}, Place{"far", 1, {1e6, -1e6}},
                                         Place{"small", 1e-12, {0, 0}}, Place{"large", 1e12, {0, 0}},
                                         Place{"small_sphere", 1, {0, 0}, 20}, Place{"large_sphere", 1, {0, 0}, 300},
                                         Place{"earth", 1e5, {0, 0}, 63.7122}),
                         [](const auto& place) { return place.param.name; });

class DerivativesOfAllVertices : public testing::TestWithParam<double> {};

TEST_P(DerivativesOfAllVertices, AreThoseOfTheTotalEnergyWhereHeightsAreNegative) {
  const Mesh mesh = lattice({.jitter = 0.45, .weight = 0.2, .seed = 3, .radius = GetParam()});
  int cases = 0, negative = 0;
  for (const VertexId v : mesh.vertices()) {
    for (const HalfedgeId h : mesh.star(v)) {
      const NaiveEdge e = naive_edge(mesh.space(), naive_point(mesh, mesh.origin(h)), naive_point(mesh, mesh.target(h)),
                                     naive_point(mesh, mesh.opposite(h)));
      negative += e.h_left < 0 ? 1 : 0;
    }
    for (const EnergyModel& model : all_models(1)) {
      const VertexDerivatives exact = vertex_energy(mesh, model, v);
      // On the sphere edges are shorter: of some far from v too the total is not in its domain.
      if (!exact.feasible || std::isnan(naive_total(mesh, model, v, naive_point(mesh, v)))) continue;
      constexpr Real kStep = 1e-5L;  // truncation 1e-10 of the third derivative, rounding 1e-14
      const auto at = [&](Real x, Real y, Real w) { return naive_total(mesh, model, v, naive_step(mesh, v, x, y, w)); };
      const std::array<Real, 3> difference = {(at(kStep, 0, 0) - at(-kStep, 0, 0)) / (2 * kStep),
                                              (at(0, kStep, 0) - at(0, -kStep, 0)) / (2 * kStep),
                                              (at(0, 0, kStep) - at(0, 0, -kStep)) / (2 * kStep)};
      for (std::size_t i = 0; i < 3; ++i) {
        const Real size = std::abs(exact.gradient[0]) + std::abs(exact.gradient[1]) + std::abs(exact.gradient[2]) + 1;
        EXPECT_NEAR(static_cast<double>(difference[i] / size), exact.gradient[i] / static_cast<double>(size), 1e-6);
      }
      ++cases;
    }
  }
  EXPECT_GT(cases, 300);
  EXPECT_GT(negative, 5);
}

INSTANTIATE_TEST_SUITE_P(Radii, DerivativesOfAllVertices, testing::Values(0, 40));

}  // namespace
}  // namespace temper::test
