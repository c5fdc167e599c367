// Triangles with all corners free: their derivatives against those of each corner alone, which have been held against
// differences, and against differences where two corners meet.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>

#include "energy/star_kernels.hpp"
#include "support/lattice.hpp"
#include "temper/energy.hpp"
#include "temper/instruction_set.hpp"
#include "unit/energy/naive.hpp"

namespace temper::test {
namespace {

using Unknowns6 = std::array<double, 6>;

/// Triangles that are a little off equilateral and turned, one a lane: inside every barrier.
TriangleLanes some_triangles(double scale, std::uint64_t seed) {
  Noise noise(seed);
  TriangleLanes lanes;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const double turn = 3 * noise();
    const auto corner = [&](double angle) {
      constexpr double kJitter = 0.1;
      return WeightedPoint{scale * (std::cos(turn + angle) + kJitter * noise()),
                           scale * (std::sin(turn + angle) + kJitter * noise()), scale * scale * kJitter * noise()};
    };
    constexpr double kThird = 2.0943951023931953;
    lanes.p.set(lane, corner(0));
    lanes.q.set(lane, corner(kThird));
    lanes.r.set(lane, corner(2 * kThird));
  }
  return lanes;
}

std::vector<EnergyModel> barrier_models(double length) {
  std::vector<EnergyModel> models = all_models(length);
  std::erase_if(models, [](const EnergyModel& m) { return !energies()[static_cast<std::size_t>(m.kind)].barrier; });
  return models;
}

struct Evaluated {
  TriangleHessians numbers;
  unsigned inside = 0;
};

Evaluated evaluated(const EnergyModel& model, const TriangleLanes& lanes) {
  Evaluated e;
  e.inside = triangle_hessians()(edge_formula(model), lanes, e.numbers);
  return e;
}

double entry(const TriangleHessians& h, std::size_t lane, std::size_t i, std::size_t j) {
  return h.hessian[i < j ? hessian_entry(j, i) : hessian_entry(i, j)][lane];
}

/// Scales numbers in u to those of a unit triangle.
Unknowns6 units(double scale) { return {scale, scale, scale * scale, scale, scale, scale * scale}; }

TEST(TriangleHessians, HaveTheDerivativesOfEachCornerAlone) {
  int cases = 0;
  for (const double scale : {1.0, 1e-6, 1e6}) {
    const TriangleLanes lanes = some_triangles(scale, 3);
    const Unknowns6 unit = units(scale);
    for (const EnergyModel& model : barrier_models(scale)) {
      const auto [numbers, inside] = evaluated(model, lanes);
      ASSERT_EQ(inside, 0xffU);
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const std::array<WeightedPoint, 3> corner = {lanes.p.at(lane), lanes.q.at(lane), lanes.r.at(lane)};
        const std::vector<Vec2> points = {corner[0].position(), corner[1].position(), corner[2].position()};
        const std::vector<double> weights = {corner[0].w, corner[1].w, corner[2].w};
        const std::vector<std::array<std::int32_t, 3>> triangle = {{0, 1, 2}};
        const Mesh mesh = Mesh::build({.points = points, .weights = weights, .triangles = triangle})->mesh;
        EXPECT_NEAR(numbers.value[lane], triangle_energy(model, corner[0], corner[1], corner[2]),
                    1e-13 * numbers.value[lane]);
        EXPECT_GT(numbers.doubled_area[lane], 0);
        // Of corner c, rows of u count with these signs: p has both, turned.
        constexpr std::array<std::array<double, 2>, 3> kSigns = {{{-1, -1}, {1, 0}, {0, 1}}};
        for (std::size_t c = 0; c < 3; ++c) {
          const VertexDerivatives d = vertex_energy(mesh, model, VertexId(c));
          ASSERT_TRUE(d.feasible);
          for (std::size_t i = 0, k = 0; i < 3; ++i) {
            double gradient = 0;
            for (std::size_t a = 0; a < 2; ++a) gradient += kSigns[c][a] * numbers.gradient[3 * a + i][lane];
            const double size = 1 + std::abs(numbers.value[lane]);
            EXPECT_NEAR(unit[i] * gradient / size, unit[i] * d.gradient[i] / size, 1e-11);
            for (std::size_t j = i; j < 3; ++j, ++k) {
              double sum = 0, terms = numbers.value[lane];
              for (std::size_t a = 0; a < 2; ++a) {
                for (std::size_t b = 0; b < 2; ++b) {
                  const double h = kSigns[c][a] * kSigns[c][b] * entry(numbers, lane, 3 * a + i, 3 * b + j);
                  sum += h;
                  terms += unit[i] * unit[j] * std::abs(h);
                }
              }
              EXPECT_NEAR(unit[i] * unit[j] * sum / terms, unit[i] * unit[j] * d.hessian[k] / terms, 1e-11);
              ++cases;
            }
          }
        }
      }
    }
  }
  EXPECT_EQ(cases, 3 * static_cast<int>(barrier_models(1).size()) * 8 * 3 * 6);
}

