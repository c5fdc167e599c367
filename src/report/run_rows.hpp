// The rows that reports on runs of triangles and of tetrahedra share.
#pragma once

#include <initializer_list>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "temper/detail/report.hpp"
#include "temper/optimize.hpp"

namespace temper {

/// `objective_shown`: how the objective is shown. `hidden_vertices`, `more`: rows of one kind.
template <class R>
[[nodiscard]] ReportTable run_table(std::string_view name, const Display& objective_shown,
                                    const Field<R>& hidden_vertices, std::initializer_list<Field<R>> more) {
  ReportTable table = report_table<R>(
      name, "The result of ``optimize``.",
      {{"sweeps", "Number of sweeps", "", &R::sweeps},
       {"seconds", "Time of the optimization alone", "s", &R::seconds},
       {"stopped",
        "Reason for the end of the run. tangled: triangles are inverted and no flips can make the mesh regular. "
        "hidden: deferred flips hid a vertex against the policy, and the mesh is an earlier one. sweep_limit: all "
        "sweeps for the accuracy are done, a normal end",
        "", &R::stopped},
       {"objective", "Objective that the run lowered", "", &R::objective, objective_shown},
       {"objective_before", "Objective of the input, at the final γ", "", &R::objective_before, "objective before"},
       {"objective_after", "Objective of the result", "", &R::objective_after, "objective after"},
       {"vertices_removed", "Number of vertices of the input that were removed", "", &R::vertices_removed},
       hidden_vertices,
       {"vertices_inserted", "Number of new vertices", "", &R::vertices_inserted},
       {"flips", "Number of changes of connectivity without a new or removed vertex", "", &R::flips},
       {"bad_before", "Number of triangles or tetrahedra of the input that are not well-centered, before any flip", "",
        &R::bad_before, ShownIn::libraries},
       {"bad_after", "Number of these in the result", "", &R::bad_after, ShownIn::libraries}});
  table.rows.insert(table.rows.end(), more.begin(), more.end());
  const Field<R> last[] = {
      {"changed", "Changes of the run, with change = least", "", &R::changed, ShownIn::if_any},
      {"notes", "Notes for the user, in sentences", "",
       [](const R& r) {
         std::vector<TextWithOptions> notes;
         for (const std::string& note : r.notes) notes.push_back({note});
         return notes;
       }},
      {"history", "One record per sweep; history[0] is the input. Triangles are flipped to be regular before", "",
       &R::history, ShownIn::by_key}};
  table.rows.insert(table.rows.end(), std::begin(last), std::end(last));
  return table;
}

}  // namespace temper
