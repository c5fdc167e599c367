// The tables of reports on tetrahedra.
#include <algorithm>
#include <array>
#include <utility>

#include "dec/coefficient_rows.hpp"
#include "quality/measure_rows.hpp"
#include "report/run_rows.hpp"
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

const ReportTable& table_of(const EdgePlace*) {
  static const ReportTable table = report_table<EdgePlace>(
      "TetEdgePlace", "An edge of tetrahedra as a place.",
      {{"vertices", "Its vertices", "", &EdgePlace::vertices}, {"at", "Its midpoint", "", &EdgePlace::at}});
  return table;
}

const ReportTable& table_of(const FacePlace*) {
  static const ReportTable table = report_table<FacePlace>(
      "TetFacePlace", "A face of tetrahedra as a place.",
      {{"vertices", "Its vertices", "", &FacePlace::vertices}, {"at", "Its centroid", "", &FacePlace::at}});
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
        {"min_coefficient_place", "Edge with the least coefficient", "", &Quality::min_coefficient_place},
        {"min_distance_place", "Face with the least distance", "", &Quality::min_distance_place},
        {"histograms", "Histograms of dihedral angles and h/ℓ", "", &Quality::histograms, ShownIn::by_key},
        {"worst", "Worst tetrahedra, the worst first", "", &Quality::worst}};
    made.rows.insert(made.rows.end(), std::begin(more), std::end(more));
    return made;
  }();
  return table;
}

namespace {

const std::vector<VertexId>& no_vertices(const OptimizeReport&) {
  static const std::vector<VertexId> none;
  return none;
}
const IdVector<VertexId, VertexId>& vertices_of(const OptimizeReport& report) { return report.origins.vertices; }

/// Adds the rows that triangles alone have, without values: Python has one class for both.
void add_absent_rows(ReportTable& table) {
  for (ReportRow row : table_of(static_cast<const temper::OptimizeReport*>(nullptr)).rows) {
    if (std::ranges::find(table.rows, row.key, &ReportRow::key) != table.rows.end()) continue;
    row.type.optional = true;
    row.of = [](const void*) { return FieldValue(); };
    row.display = ShownIn::libraries;
    table.rows.push_back(std::move(row));
  }
}

}  // namespace

const ReportTable& table_of(const OptimizeReport*) {
  using R = OptimizeReport;
  constexpr ShownIn kLibraries = ShownIn::libraries;
  static const ReportTable table = [] {
    ReportTable made = run_table<R>(
        "TetOptimizeReport", kLibraries, {"hidden_vertices", "None", "", no_vertices, kLibraries},
        {{"vertices", "Number of each vertex in the input, −1 for inserted ones", "", vertices_of, kLibraries}});
    add_absent_rows(made);
    return made;
  }();
  return table;
}

const ReportTable& table_of(const DecSummary*) {
  using S = DecSummary;
  static const ReportTable table = [] {
    ReportTable made = report_table<S>(
        "TetDecSummary", "A summary of the operators of tetrahedra, for a check before a solver uses them.",
        {{"vertices", "Number of vertices", "", &S::vertices, "vertices"},
         {"edges", "Number of edges", "", &S::edges, "edges"},
         {"faces", "Number of faces", "", &S::faces, "faces"},
         {"boundary_faces", "Number of faces on the boundary", "", &S::boundary_faces, "  on the boundary"},
         {"tetrahedra", "Number of tetrahedra", "", &S::tetrahedra, "tetrahedra"},
         {"not_well_centered", "Number of tetrahedra that are not well-centered, exact", "", &S::not_well_centered,
          "  not well-centered"},
         {"volume", "Volume of the domain", "length³", &S::volume, "volume of the domain"},
         {"star0_sum", "Sum of ★0: the volume, except for rounding", "length³", &S::star0_sum, "sum of star0"},
         {"negative_star0", "Number of negative ★0", "", &S::negative_star0, "negative star0"},
         {"negative_star1", "Number of negative ★1", "", &S::negative_star1, "negative star1"},
         {"negative_star2", "Number of interior faces that are not regular, exact", "", &S::negative_star2,
          "negative star2, interior faces"},
         {"negative_boundary_star2", "Number of boundary faces with the orthocenter outside the domain, exact", "",
          &S::negative_boundary_star2, "negative star2, boundary faces"},
         {"zero_star2", "Number of interior faces that are cospherical, exact", "", &S::zero_star2,
          "zero star2, interior faces"},
         {"min_star0", "Least ★0", "", &S::min_star0, "least star0"},
         {"min_star1", "Least ★1", "", &S::min_star1, "least star1"},
         {"min_star2", "Least ★2", "", &S::min_star2, "least star2"}});
    add_coefficient_rows<S>(made);
    return made;
  }();
  return table;
}

}  // namespace temper::tets
