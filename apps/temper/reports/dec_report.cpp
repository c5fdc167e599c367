#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <variant>
#include <vector>

#include "console.hpp"
#include "reports/reports.hpp"

namespace temper::app {
namespace {

using Json = nlohmann::ordered_json;

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

/// A number of the report: its key in JSON, and its label in the text, empty if it is not there.
struct Row {
  const char* key;
  const char* label;
  std::variant<std::size_t, double> value;
};

/// Sizes of coefficients, of triangles or tetrahedra.
template <class Summary>
void add_coefficients(std::vector<Row>& rows, const Summary& s) {
  rows.insert(rows.end(), {{"median_star1", "median |star1|", s.median_star1},
                           {"max_star1", "largest |star1|", s.max_star1},
                           {"max_star1_over_median", "  over the median", over_median(s.max_star1, s.median_star1)},
                           {"median_transmissibility", "", s.median_transmissibility},
                           {"max_transmissibility", "largest |transmissibility|", s.max_transmissibility},
                           {"max_transmissibility_over_median", "  over the median",
                            over_median(s.max_transmissibility, s.median_transmissibility)}});
}

std::vector<Row> rows_of(const DecRecord& record) {
  const DecSummary& s = record.summary;
  const CellCounts cells = count(record.cells);
  std::vector<Row> rows = {{"vertices", "vertices", s.vertices},
                           {"edges", "edges", s.edges},
                           {"boundary_edges", "  on the boundary", s.boundary_edges},
                           {"triangles", "triangles", s.triangles},
                           {"not_well_centered", "  not well-centered", s.not_well_centered},
                           {"area", "area of the domain", s.area},
                           {"star0_sum", "sum of star0", s.star0_sum},
                           {"cell_area_sum", "sum of the power cells' areas", cells.area},
                           {"negative_star0", "negative star0", s.negative_star0},
                           {"negative_star1", "negative star1, interior edges", s.negative_star1},
                           {"negative_boundary_star1", "negative star1, boundary edges", s.negative_boundary_star1},
                           {"zero_star1", "zero star1, interior edges", s.zero_star1},
                           {"min_star0", "least star0", s.min_star0},
                           {"min_star1", "least star1", s.min_star1}};
  add_coefficients(rows, s);
  rows.insert(rows.end(), {{"cell_polygons", "polygons of power cells", record.cells.n_polygons()},
                           {"divided_cells", "  cells of several", cells.divided},
                           {"empty_cells", "  cells outside of the domain", cells.empty}});
  return rows;
}

std::vector<Row> rows_of(const TetDecRecord& record) {
  const tets::DecSummary& s = record.summary;
  std::vector<Row> rows = {{"vertices", "vertices", s.vertices},
                           {"edges", "edges", s.edges},
                           {"faces", "faces", s.faces},
                           {"boundary_faces", "  on the boundary", s.boundary_faces},
                           {"tetrahedra", "tetrahedra", s.tetrahedra},
                           {"not_well_centered", "  not well-centered", s.not_well_centered},
                           {"volume", "volume of the domain", s.volume},
                           {"star0_sum", "sum of star0", s.star0_sum},
                           {"negative_star0", "negative star0", s.negative_star0},
                           {"negative_star1", "negative star1", s.negative_star1},
                           {"negative_star2", "negative star2, interior faces", s.negative_star2},
                           {"negative_boundary_star2", "negative star2, boundary faces", s.negative_boundary_star2},
                           {"zero_star2", "zero star2, interior faces", s.zero_star2},
                           {"min_star0", "least star0", s.min_star0},
                           {"min_star1", "least star1", s.min_star1},
                           {"min_star2", "least star2", s.min_star2}};
  add_coefficients(rows, s);
  return rows;
}

std::string line(const std::string& label, const std::string& value) {
  constexpr std::size_t kNameColumns = 34, kValueColumns = 16;
  return pad_right(label, kNameColumns) + pad_left(value, kValueColumns) + "\n";
}
std::string line(const std::string& label, std::size_t value) { return line(label, fmt::format("{}", value)); }
std::string line(const std::string& label, double value) { return line(label, fmt::format("{:.9g}", value)); }

std::string text_of(const std::vector<Row>& rows) {
  std::string text;
  for (const Row& row : rows) {
    if (*row.label != '\0') std::visit([&](auto value) { text += line(row.label, value); }, row.value);
  }
  return text;
}

std::string text_of(const std::vector<std::string>& files) {
  std::string text;
  for (const std::string& file : files) text += "wrote " + file + "\n";
  return text;
}

Json json_of(const std::vector<Row>& rows) {
  Json json;
  json["schema"] = kSchema;
  for (const Row& row : rows) {
    if (const double* const number = std::get_if<double>(&row.value))
      json[row.key] = std::isfinite(*number) ? Json(*number) : Json(nullptr);
    else
      json[row.key] = std::get<std::size_t>(row.value);
  }
  return json;
}

std::string dec_dump(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

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
  return text_of(rows_of(record)) + (record.columns != nullptr ? columns_text(*record.columns) : "") +
         text_of(record.files);
}

std::string dec_json(const DecRecord& record) {
  Json json = json_of(rows_of(record));
  if (record.columns != nullptr) json["columns"] = columns_json(*record.columns);
  json["files"] = record.files;
  return dec_dump(json);
}

std::string dec_text(const TetDecRecord& record) { return text_of(rows_of(record)) + text_of(record.files); }

std::string dec_json(const TetDecRecord& record) {
  Json json = json_of(rows_of(record));
  json["files"] = record.files;
  return dec_dump(json);
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

std::vector<std::string> dec_warnings(const TetDecRecord& record) {
  const tets::DecSummary& s = record.summary;
  std::vector<std::string> warnings;
  if (s.not_well_centered > 0) {
    warnings.push_back(fmt::format(
        "{}: {} of {} tetrahedra are not well-centered: {} interior and {} boundary entries of star2, {} of "
        "star1 and {} of star0 are negative. Next: temper optimize makes them positive",
        record.path, s.not_well_centered, s.tetrahedra, s.negative_star2, s.negative_boundary_star2, s.negative_star1,
        s.negative_star0));
  }
  if (s.zero_star2 > 0) {
    warnings.push_back(
        fmt::format("{}: {} with a dual edge of length zero: star2 is 0 there, and the two-point flux is infinite",
                    record.path, plural(s.zero_star2, "interior face", "interior faces")));
  }
  return warnings;
}

}  // namespace temper::app
