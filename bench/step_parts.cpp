#include "step_parts.hpp"

#include "base/instruction_set_choice.hpp"

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

const StepParts& step_parts() { return *TEMPER_IN_USE(kStepParts); }

}  // namespace bench
}  // namespace temper
