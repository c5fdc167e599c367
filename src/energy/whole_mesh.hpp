// What is asked of all triangles after every sweep.
#pragma once

#include <cstddef>

#include "temper/energy.hpp"

namespace temper {

/// Triangles that are not well-centered, exact. Erased ones are not bad.
[[nodiscard]] std::size_t count_bad(const Mesh& mesh, Executor* executor);

struct EnergyAndBad {
  double energy = 0;
  std::size_t bad = 0;
};
/// total_energy() and count_bad(), for the price of little more than one.
[[nodiscard]] EnergyAndBad energy_and_bad(const Mesh& mesh, const EnergyModel& model, Executor* executor);

}  // namespace temper
