#include "optimize/step/star_batch.hpp"

#include "base/instruction_set_choice.hpp"

namespace temper {

const BatchSteps& batch_steps() { return *TEMPER_IN_USE(kBatchSteps); }

}  // namespace temper
