#include "energy/star_kernels.hpp"

#include "base/instruction_set_choice.hpp"

namespace temper {

const StarKernels& star_kernels(const Space& space) {
  return space.is_plane() ? *TEMPER_IN_USE(kPlaneKernels) : *TEMPER_IN_USE(kSphereKernels);
}

}  // namespace temper
