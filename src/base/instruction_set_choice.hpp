// A pointer to the function of the instruction set in use: all sets have one of this name in their namespaces.
#pragma once

#include "temper/detail/instruction_set.hpp"

namespace temper {

template <class T>
[[nodiscard]] T* of_instruction_set(T* baseline, T* avx2, T* avx512) {
  switch (instruction_set()) {
    case InstructionSet::avx512:
      return avx512;
    case InstructionSet::avx2:
      return avx2;
    case InstructionSet::baseline:
      break;
  }
  return baseline;
}

}  // namespace temper

// A macro, since a processor of another architecture has the baseline alone.
#ifdef TEMPER_X86_SETS
#define TEMPER_IN_USE(name) \
  temper::of_instruction_set(&temper::baseline::name, &temper::avx2::name, &temper::avx512::name)
#else
#define TEMPER_IN_USE(name) (&temper::baseline::name)
#endif
