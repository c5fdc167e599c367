// The choice of the processor's instructions that energies are computed with. Results are the same for each, bit for
// bit.
#pragma once

#include <span>
#include <string_view>

namespace temper {

enum class InstructionSet {
  baseline,  ///< what every processor of the architecture has
  avx2,      ///< four doubles at a time
  avx512,    ///< eight
};
[[nodiscard]] std::string_view name(InstructionSet set);

/// The instruction sets that this build has code for, the slowest first.
[[nodiscard]] std::span<const InstructionSet> compiled_instruction_sets();
/// The instruction sets that this processor has and this build has code for, the slowest first.
[[nodiscard]] std::span<const InstructionSet> instruction_sets();
/// The one in use: at first the fastest.
[[nodiscard]] InstructionSet instruction_set();
/// Makes the whole process use this set for what starts from now on; meant for comparisons. False, and nothing changes,
/// where instruction_sets() does not have it.
bool use_instruction_set(InstructionSet set);

}  // namespace temper
