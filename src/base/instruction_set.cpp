#include "temper/detail/instruction_set.hpp"

#include <algorithm>
#include <array>
#include <atomic>

#include "base/compiler.hpp"

namespace temper {
namespace {

constexpr std::array kSets = {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512};

#ifdef TEMPER_X86_SETS
constexpr std::size_t kCompiled = kSets.size();
#else
constexpr std::size_t kCompiled = 1;
#endif

std::size_t count_sets() {
#ifdef TEMPER_X86_SETS
  return !has_avx2() ? 1 : has_avx512() ? 3 : 2;
#else
  return kCompiled;
#endif
}

/// The only state that the library keeps: it changes speed, never results.
std::atomic<InstructionSet>& in_use() {
  static std::atomic<InstructionSet> set = instruction_sets().back();
  return set;
}

}  // namespace

std::string_view name(InstructionSet set) {
  constexpr std::array<std::string_view, kSets.size()> kNames = {"baseline", "avx2", "avx512"};
  return kNames[static_cast<std::size_t>(set)];
}

std::span<const InstructionSet> compiled_instruction_sets() { return std::span(kSets).first(kCompiled); }

std::span<const InstructionSet> instruction_sets() {
  static const std::size_t count = count_sets();
  return std::span(kSets).first(count);
}

InstructionSet instruction_set() { return in_use().load(std::memory_order_relaxed); }

bool use_instruction_set(InstructionSet set) {
  const auto sets = instruction_sets();
  if (std::find(sets.begin(), sets.end(), set) == sets.end()) return false;
  in_use().store(set, std::memory_order_relaxed);
  return true;
}

}  // namespace temper
