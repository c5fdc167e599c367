// The measures of other codes (temper/detail/solver_measures.hpp), for reports and for the judge of a run.
#pragma once

#include "temper/detail/executor.hpp"
#include "temper/detail/solver_measures.hpp"
#include "temper/mesh.hpp"

namespace temper {

/// Two passes, over triangles and over vertices; if brief, one over the edges for the measures over the local size. All
/// executors give equal results. Triangles may be erased. O(n).
[[nodiscard]] SolverMeasures solver_measures(const Mesh& mesh, bool brief, Executor* executor);

}  // namespace temper
