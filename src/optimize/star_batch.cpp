#include "optimize/star_batch.hpp"

#include "temper/instruction_set.hpp"

namespace temper {

StepBatch step_batch() {
#ifdef TEMPER_X86_SETS
  switch (instruction_set()) {
    case InstructionSet::avx512:
      return avx512::step_batch;
    case InstructionSet::avx2:
      return avx2::step_batch;
    case InstructionSet::baseline:
      break;
  }
#endif
  return baseline::step_batch;
}

}  // namespace temper
