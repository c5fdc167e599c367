// The price of a flip: what it changes of the total energy.
#include <gtest/gtest.h>

#include <cmath>

#include "energy/patch.hpp"
#include "support/lattice.hpp"
#include "temper/topology.hpp"
#include "unit/energy/naive.hpp"

namespace temper::test {
namespace {

TEST(FlipEnergy, DifferenceIsThatOfTheTotal) {
  const Mesh mesh = lattice({.jitter = 0.2, .weight = 0.1});
  int cases = 0;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (can_flip(mesh, h) != FlipStatus::possible) continue;
    for (const EnergyModel& model : all_models(1)) {
      Mesh flipped = mesh;
      const HalfedgeId after = flip(flipped, h);
      const double total0 = total_energy(mesh, model), total1 = total_energy(flipped, model);
      if (!std::isfinite(total0) || !std::isfinite(total1)) continue;
      EXPECT_NEAR(total1 - total0, flip_energy(flipped, model, after) - flip_energy(mesh, model, h),
                  1e-11 * (std::abs(total0) + std::abs(total1)));
      ++cases;
    }
  }
  EXPECT_GT(cases, 400);
}

}  // namespace
}  // namespace temper::test
