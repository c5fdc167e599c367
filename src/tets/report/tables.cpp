// The tables of reports on tetrahedra.
#include <algorithm>
#include <array>
#include <optional>

#include "dec/coefficient_rows.hpp"
#include "quality/measure_rows.hpp"
#include "temper/detail/report.hpp"
#include "temper/tets/operators.hpp"
#include "temper/tets/optimize.hpp"
#include "temper/tets/quality.hpp"

namespace temper::tets {

const ReportTable& table_of(const Histograms*) {
  static const ReportTable table =
      report_table<Histograms>("TetHistograms", "Histograms of a mesh of tetrahedra.",
                               {{"dihedrals", "All dihedral angles", "degrees", &Histograms::dihedrals},
                                {"h_over_l", "h/ℓ of each tetrahedron and face", "", &Histograms::h_over_l}});
  return table;
}

const ReportTable& table_of(const WorstTet*) {
  static const ReportTable table = report_table<WorstTet>(
      "WorstTet", "A tetrahedron whose least h/ℓ is among the smallest of the mesh.",
      {{"tetrahedron", "Number of the tetrahedron, from 0", "", &WorstTet::tetrahedron},
       {"vertices", "Its vertices", "", &WorstTet::vertices},
       {"at", "Its centroid", "", &WorstTet::at},
       {"h_over_l", "Least h/ℓ of its four faces", "", &WorstTet::h_over_l},
       {"dihedral_deg", "Largest of its six dihedral angles", "degrees", &WorstTet::dihedral_deg},
       {"why", "The reason, such as \"orthocenter outside across face 3-9-12: h/ℓ = -0.2\"", "",
        [](const WorstTet& w) { return NumberedText{w.why}; }}});
  return table;
}

const ReportTable& table_of(const Quality*) {
  static const ReportTable table = [] {
    ReportTable made = {"TetQuality",
                        "The result of ``quality`` for tetrahedra: counts decided exactly, margins in doubles. The "
                        "length ℓ of a face is the side of the equilateral triangle with its area, the length ℓ of an "
                        "edge its own.",
                        measure_rows(quality_measures())};
    const Field<Quality> more[] = {
        {"histograms", "Histograms of dihedral angles and h/ℓ", "", &Quality::histograms, ShownIn::by_key},
        {"worst", "Worst tetrahedra, the worst first", "", &Quality::worst}};
    made.rows.insert(made.rows.end(), std::begin(more), std::end(more));
    return made;
  }();
  return table;
}

namespace {

const std::vector<VertexId> kNoVertices;

/// The mesh of tetrahedra is the best one of the history.
std::size_t least_bad(const OptimizeReport& report) {
  const auto fewer = [](const SweepRecord& a, const SweepRecord& b) { return a.bad < b.bad; };
  return std::min_element(report.history.begin(), report.history.end(), fewer)->bad;
}

}  // namespace

const ReportTable& table_of(const OptimizeReport*) {
  using R = OptimizeReport;
  static const ReportTable table = report_table<R>(
      "TetOptimizeReport", "The result of ``optimize``.",
      {{"sweeps", "Number of sweeps", "", &R::sweeps},
       {"seconds", "Time of the optimization alone", "s", &R::seconds},
       {"stopped", "Reason for the end of the run", "", &R::stopped},
       {"objective", "Objective that the run lowered", "",
        [](const R& r) -> const Objective& {
    return r.history.back().objective; }, ShownIn::libraries},
       {"objective_before", "Energy of the input at the least γ, or its HOT energy", "", &R::objective_before},
       {"objective_after", "The same of the result", "", &R::objective_after},
       {"vertices_removed", "Number of vertices of the input that were removed", "", &R::vertices_removed},
       {"hidden_vertices", "None", "", [](const R&) -> const std::vector<VertexId>& {
    return kNoVertices; },
        ShownIn::libraries},
       {"vertices_inserted", "Number of new vertices", "", &R::vertices_inserted},
       {"flips", "Changes of connectivity without a new or removed vertex", "", &R::flips},
       {"vertices", "Number of each vertex in the input, −1 for inserted ones", "",
        [](const R& r) -> const auto& { return r.origins.vertices;
}
, ShownIn::libraries
}  // namespace temper::tets
,
    {"bad_before", "Number of tetrahedra of the input that are not well-centered", "",
     [](const R& r) { return r.history.front().bad; }, ShownIn::libraries},
    {"bad_after", "The same number of the result", "", least_bad, ShownIn::libraries},
    {"size", "None", "", [](const R&) { return std::optional<SizeChange>(); }, ShownIn::libraries},
    {"notes", "None", "", [](const R&) { return std::vector<std::string>(); }, ShownIn::libraries}, {
  "history", "One record per sweep; history[0] is the input", "", &R::history, ShownIn::by_key
}
});
return table;
}

const ReportTable& table_of(const DecSummary*) {
  using S = DecSummary;
  static const ReportTable table = [] {
    ReportTable made = report_table<S>(
        "TetDecSummary", "A summary of the operators of tetrahedra, for a check before a solver uses them.",
        {{"vertices", "Number of vertices", "", &S::vertices, ShownIn::everywhere, "vertices"},
         {"edges", "Number of edges", "", &S::edges, ShownIn::everywhere, "edges"},
         {"faces", "Number of faces", "", &S::faces, ShownIn::everywhere, "faces"},
         {"boundary_faces", "Number of faces on the boundary", "", &S::boundary_faces, ShownIn::everywhere,
          "  on the boundary"},
         {"tetrahedra", "Number of tetrahedra", "", &S::tetrahedra, ShownIn::everywhere, "tetrahedra"},
         {"not_well_centered", "Number of tetrahedra that are not well-centered, exact", "", &S::not_well_centered,
          ShownIn::everywhere, "  not well-centered"},
         {"volume", "Volume of the domain", "length³", &S::volume, ShownIn::everywhere, "volume of the domain"},
         {"star0_sum", "Sum of ★0: the volume, except for rounding", "length³", &S::star0_sum, ShownIn::everywhere,
          "sum of star0"},
         {"negative_star0", "Number of negative ★0", "", &S::negative_star0, ShownIn::everywhere, "negative star0"},
         {"negative_star1", "Number of negative ★1", "", &S::negative_star1, ShownIn::everywhere, "negative star1"},
         {"negative_star2", "Number of interior faces that are not regular, exact", "", &S::negative_star2,
          ShownIn::everywhere, "negative star2, interior faces"},
         {"negative_boundary_star2", "Number of boundary faces with the orthocenter outside the domain, exact", "",
          &S::negative_boundary_star2, ShownIn::everywhere, "negative star2, boundary faces"},
         {"zero_star2", "Number of interior faces that are cospherical, exact", "", &S::zero_star2, ShownIn::everywhere,
          "zero star2, interior faces"},
         {"min_star0", "Least ★0", "", &S::min_star0, ShownIn::everywhere, "least star0"},
         {"min_star1", "Least ★1", "", &S::min_star1, ShownIn::everywhere, "least star1"},
         {"min_star2", "Least ★2", "", &S::min_star2, ShownIn::everywhere, "least star2"}});
    add_coefficient_rows<S>(made);
    return made;
  }();
  return table;
}

}  // namespace temper::tets
