// The end of a run: the better of result and input goes back to the user, and the report says what came of it.
#pragma once

#include "optimize/accuracy/accuracy_sizes.hpp"
#include "optimize/run.hpp"
#include "optimize/settings.hpp"

namespace temper {

/// A mesh that a run has come to, and the sweep whose mesh it is.
struct Candidate {
  WorkingCopy work;
  int sweep = 0;
};
void visit(Archive& archive, Candidate& candidate);

/// Puts the candidate into `mesh`, unless that is the better one, and completes the report of the run. `sizes`: of the
/// accuracy objective, else null.
void give_back(Mesh& mesh, Candidate best, Settings settings, const AccuracySizes* sizes, Run& run);

}  // namespace temper
