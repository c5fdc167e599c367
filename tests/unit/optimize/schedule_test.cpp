// γ and h° only shrink, and reach an end.
#include "optimize/run/schedule.hpp"

#include <gtest/gtest.h>

#include "support/lattice.hpp"

namespace temper::test {
namespace {

EnergyInfo row(std::string_view name) { return *find_energy(name); }

std::span<const Restart> restarts_of(std::string_view energy, OptimizeOptions options, const Mesh& mesh) {
  options.energy = row(energy).kind;
  return restarts(*make_settings(options, mesh, WorkingUnits::of(mesh)), mesh);
}

TEST(Schedule, ShrinksGammaToItsFloorInEveryRestart) {
  const Mesh bad = lattice({.jitter = 0.45, .weight = 0});
  const auto planned = restarts_of("BP", {}, bad);
  ASSERT_GE(planned.size(), 2u);
  for (const Restart& restart : planned) {
    GammaSchedule gamma_schedule(restart, row("BP"), Policy());
    EnergyModel model;
    gamma_schedule.start(bad, model);
    EXPECT_EQ(model.gamma, (LengthParameter{restart.start, LengthScale::relative}));
    double last = model.gamma.value;
    int sweeps = 0;
    while (!gamma_schedule.settled() && sweeps < 10000) {
      gamma_schedule.advance(bad, 1, 1, model);
      EXPECT_LE(model.gamma.value, last);
      last = model.gamma.value;
      ++sweeps;
    }
    EXPECT_TRUE(gamma_schedule.settled());
    EXPECT_FALSE(gamma_schedule.advance(bad, 1, 1, model));
    EXPECT_DOUBLE_EQ(last, 0.003);
  }
}

TEST(Schedule, IsAtTheFloorAsSoonAsNothingIsBad) {
  const Mesh bad = lattice({.jitter = 0.45, .weight = 0});
  GammaSchedule gamma_schedule(restarts_of("BP", {}, bad)[0], row("BP"), Policy());
  EnergyModel model;
  gamma_schedule.start(bad, model);
  EXPECT_TRUE(gamma_schedule.advance(bad, 1, 1, model));
  EXPECT_FALSE(gamma_schedule.settled());
  EXPECT_TRUE(gamma_schedule.advance(bad, 1, 0, model));
  EXPECT_TRUE(gamma_schedule.settled());
  EXPECT_DOUBLE_EQ(model.gamma.value, 0.003);
  EXPECT_EQ(gamma_schedule.relaxation(), kRelaxation);
}

TEST(Schedule, OfAWellCenteredMeshIsHardFromTheStart) {
  const Mesh good = lattice({.jitter = 0.01, .weight = 0});
  EXPECT_EQ(restarts_of("BP", {}, good).size(), 1u);
  EXPECT_EQ(restarts_of("BP", {}, good)[0].start, 0.003);
}

TEST(Schedule, LeavesTheUsersGammaAlone) {
  const Mesh bad = lattice({.jitter = 0.45, .weight = 0});
  OptimizeOptions options;
  options.paper.gamma = LengthParameter{0.25, LengthScale::absolute};
  const auto planned = restarts_of("BP", options, bad);
  ASSERT_EQ(planned.size(), 1u);
  GammaSchedule gamma_schedule(planned[0], row("BP"), Policy(options));
  EnergyModel model;
  model.gamma = *options.paper.gamma;
  gamma_schedule.start(bad, model);
  EXPECT_TRUE(gamma_schedule.settled());
  EXPECT_EQ(model.gamma, *options.paper.gamma);
}

TEST(Schedule, KeepsTheShiftedBarrierFinite) {
  const Mesh bad = lattice({.jitter = 0.3, .weight = 0, .seed = 2});
  GammaSchedule gamma_schedule(restarts_of("BHs", {}, bad)[0], row("BHs"), Policy());
  EnergyModel model;
  model.kind = EnergyKind::BHs;
  gamma_schedule.start(bad, model);
  EXPECT_TRUE(std::isfinite(total_energy(bad, model)));
  for (int i = 0; i < 5; ++i) {
    gamma_schedule.advance(bad, 1, 1, model);
    EXPECT_TRUE(std::isfinite(total_energy(bad, model)));
  }
}

}  // namespace
}  // namespace temper::test
