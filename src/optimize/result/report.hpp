// The end of a run: the better of result and input goes back to the user, and the report says what came of it.
#pragma once

#include <optional>

#include "optimize/accuracy/accuracy_sizes.hpp"
#include "optimize/options/settings.hpp"
#include "optimize/run/judge.hpp"
#include "optimize/run/run.hpp"

namespace temper {

/// What the report compares with, as far as it depends on the input alone. It is measured before the sweeps: whoever
/// stops them need not wait for it, and Run::begin_sweeps() learns how long the like takes at the end.
struct InputMeasures {
  /// `sizes`: made too, for objectives other than an energy.
  InputMeasures(const Mesh& mesh, const Settings& settings, std::optional<AccuracySizes>& sizes);

  MeshScore counts;
  SizeReport size;
  std::optional<MeshScore> score;  ///< where the energies of a run do not enter into it
};

/// Puts the candidate into `mesh`, unless that is the better one, and completes the report of the run. `sizes`: of the
/// accuracy objective, else none.
void give_back(Mesh& mesh, Candidate best, const Settings& settings, const SweepState& state,
               const InputMeasures& of_input, std::optional<AccuracySizes> sizes, Run& run);

}  // namespace temper
