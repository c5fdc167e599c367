// The measures of other codes (temper/detail/solver_measures.hpp), for reports and for the judge of a run.
#pragma once

#include "geometry/flow_cell.hpp"
#include "temper/detail/executor.hpp"
#include "temper/detail/solver_measures.hpp"
#include "temper/mesh.hpp"

namespace temper {

/// Returns the cell of D-Flow FM that has triangle t: the triangle, or the quadrilateral of which it is half. Its
/// places are those next to a point.
[[nodiscard]] FlowCell flow_cell_of(const Mesh& mesh, TriangleId t, const WeightedPoint& near);

/// Two passes, over triangles and over vertices; if brief, one over the edges for the measures over the local size. All
/// executors give equal results. Triangles may be erased. O(n).
[[nodiscard]] SolverMeasures solver_measures(const Mesh& mesh, bool brief, Executor* executor);

}  // namespace temper
