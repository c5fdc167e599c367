// Estimates of the sweeps that a run still needs.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "optimize/run/run.hpp"
#include "temper/generate.hpp"

namespace temper::test {
namespace {

/// Energies 1 + q^k at one γ.
std::vector<SweepRecord> geometric(double q, int sweeps) {
  std::vector<SweepRecord> history;
  for (int k = 0; k <= sweeps; ++k) {
    SweepRecord record;
    record.sweep = k;
    record.energy = 1 + std::pow(q, k);
    history.push_back(record);
  }
  return history;
}

TEST(Estimate, IsExactWhereGainsAreAGeometricSeries) {
  OptimizeOptions o{.objective = Objective::energy};
  for (const double q : {0.3, 0.7, 0.95}) {
    const std::vector<SweepRecord> history = geometric(q, 10);
    const double energy = history.back().energy;
    // The gain of sweep k is q^(k−1) − q^k.
    const double last = 1 + std::log(o.paper.tolerance * energy / (1 - q)) / std::log(q);
    const auto left = estimate_sweeps_left(history, o);
    ASSERT_TRUE(left);
    EXPECT_NEAR(*left, std::max(0.0, last - 10), 1e-6) << q;
    o.max_sweeps = 12;
    EXPECT_LE(*estimate_sweeps_left(history, o), 2);
    o.max_sweeps = 1000;
  }
}

TEST(Estimate, IsNoneWhereItCannotBeTold) {
  const OptimizeOptions o;
  const std::vector<SweepRecord> good = geometric(0.5, 6);
  ASSERT_TRUE(estimate_sweeps_left(good, o));
  std::vector<SweepRecord> rising = good, staged = good;
  rising.back().energy = 2;
  staged[4].length_parameter = 0.1;
  OptimizeOptions paper = o;
  paper.paper.stopping = StoppingRule::paper;
  EXPECT_FALSE(estimate_sweeps_left(std::span(good).first(4), o));
  EXPECT_FALSE(estimate_sweeps_left(rising, o));
  EXPECT_FALSE(estimate_sweeps_left(staged, o));
  EXPECT_FALSE(estimate_sweeps_left(good, paper));
  EXPECT_FALSE(estimate_sweeps_left(geometric(1, 6), o));
}

TEST(Estimate, TheShareOfAPhaseCountsItsSweeps) {
  OptimizeOptions o;
  o.accuracy.sweeps = 8;
  std::vector<SweepRecord> history = {{.sweep = 0, .energy = 9}, {.sweep = 5, .energy = 1}};
  EXPECT_FALSE(share_of_phase(history, o, 0)) << "no estimate yet";
  history.push_back({.sweep = 5, .energy = 40, .objective = Objective::accuracy});  // another energy, which is larger
  EXPECT_EQ(share_of_phase(history, o, 0), 0);
  EXPECT_EQ(share_of_phase(history, o, 0.5), 0.5 / 8);
  history.push_back({.sweep = 9, .energy = 30, .objective = Objective::accuracy});
  EXPECT_EQ(share_of_phase(history, o, 0), 0.5);
  o.max_sweeps = 10;  // of the run: 5 are left for the phase
  EXPECT_EQ(share_of_phase(history, o, 0), 0.8);

  const std::vector<SweepRecord> good = geometric(0.5, 6);
  const double left = std::max(1.0, *estimate_sweeps_left(good, o) - o.accuracy.sweeps);
  EXPECT_EQ(share_of_phase(good, o, 0), 6 / (6 + left));
}

TEST(Estimate, OfARunIsNearItsEnd) {
  RandomMesh points;
  points.vertices = 2000;
  const Mesh mesh = *random_mesh(points);
  std::vector<std::pair<int, double>> estimates;
  OptimizeHooks hooks;
  hooks.observer = [&](const Progress& p) {
    const bool first_stage = p.last.objective == Objective::energy;  // the next ends by its number of sweeps
    if (first_stage && p.sweeps_left && p.fraction == 0) estimates.emplace_back(p.last.sweep, *p.sweeps_left);
    return Continue::yes;
  };
  for (const Objective objective : {Objective::energy, Objective::accuracy}) {
    estimates.clear();
    Mesh improved = mesh;
    const auto report = optimize(improved, {.objective = objective}, hooks);
    ASSERT_TRUE(report);
    ASSERT_FALSE(estimates.empty());
    int end_of_stage = 0;
    for (const SweepRecord& r : report->history) {
      if (r.objective == Objective::energy) end_of_stage = r.sweep;
    }
    // Gains of sweeps shrink more and more slowly: early estimates are too small, and none is too large.
    int near_the_end = 0;
    for (const auto& [sweep, left] : estimates) {
      EXPECT_LT(sweep + left, report->sweeps + 10) << sweep;
      if (3 * sweep <= 2 * end_of_stage) continue;
      EXPECT_NEAR(sweep + left, report->sweeps, 10) << sweep;
      ++near_the_end;
    }
    EXPECT_GT(near_the_end, 0);
  }
}

}  // namespace
}  // namespace temper::test
