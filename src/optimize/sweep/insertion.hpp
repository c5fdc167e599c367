// New vertices where the energy is large: one of the "other criteria for discrete changes" of §7 of the paper.
#pragma once

#include "optimize/flips/flipper.hpp"
#include "optimize/options/settings.hpp"
#include "optimize/working/working_copy.hpp"

namespace temper {

/// Goes through the triangles whose own energy is above insertion_ratio times the mean, the largest first, and inserts
/// a vertex at the orthocenter, with the weight that the mesh has there, where insertion and flips make what is
/// replaced better by removal_measure and removal_margin. True when there are new vertices; edges are as regular as
/// before.
[[nodiscard]] bool insert_where_energy_is_large(WorkingCopy& work, Flipper& flipper, const Settings& settings,
                                                const EnergyModel& model);

}  // namespace temper
