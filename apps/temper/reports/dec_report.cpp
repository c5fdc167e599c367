#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>

#include "console.hpp"
#include "reports/reports.hpp"

namespace temper::app {
namespace {

using Json = nlohmann::ordered_json;

Json finite_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

struct CellCounts {
  std::size_t empty = 0;    ///< outside of the domain
  std::size_t divided = 0;  ///< of several polygons
  double area = 0;
};

CellCounts count(const PowerCells& cells) {
  CellCounts counts;
  std::vector<std::size_t> polygons(cells.areas.size(), 0);
  for (const VertexId v : cells.vertices) ++polygons[v.index];
  for (const std::size_t n : polygons) {
    counts.empty += n == 0 ? 1 : 0;
    counts.divided += n > 1 ? 1 : 0;
  }
  for (const double area : cells.areas) counts.area += area;
  return counts;
}

struct ColumnCounts {
  std::size_t active = 0, pinched_out = 0, inactive = 0;
  std::size_t beside = 0, below = 0;  ///< connections
  std::vector<double> volumes;        ///< of layers
};

ColumnCounts count(const Columns& columns) {
  ColumnCounts counts;
  counts.volumes.resize(columns.n_layers, 0.0);
  for (std::size_t cell = 0; cell < columns.n_cells(); ++cell) {
    const CellState state = columns.states[cell];
    ++(state == CellState::active     ? counts.active
       : state == CellState::inactive ? counts.inactive
                                      : counts.pinched_out);
    counts.volumes[columns.layer(cell)] += columns.volumes[cell];
  }
  for (const ColumnConnection& c : columns.connections) ++(c.is_vertical ? counts.below : counts.beside);
  return counts;
}

double over_median(double largest, double median) { return largest > median && median > 0 ? largest / median : 1; }

std::string line(const std::string& label, const std::string& value) {
  constexpr std::size_t kNameColumns = 34, kValueColumns = 16;
  return pad_right(label, kNameColumns) + pad_left(value, kValueColumns) + "\n";
}
std::string line(const std::string& label, std::size_t value) { return line(label, fmt::format("{}", value)); }
std::string line(const std::string& label, double value) { return line(label, fmt::format("{:.9g}", value)); }

std::string columns_text(const Columns& columns) {
  const ColumnCounts c = count(columns);
  std::string text = line("cells in layers", columns.n_cells()) + line("  active", c.active) +
                     line("  pinched out", c.pinched_out) + line("  inactive", c.inactive);
  text += line("connections, horizontal", c.beside) + line("connections, vertical", c.below);
  for (std::size_t i = 0; i < c.volumes.size(); ++i)
    text += line(fmt::format("volume of layer {}", i + 1), c.volumes[i]);
  return text;
}

Json columns_json(const Columns& columns) {
  const ColumnCounts c = count(columns);
  Json json;
  json["layers"] = columns.n_layers;
  json["active"] = c.active;
  json["pinched_out"] = c.pinched_out;
  json["inactive"] = c.inactive;
  json["horizontal_connections"] = c.beside;
  json["vertical_connections"] = c.below;
  json["volumes"] = c.volumes;
  return json;
}

}  // namespace

std::string dec_text(const DecRecord& record) {
  const DecSummary& s = record.summary;
  const CellCounts cells = count(record.cells);
  std::string text = line("vertices", s.vertices) + line("edges", s.edges) +
                     line("  on the boundary", s.boundary_edges) + line("triangles", s.triangles) +
                     line("  not well-centered", s.not_well_centered);
  text += line("area of the domain", s.area) + line("sum of star0", s.star0_sum) +
          line("sum of the power cells' areas", cells.area);
  text += line("negative star0", s.negative_star0) + line("negative star1, interior edges", s.negative_star1) +
          line("negative star1, boundary edges", s.negative_boundary_star1) +
          line("zero star1, interior edges", s.zero_star1);
  text += line("least star0", s.min_star0) + line("least star1", s.min_star1) + line("median |star1|", s.median_star1) +
          line("largest |star1|", s.max_star1) + line("  over the median", over_median(s.max_star1, s.median_star1)) +
          line("largest |transmissibility|", s.max_transmissibility) +
          line("  over the median", over_median(s.max_transmissibility, s.median_transmissibility));
  text += line("polygons of power cells", record.cells.n_polygons()) + line("  cells of several", cells.divided) +
          line("  cells outside of the domain", cells.empty);
  if (record.columns != nullptr) text += columns_text(*record.columns);
  for (const std::string& file : record.files) text += "wrote " + file + "\n";
  return text;
}

std::string dec_json(const DecRecord& record) {
  const DecSummary& s = record.summary;
  const CellCounts cells = count(record.cells);
  Json json;
  json["schema"] = kSchema;
  json["vertices"] = s.vertices;
  json["edges"] = s.edges;
  json["boundary_edges"] = s.boundary_edges;
  json["triangles"] = s.triangles;
  json["not_well_centered"] = s.not_well_centered;
  json["area"] = s.area;
  json["star0_sum"] = s.star0_sum;
  json["cell_area_sum"] = cells.area;
  json["negative_star0"] = s.negative_star0;
  json["negative_star1"] = s.negative_star1;
  json["negative_boundary_star1"] = s.negative_boundary_star1;
  json["zero_star1"] = s.zero_star1;
  json["min_star0"] = s.min_star0;
  json["min_star1"] = s.min_star1;
  json["median_star1"] = s.median_star1;
  json["max_star1"] = s.max_star1;
  json["max_star1_over_median"] = finite_or_null(over_median(s.max_star1, s.median_star1));
  json["median_transmissibility"] = finite_or_null(s.median_transmissibility);
  json["max_transmissibility"] = finite_or_null(s.max_transmissibility);
  json["max_transmissibility_over_median"] =
      finite_or_null(over_median(s.max_transmissibility, s.median_transmissibility));
  json["cell_polygons"] = record.cells.n_polygons();
  json["divided_cells"] = cells.divided;
  json["empty_cells"] = cells.empty;
  if (record.columns != nullptr) json["columns"] = columns_json(*record.columns);
  json["files"] = record.files;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<std::string> dec_warnings(const DecRecord& record) {
  const DecSummary& s = record.summary;
  std::vector<std::string> warnings;
  if (s.not_well_centered > 0) {
    warnings.push_back(
        fmt::format("{}: {}: {} interior and {} boundary entries of star1 and {} of star0 "
                    "are negative. Next: temper optimize makes them positive",
                    record.path, well_centered(s.not_well_centered, s.triangles), s.negative_star1,
                    s.negative_boundary_star1, s.negative_star0));
  }
  const auto edges = [](std::size_t n) { return n == 1 ? "1 interior edge" : fmt::format("{} interior edges", n); };
  if (s.negative_star1 > 0) {
    warnings.push_back(fmt::format("{}: {} not regular: power cells there follow the mesh, not the power diagram",
                                   record.path, edges(s.negative_star1)));
  }
  if (s.zero_star1 > 0) {
    warnings.push_back(
        fmt::format("{}: {} with a dual edge of length zero: star1 is 0 there, and the two-point flux is infinite",
                    record.path, edges(s.zero_star1)));
  }
  return warnings;
}

}  // namespace temper::app