/// q or r moved by h on axis i of u.
TriangleLanes moved(TriangleLanes lanes, std::size_t i, double h) {
  LanePoints& corner = i < 3 ? lanes.q : lanes.r;
  Lane& axis = i % 3 == 0 ? corner.x : i % 3 == 1 ? corner.y : corner.w;
  for (double& x : axis) x += h;
  return lanes;
}

TEST(TriangleHessians, AreWhatGradientsDifferBy) {
  const TriangleLanes lanes = some_triangles(1, 7);
  int cases = 0;
  for (const EnergyModel& model : barrier_models(1)) {
    const TriangleHessians exact = evaluated(model, lanes).numbers;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      double size = 0;
      for (const Lane& h : exact.hessian) size = std::max(size, std::abs(h[lane]));
      const auto error = [&](double step) {
        double most = 0;
        for (std::size_t i = 0; i < 6; ++i) {
          const TriangleHessians after = evaluated(model, moved(lanes, i, step)).numbers;
          const TriangleHessians before = evaluated(model, moved(lanes, i, -step)).numbers;
          for (std::size_t j = 0; j < 6; ++j) {
            const double difference = (after.gradient[j][lane] - before.gradient[j][lane]) / (2 * step);
            most = std::max(most, std::abs(difference - entry(exact, lane, i, j)));
          }
        }
        return most / size;
      };
      const double coarse = error(2e-4), fine = error(1e-4);
      EXPECT_LT(fine, 1e-3);
      EXPECT_NEAR(coarse / fine, 4, 0.2);  // order 2
      ++cases;
    }
  }
  EXPECT_EQ(cases, static_cast<int>(barrier_models(1).size()) * 8);
}

TEST(TriangleHessians, KnowWhichTrianglesAreOutsideTheBarrier) {
  TriangleLanes lanes = some_triangles(1, 9);
  lanes.p.w[2] = 100;                     // no edge at p is crossed
  std::swap(lanes.q.x[5], lanes.r.x[5]);  // the other way round
  std::swap(lanes.q.y[5], lanes.r.y[5]);
  for (EnergyModel model : barrier_models(1)) {
    model.wall = true;
    EXPECT_EQ(evaluated(model, lanes).inside, 0xffU & ~0x24U);
  }
}

TEST(TriangleHessians, AreTheSameBitsInEveryInstructionSet) {
  const InstructionSet used = instruction_set();
  for (const EnergyModel& model : barrier_models(1)) {
    const TriangleLanes lanes = some_triangles(1, 11);
    ASSERT_TRUE(use_instruction_set(instruction_sets().front()));
    const Evaluated first = evaluated(model, lanes);
    for (const InstructionSet set : instruction_sets()) {
      ASSERT_TRUE(use_instruction_set(set));
      const Evaluated other = evaluated(model, lanes);
      EXPECT_EQ(std::memcmp(&other.numbers, &first.numbers, sizeof first.numbers), 0) << name(set);
      EXPECT_EQ(other.inside, first.inside);
    }
  }
  use_instruction_set(used);
}

}  // namespace
}  // namespace temper::test
