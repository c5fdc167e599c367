// The tables of reports on curved surfaces: those of triangles, without what surfaces do not have.
#include <algorithm>

#include "report/run_rows.hpp"
#include "temper/detail/report.hpp"
#include "temper/surfaces.hpp"

namespace temper::surfaces {
namespace {

/// Says whether temper::quality_measures() has the key, and surfaces do not measure it. Energies are not measured, too.
bool is_unmeasured(std::string_view key) {
  const auto has = [key](std::span<const QualityMeasure> rows) {
    return std::ranges::find(rows, key, &QualityMeasure::key) != rows.end();
  };
  return key == "energy" || (has(temper::quality_measures()) && !has(quality_measures()));
}

const std::vector<VertexId>& no_vertices(const SurfaceReport&) {
  static const std::vector<VertexId> none;
  return none;
}

}  // namespace

const ReportTable& table_of(const Quality*) {
  static const ReportTable table = [] {
    ReportTable made = table_of(static_cast<const temper::Quality*>(nullptr));
    made.name = "SurfaceQuality";
    made.sentence = "The quality of a curved surface: counts decided exactly, margins in doubles.";
    std::erase_if(made.rows, [](const ReportRow& row) { return is_unmeasured(row.key); });
    // Rows of triangles take a temper::Quality.
    for (ReportRow& row : made.rows) {
      row.of = [of = std::move(row.of)](const void* report) {
        return of(static_cast<const temper::Quality*>(static_cast<const Quality*>(report)));
      };
    }
    return made;
  }();
  return table;
}

const ReportTable& table_of(const Explanation*) {
  using E = Explanation;
  static const ReportTable table =
      report_table<E>("SurfaceExplanation", "The bad triangles of a curved surface, and what weights alone can do.",
                      {{"triangles", "Number of triangles", "", &E::triangles},
                       {"bad", "Number of triangles that are not well-centered, exact", "", &E::bad},
                       {"verdict", "Verdict on weights of the whole mesh, if nothing else changes", "", &E::verdict},
                       {"changed", "Number of weights that change, if the verdict is feasible", "", &E::changed},
                       {"margin", "Best margin of weights, or a bound of it", "", &E::margin},
                       {"certificate", "Proof that there are no weights; null: there is none", "", &E::certificate},
                       {"worst", "Worst bad triangles with their reasons, the worst first", "", &E::worst}});
  return table;
}

const ReportTable& table_of(const SurfaceReport*) {
  using R = SurfaceReport;
  constexpr ShownIn kLibraries = ShownIn::libraries;
  static const ReportTable table = run_table<R>(
      "SurfaceOptimizeReport", kLibraries, {"hidden_vertices", "None", "", no_vertices, kLibraries},
      {{"vertices", "Number of each vertex in the input, −1 for inserted ones", "", &R::vertices, kLibraries},
       {"surface_distance", "Bound of the distance between all points of input and result, both ways", "length",
        &R::surface_distance, "distance from the input"},
       {"diagonal", "Diagonal of the bounding box of the input", "length", &R::diagonal, "  diagonal of the input"},
       {"repairs", "Number of edits next to bad triangles", "", &R::repairs, "edits next to bad triangles"},
       {"crease_edges", "Number of edges of creases, which stay", "", &R::crease_edges, "edges of creases"},
       {"sharp_edges_before", "Number of edges that turn more than crease_angle, in the input", "",
        [](const R& r) { return r.turns_before.sharp; }, "edges that turn more than creases, before"},
       {"sharp_edges_after", "Number of these edges in the result", "", [](const R& r) { return r.turns_after.sharp; },
        "  after"},
       {"max_turn_before_deg", "Largest angle between normals of neighbors, in the input", "degrees",
        [](const R& r) { return r.turns_before.largest_deg; }, "largest turn, before"},
       {"max_turn_after_deg", "Largest of these angles in the result", "degrees",
        [](const R& r) { return r.turns_after.largest_deg; }, "  after"}});
  return table;
}

}  // namespace temper::surfaces
