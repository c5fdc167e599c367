// The tables of reports on meshes of triangles.
#include "temper/quality.hpp"

#include "quality/measure_rows.hpp"
#include "temper/detail/report.hpp"

namespace temper {

const ReportTable& table_of(const Histogram*) {
  static const ReportTable table = report_table<Histogram>(
      "Histogram",
      "Counts in equal bins over [low, high]. Each bin includes its lower end. Values outside go to the end bins.",
      {{"low", "", "", &Histogram::low}, {"high", "", "", &Histogram::high}, {"counts", "", "", &Histogram::counts}});
  return table;
}

const ReportTable& table_of(const Histograms*) {
  static const ReportTable table =
      report_table<Histograms>("Histograms", "Histograms of a mesh.",
                               {{"angles", "Angles of all triangles", "degrees", &Histograms::angles},
                                {"h_over_l", "h/ℓ of each triangle and edge", "", &Histograms::h_over_l},
                                {"d_over_l", "Lesser of d/ℓ and 1 − d/ℓ of each edge", "", &Histograms::d_over_l}});
  return table;
}

const ReportTable& table_of(const WorstTriangle*) {
  static const ReportTable table = report_table<WorstTriangle>(
      "WorstTriangle", "A triangle whose least h/ℓ or d/ℓ is among the smallest of the mesh.",
      {{"triangle", "Number of the triangle, from 0", "", &WorstTriangle::triangle},
       {"vertices", "Its vertices", "", &WorstTriangle::vertices},
       {"at", "Its centroid; on a sphere longitude and latitude [degrees]", "", &WorstTriangle::at},
       {"h_over_l", "Least h/ℓ of its three edges", "", &WorstTriangle::h_over_l},
       {"angle_deg", "Largest of its three angles", "degrees", &WorstTriangle::angle_deg},
       {"why", "The reason, such as \"orthocenter outside across edge 3-9: angle of 138.3° at vertex 10\"", "",
        [](const WorstTriangle& w) { return NumberedText{w.why}; }},
       {"z", "Third coordinate of the centroid, on a curved surface", "", &WorstTriangle::z, ShownIn::if_any}});
  return table;
}

const ReportTable& table_of(const EdgePlace*) {
  static const ReportTable table = report_table<EdgePlace>(
      "EdgePlace", "An edge as a place.",
      {{"vertices", "Its vertices", "", &EdgePlace::vertices},
       {"at", "Its midpoint; on a sphere longitude and latitude [degrees]", "", &EdgePlace::at},
       {"z", "Third coordinate of the midpoint, on a curved surface", "", &EdgePlace::z, ShownIn::if_any}});
  return table;
}

namespace {

/// A dictionary with an entry for each energy.
const ReportTable& table_of_energies() {
  static const ReportTable table = [] {
    ReportTable made = {"", "Each energy", {}};
    for (std::size_t i = 0; i < energies().size(); ++i) {
      const auto of = [i](const EnergiesByStar& e) -> const std::array<double, 3>& { return e[i]; };
      made.rows.push_back(Field<EnergiesByStar>(energies()[i].name, "", "", of));
    }
    return made;
  }();
  return table;
}

ReportRow energy_row() {
  const auto of = [](const void* report) -> FieldValue {
    const auto& energy = static_cast<const Quality*>(report)->energy;
    return {ReportView{&table_of_energies(), std::shared_ptr<const void>(std::shared_ptr<const void>(), &energy)}};
  };
  const FieldType type = {.kind = FieldType::Kind::record, .record = table_of_energies};
  return {"energy", "Total of each energy for ★0, ★1, ★2; infinite outside its domain", "", type, of};
}

}  // namespace

const ReportTable& table_of(const Quality*) {
  static const ReportTable table = [] {
    ReportTable made = {"Quality",
                        "The result of ``quality``: counts decided exactly, margins and energies in doubles. On a "
                        "sphere lengths and angles are measured along arcs.",
                        measure_rows(quality_measures())};
    made.rows.push_back(energy_row());
    const Field<Quality> more[] = {
        {"min_coefficient_place", "Edge with the least coefficient", "", &Quality::min_coefficient_place},
        {"histograms", "Histograms of angles, h/ℓ and d/ℓ", "", &Quality::histograms, ShownIn::by_key},
        {"worst", "Worst triangles, the worst first", "", &Quality::worst}};
    made.rows.insert(made.rows.end(), std::begin(more), std::end(more));
    return made;
  }();
  return table;
}

}  // namespace temper
