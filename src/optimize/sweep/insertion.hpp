// New vertices in triangles with large energy: one of the "other criteria for discrete changes" of §7 of the paper.
#pragma once

#include "optimize/flips/flipper.hpp"
#include "optimize/options/settings.hpp"
#include "optimize/working/working_copy.hpp"

namespace temper {

/// Takes triangles whose own energy is above insertion_ratio times the mean, the largest energy first. Inserts a vertex
/// at the orthocenter, with the weight that the mesh has there. An insertion with its flips must improve the triangles
/// that it replaces, by removal_measure and removal_margin. Returns true after an insertion. Regular edges stay
/// regular.
[[nodiscard]] bool insert_where_energy_is_large(WorkingCopy& work, Flipper& flipper, const Settings& settings,
                                                const EnergyModel& model);

}  // namespace temper
