// The members of a report that follow from the end of a run, for triangles and for tetrahedra.
#pragma once

#include <algorithm>
#include <cstddef>

#include "temper/optimize.hpp"

namespace temper {

/// The numbers of a mesh that a report compares.
struct ReportedNumbers {
  double objective = 0;
  std::size_t bad = 0;
};

/// A finished run: its input, its result, and numbers of vertices in both. `Mesh` has a function changes_from(input,
/// result, numbers).
template <class Mesh>
struct EndOfRun {
  const Mesh* input;  ///< null, unless Change::least: others may be in another order, or freed
  const Mesh& result;
  /// Number of each vertex of the result in the input, or one beyond for a new one; empty if all are equal.
  const IdVector<VertexId, VertexId>& numbers;
  std::size_t n_input_vertices = 0;
  Objective objective = Objective::energy;
  ReportedNumbers before, after;
};

/// Counts removed and inserted vertices. `numbers`: as in EndOfRun.
inline void count_vertices(RunReport& report, const IdVector<VertexId, VertexId>& numbers,
                           std::size_t n_input_vertices) {
  const auto is_old = [&](VertexId v) { return v.index < n_input_vertices; };
  const auto kept = static_cast<std::size_t>(std::ranges::count_if(numbers, is_old));
  report.vertices_removed = numbers.empty() ? 0 : n_input_vertices - kept;
  report.vertices_inserted = numbers.size() - kept;
}

/// Completes a report, except for what the run counts, and its notes.
template <class Mesh>
void complete(RunReport& report, const EndOfRun<Mesh>& end) {
  report.objective = end.objective;
  report.objective_before = end.before.objective;
  report.objective_after = end.after.objective;
  report.bad_before = end.before.bad;
  report.bad_after = end.after.bad;
  count_vertices(report, end.numbers, end.n_input_vertices);
  if (end.input != nullptr) report.changed = changes_from(*end.input, end.result, end.numbers);
}

}  // namespace temper
