// The tables of reports on runs.
#include "temper/optimize.hpp"

#include "report/run_rows.hpp"
#include "temper/detail/report.hpp"

namespace temper {

const ReportTable& table_of(const SweepRecord*) {
  static const ReportTable table = report_table<SweepRecord>(
      "SweepRecord", "One sweep over all vertices.",
      {{"sweep", "Number of the sweep; 0 is the input", "", &SweepRecord::sweep},
       {"energy", "Value of the objective at the end of the sweep, at its γ", "", &SweepRecord::energy},
       {"bad", "Number of triangles or tetrahedra that are not well-centered", "", &SweepRecord::bad},
       {"flips", "Number of flips in this sweep", "", &SweepRecord::flips},
       {"length_parameter", "Value of γ or −h° in this sweep, relative to ℓ by default", "",
        &SweepRecord::length_parameter},
       {"seconds", "Time since the start of the optimization", "s", &SweepRecord::seconds},
       {"objective", "Objective that the sweep lowered", "", &SweepRecord::objective}});
  return table;
}

const ReportTable& table_of(const Progress*) {
  static const ReportTable table = report_table<Progress>(
      "Progress", "Progress of a run. Observers get it at least once per sweep, and more often on large meshes.",
      {{"last", "Last whole sweep", "", &Progress::last},
       {"fraction", "Fraction of the current sweep, in [0, 1)", "", &Progress::fraction},
       {"max_sweeps", "Largest number of sweeps", "", &Progress::max_sweeps},
       {"sweeps_left",
        "Estimate of the sweeps after the last one, while the energy converges. Absent in the first sweeps of a stage",
        "", &Progress::sweeps_left},
       {"n_vertices", "Number of vertices, while the run searches for a mesh with fewer", "", &Progress::n_vertices},
       {"share_of_phase",
        "Estimate of the share of the present phase that is done, in [0, 1]. Each objective of `last` is a phase, and "
        "its energy has another meaning than in the phase before",
        "", &Progress::share_of_phase},
       {"phase",
        "Phase of the mesher before an optimization, such as \"placing points\"; `fraction` is then the share of the "
        "phase that is done, as far as it is known. Empty in an optimization",
        "", &Progress::phase}});
  return table;
}

const ReportTable& table_of(const SizeChange*) {
  static const ReportTable table = report_table<SizeChange>(
      "SizeChange", "The change of the sizes: both meshes compared with the size field.",
      {{"before", "The input", "", &SizeChange::before}, {"after", "The result", "", &SizeChange::after}});
  return table;
}

const ReportTable& table_of(const ChangeCounts*) {
  using C = ChangeCounts;
  static const ReportTable table =
      report_table<C>("ChangeCounts", "Counts of the changes of a run, by the numbers of the input.",
                      {{"vertices_moved", "Vertices of the input at another place", "", &C::vertices_moved},
                       {"weights_changed", "Vertices of the input with another weight", "", &C::weights_changed},
                       {"edges_changed", "Edges of the result that the input does not have", "", &C::edges_changed}});
  return table;
}

const ReportTable& table_of(const OptimizeReport*) {
  using R = OptimizeReport;
  static const ReportTable table = run_table<R>(
      "OptimizeReport", "objective",
      {"hidden_vertices", "Vertices without a power cell that the option hidden = keep left", "", &R::hidden_vertices},
      {{"vertices",
        "Number of each vertex in the input; inserted vertices follow, with −1. Empty if none was removed or inserted",
        "", &R::vertices, ShownIn::libraries},
       {"size", "Change of the sizes; absent for tetrahedra", "", &R::size}});
  return table;
}

const ReportTable& table_of(const TraceEvent*) {
  static const ReportTable table = report_table<TraceEvent>(
      "TraceEvent",
      "An event of a run. Vertices are numbered as in the input, also after removals; new vertices get the next "
      "numbers. Coordinates and weights are in the user's units.",
      {{"kind", "Kind of the event", "", &TraceEvent::kind},
       {"sweep", "Sweep of the event; 0: the input is made regular and its boundary cut", "", &TraceEvent::sweep},
       {"vertex",
        "Vertex of the event; −1 for flip, and for undo of whole sweeps. For insertion and split, the new vertex", "",
        &TraceEvent::vertex},
       {"before",
        "Energy before the event, of the vertex's patch or of all edges that a flip changes; NaN if the event has none",
        "", &TraceEvent::before},
       {"after", "Energy after the event", "", &TraceEvent::after},
       {"point", "New x, y, w of the vertex for move, weight, insertion, split; on a sphere its weighted vector", "",
        &TraceEvent::point},
       {"quad",
        "For flip: edge a→b, with c on its left and d on its right, becomes d→c. For split: a→b was cut; d is −1 on "
        "the boundary",
        "", &TraceEvent::quad},
       {"link", "Neighbors, counter-clockwise, for collapse and removal; corners of the triangle for insertion", "",
        &TraceEvent::link},
       {"triangles", "New triangles of the cavity, in slot order, for collapse and removal", "",
        &TraceEvent::triangles},
       {"to_sweep", "For undo without a vertex: the sweep at whose end the mesh was the same; −1: the input as given",
        "", &TraceEvent::to_sweep}});
  return table;
}

}  // namespace temper
