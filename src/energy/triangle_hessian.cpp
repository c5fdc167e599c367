#include "energy/triangle_hessian.hpp"

#include "temper/instruction_set.hpp"

namespace temper {

TriangleHessiansOf triangle_hessians() {
#ifdef TEMPER_X86_SETS
  switch (instruction_set()) {
    case InstructionSet::avx512:
      return avx512::triangle_hessians;
    case InstructionSet::avx2:
      return avx2::triangle_hessians;
    case InstructionSet::baseline:
      break;
  }
#endif
  return baseline::triangle_hessians;
}

}  // namespace temper
