// The measures of operators alone, for models that ask for them at each step.
#pragma once

#include "temper/dec.hpp"

namespace temper {

/// Returns dec_operators(mesh) without the incidence matrices d0 and d1. Precondition: the mesh is in a plane. O(n).
[[nodiscard]] DecComplex dec_measures(const Mesh& mesh);

}  // namespace temper
