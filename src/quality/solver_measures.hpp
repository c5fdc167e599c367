// What the codes that run on meshes look at, each number as the code itself computes it.
#pragma once

#include "temper/quality.hpp"

namespace temper {

/// Two passes, over triangles and over vertices. The same for any executor. Precondition: no erased triangles. O(n).
[[nodiscard]] SolverMeasures solver_measures(const Mesh& mesh, Executor* executor);

}  // namespace temper
