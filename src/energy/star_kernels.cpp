#include "energy/star_kernels.hpp"

#include "temper/instruction_set.hpp"

namespace temper {

const StarKernels& star_kernels() {
#ifdef TEMPER_X86_SETS
  switch (instruction_set()) {
    case InstructionSet::avx512:
      return avx512::kStarKernels;
    case InstructionSet::avx2:
      return avx2::kStarKernels;
    case InstructionSet::baseline:
      break;
  }
#endif
  return baseline::kStarKernels;
}

}  // namespace temper
