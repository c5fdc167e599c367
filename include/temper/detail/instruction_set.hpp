// The choice of the processor's instructions for energies. All give the same results, bit for bit.
#pragma once

#include <span>
#include <string_view>

namespace temper {

enum class InstructionSet {
  baseline,  ///< Instructions of every processor of the architecture
  avx2,      ///< Four doubles at a time
  avx512,    ///< Eight doubles at a time
};
[[nodiscard]] std::string_view name(InstructionSet set);

/// The instruction sets for which this build has code, the slowest first.
[[nodiscard]] std::span<const InstructionSet> compiled_instruction_sets();
/// The instruction sets of this processor for which this build has code, the slowest first.
[[nodiscard]] std::span<const InstructionSet> instruction_sets();
/// The instruction set in use: at first the fastest.
[[nodiscard]] InstructionSet instruction_set();
/// Sets the instruction set of the whole process for later calls; meant for comparisons. Returns false and changes
/// nothing if instruction_sets() does not have it.
bool use_instruction_set(InstructionSet set);

}  // namespace temper
