#include "step_parts.hpp"

#include "temper/instruction_set.hpp"

namespace temper {

namespace baseline {
extern const bench::StepParts kStepParts;
}
namespace avx2 {
extern const bench::StepParts kStepParts;
}
namespace avx512 {
extern const bench::StepParts kStepParts;
}

namespace bench {

const StepParts& step_parts() {
#ifdef TEMPER_X86_SETS
  switch (instruction_set()) {
    case InstructionSet::avx512:
      return avx512::kStepParts;
    case InstructionSet::avx2:
      return avx2::kStepParts;
    case InstructionSet::baseline:
      break;
  }
#endif
  return baseline::kStepParts;
}

}  // namespace bench
}  // namespace temper
