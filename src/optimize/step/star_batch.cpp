#include "optimize/step/star_batch.hpp"

#include "base/instruction_set_choice.hpp"

namespace temper {

StepBatch step_batch() { return TEMPER_IN_USE(step_batch); }

}  // namespace temper
