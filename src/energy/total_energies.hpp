// Total energies of many models at once: the walk over a mesh costs more than the terms.
#pragma once

#include <span>
#include <vector>

#include "temper/energy.hpp"

namespace temper {

/// total_energy() of each model, in one walk.
[[nodiscard]] std::vector<double> total_energies(const Mesh& mesh, std::span<const EnergyModel> models,
                                                 Executor* executor);

}  // namespace temper
