// Sums and counts over all triangles of a mesh, for use after every sweep.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "base/engine.hpp"
#include "energy/star_kernels.hpp"
#include "temper/energy.hpp"

namespace temper {

/// Triangles for which is_bad() holds, exact.
[[nodiscard]] std::size_t count_bad(const Mesh& mesh, Executor* executor);

/// The number of bad triangles among the first n lanes.
[[nodiscard]] std::size_t count_bad(const Space& space, const TriangleLanes& triangles, std::size_t n);

struct EnergyAndBad {
  double energy = 0;
  std::size_t bad = 0;
};
/// The results of total_energy and count_bad, for the price of little more than one.
[[nodiscard]] EnergyAndBad energy_and_bad(const Mesh& mesh, const EnergyModel& model, const Engine& engine);

/// Computes the same numbers, to the bit, for a mesh that changes in few triangles at a time, by one model.
class RunningEnergyAndBad {
 public:
  /// `changed`: all triangles that have changed since the last measurement; without a list any may have changed.
  [[nodiscard]] EnergyAndBad measure(const Mesh& mesh, const EnergyModel& model,
                                     const std::optional<std::vector<TriangleId>>& changed, const Engine& engine);

 private:
  std::vector<double> of_blocks_;
};

/// total_energy() of each model, in one walk, since the walk costs more than the terms.
[[nodiscard]] std::vector<double> total_energies(const Mesh& mesh, std::span<const EnergyModel> models,
                                                 Executor* executor);

}  // namespace temper
