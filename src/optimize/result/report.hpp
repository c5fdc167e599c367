// The end of a run: the better of result and input goes back to the user, with the report.
#pragma once

#include <optional>

#include "optimize/accuracy/accuracy_sizes.hpp"
#include "optimize/options/settings.hpp"
#include "optimize/run/judge.hpp"
#include "optimize/run/run.hpp"
#include "optimize/working/input_mesh.hpp"

namespace temper {

/// Measures of the input for the report's comparisons. They are made before the sweeps, so that a user who stops the
/// sweeps need not wait. Run::begin_sweeps() takes their time as an estimate of the time at the end.
struct InputMeasures {
  /// `sizes`: also computed, if the accuracy objective compares meshes.
  InputMeasures(InputMesh& input, const Settings& settings, std::optional<AccuracySizes>& sizes);

  MeshScore counts;
  SizeReport size;
  std::optional<MeshScore> score;  ///< if it does not depend on the run's energies
};

/// What a run has at its end, besides its best mesh.
struct RunEnd {
  const Settings& settings;
  const SweepState& state;
  const InputMeasures& of_input;
};

/// Completes the report of a run that has nothing to do.
void keep_input(InputMesh& input, const RunEnd& end, Run& run);
/// Puts the candidate in the place of the input, unless the input is better, and completes the report. `sizes`: the
/// accuracy objective's.
void give_back(InputMesh& input, Candidate best, const RunEnd& end, std::optional<AccuracySizes> sizes, Run& run);

}  // namespace temper
