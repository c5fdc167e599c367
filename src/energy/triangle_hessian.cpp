#include "energy/triangle_hessian.hpp"

#include "base/instruction_set_choice.hpp"

namespace temper {

TriangleHessiansOf triangle_hessians() { return TEMPER_IN_USE(triangle_hessians); }

}  // namespace temper
