// Which instructions of the processor the energies are computed with. Results are the same, bit for bit, for each.
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

/// Those that this processor has, and this build has code for, the slowest first.
[[nodiscard]] std::span<const InstructionSet> instruction_sets();
/// The one in use: at first the fastest.
[[nodiscard]] InstructionSet instruction_set();
/// For comparisons: of the whole process, for what starts from now on. False, and nothing changes, where
/// instruction_sets() does not have it.
bool use_instruction_set(InstructionSet set);

}  // namespace temper
