#include "optimize/batch/star_batch.hpp"

#include "base/instruction_set_choice.hpp"

namespace temper {

const BatchSteps& batch_steps(const Space& space) {
  return space.is_plane() ? *TEMPER_IN_USE(kPlaneSteps) : *TEMPER_IN_USE(kSphereSteps);
}

}  // namespace temper
