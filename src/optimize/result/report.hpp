// The end of a run: the better of result and input goes back to the user, and the report says what came of it.
#pragma once

#include <optional>

#include "optimize/accuracy/accuracy_sizes.hpp"
#include "optimize/run/judge.hpp"
#include "optimize/run/run.hpp"
#include "optimize/options/settings.hpp"

namespace temper {

/// What the report compares with, as far as it depends on the input alone. It is measured before the sweeps: whoever
/// stops them need not wait for it, and Run::begin_sweeps() learns how long the like takes at the end.
struct InputMeasures {
  Counts counts;
  SizeReport size;
  std::optional<MeshScore> score;  ///< where the energies of a run do not enter into it
};
/// All but the score. `near`: of the mesh.
[[nodiscard]] InputMeasures measure_input(const Mesh& mesh, const NearbyCopy& near, const Settings& settings);
/// The score by the accuracy objective.
[[nodiscard]] MeshScore score_input(const NearbyCopy& near, const Counts& counts, const Settings& settings,
                              const AccuracySizes& sizes);

/// Puts the candidate into `mesh`, unless that is the better one, and completes the report of the run. `sizes`: of the
/// accuracy objective, else none.
void give_back(Mesh& mesh, Candidate best, const Settings& settings, const SweepState& state,
               const InputMeasures& of_input, std::optional<AccuracySizes> sizes, Run& run);

}  // namespace temper
