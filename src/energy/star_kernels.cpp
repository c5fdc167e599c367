#include "energy/star_kernels.hpp"

#include "base/instruction_set_choice.hpp"

namespace temper {

const StarKernels& star_kernels() { return *TEMPER_IN_USE(kStarKernels); }

}  // namespace temper
