#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "console.hpp"
#include "reports/json_of.hpp"
#include "reports/reports.hpp"

namespace temper::app {
namespace {

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
  std::size_t cells = 0, layers = 0;
  std::size_t active = 0, pinched_out = 0, inactive = 0;
  std::size_t beside = 0, below = 0;  ///< connections
  std::vector<double> volumes;        ///< of layers
};

ColumnCounts count(const Columns& columns) {
  ColumnCounts counts;
  counts.cells = columns.n_cells();
  counts.layers = columns.n_layers;
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

const ReportTable& table_of(const ColumnCounts*) {
  using C = ColumnCounts;
  static const ReportTable table = report_table<C>(
      "ColumnCounts", "Cells of the columns of --layers.",
      {{"cells", "Number of cells", "", &C::cells, {ShownIn::libraries, "cells in layers"}},
       {"layers", "Number of layers", "", &C::layers},
       {"active", "Number of active cells", "", &C::active, "  active"},
       {"pinched_out", "Number of cells without height", "", &C::pinched_out, "  pinched out"},
       {"inactive", "Number of inactive cells", "", &C::inactive, "  inactive"},
       {"horizontal_connections", "Number of connections between columns", "", &C::beside, "connections, horizontal"},
       {"vertical_connections", "Number of connections within columns", "", &C::below, "connections, vertical"},
       {"volumes", "Volume of each layer", "length³", &C::volumes}});
  return table;
}

std::optional<ColumnCounts> columns_of(const DecRecord& record) {
  return record.columns == nullptr ? std::nullopt : std::optional(count(*record.columns));
}

/// The record of a verb: what it has on the operators, between the version of the schema and the written files.
template <class Record>
ReportTable operators_table(std::string_view name, std::string_view sentence,
                            const std::vector<Field<Record>>& after_sum, const std::vector<Field<Record>>& last) {
  ReportTable table = {name, sentence, {Field<Record>("schema", "", "", [](const Record&) { return kSchema; })}};
  const auto summary = [](const Record& record) -> const auto& { return record.summary; };
  for (const ReportRow& row : rows_of_part<Record>(summary)) {
    table.rows.push_back(row);
    if (row.key == "star0_sum") table.rows.insert(table.rows.end(), after_sum.begin(), after_sum.end());
  }
  table.rows.insert(table.rows.end(), last.begin(), last.end());
  table.rows.push_back(Field<Record>("files", "Files that were written", "", &Record::files));
  return table;
}

std::string text_of(const std::vector<std::string>& files) {
  std::string text;
  for (const std::string& file : files) text += "wrote " + file + "\n";
  return text;
}

std::string columns_text(const ColumnCounts& columns) {
  std::string text = labeled_text(view_of(columns));
  for (std::size_t i = 0; i < columns.volumes.size(); ++i)
    text += text_line(fmt::format("volume of layer {}", i + 1), fmt::format("{:.9g}", columns.volumes[i]));
  return text;
}

}  // namespace

const ReportTable& table_of(const DecRecord*) {
  using R = DecRecord;
  static const ReportTable table =
      operators_table<R>("Operators", "temper operators IN -o FOLDER --json",
                         {{"cell_area_sum", "Sum of the power cells' areas", "length²",
                           [](const R& r) { return count(r.cells).area; }, "sum of the power cells' areas"}},
                         {{"cell_polygons", "Number of polygons of power cells", "",
                           [](const R& r) { return r.cells.n_polygons(); }, "polygons of power cells"},
                          {"divided_cells", "Number of cells with several polygons", "",
                           [](const R& r) { return count(r.cells).divided; }, "  cells of several"},
                          {"empty_cells", "Number of cells outside of the domain", "",
                           [](const R& r) { return count(r.cells).empty; }, "  cells outside of the domain"},
                          {"columns", "With --layers", "", columns_of, ShownIn::if_any}});
  return table;
}

const ReportTable& table_of(const TetDecRecord*) {
  static const ReportTable table =
      operators_table<TetDecRecord>("TetOperators", "temper operators IN -o FOLDER --json, of tetrahedra", {}, {});
  return table;
}

namespace {

/// Negative entries of one star.
struct StarSigns {
  std::string_view name;
  std::size_t entries = 0, negative = 0;
};
std::vector<StarSigns> signs_of(const DecSummary& s) {
  return {{"star0", s.vertices, s.negative_star0}, {"star1", s.edges, s.negative_star1 + s.negative_boundary_star1}};
}
std::vector<StarSigns> signs_of(const tets::DecSummary& s) {
  return {{"star0", s.vertices, s.negative_star0},
          {"star1", s.edges, s.negative_star1},
          {"star2", s.faces, s.negative_star2 + s.negative_boundary_star2}};
}
/// Exact zeros count as zero, also where rounding makes them positive.
double least(const DecSummary& s) {
  const double zero = s.zero_star1 > 0 ? 0 : kUnbounded;
  return std::min({s.min_star0, s.min_star1, zero});
}
double least(const tets::DecSummary& s) {
  const double zero = s.zero_star2 > 0 ? 0 : kUnbounded;
  return std::min({s.min_star0, s.min_star1, s.min_star2, zero});
}

/// The target whose solvers need the entries that are negative.
std::string_view target_for(const DecSummary& /*s*/) { return "vertex"; }
std::string_view target_for(const tets::DecSummary& s) {
  return s.negative_star0 + s.negative_star1 > 0 ? "vertex" : "cell";
}

/// How many coefficients are not positive, and what to do, with `end` between the two; empty if all are positive.
template <class Record>
std::string trouble_of(const Record& record, std::string_view end) {
  std::size_t entries = 0, negative = 0;
  std::string of_stars;
  for (const StarSigns& star : signs_of(record.summary)) {
    entries += star.entries;
    negative += star.negative;
    of_stars += fmt::format("{}{} of {}", of_stars.empty() ? "" : ", ", star.negative, star.name);
  }
  const double smallest = least(record.summary);
  if (negative == 0 && smallest > 0) return {};
  const std::string found = negative == 0 ? fmt::format("the least coefficient is {:.4g}", smallest)
                                          : fmt::format("{} of {} coefficients {} bad (negative): {}", negative,
                                                        entries, negative == 1 ? "is" : "are", of_stars);
  return fmt::format("{0}: {1}{2}Next: temper optimize IN -o OUT --for {3}, or temper explain IN --for {3}",
                     record.path, found, end, target_for(record.summary));
}

template <class Record>
std::string verdict_of(const Record& record) {
  const std::string trouble = trouble_of(record, "\n");
  return (trouble.empty() ? record.path + ": all coefficients are positive" : trouble) + "\n\n";
}

}  // namespace

std::string dec_trouble(const DecRecord& record) { return trouble_of(record, ". "); }
std::string dec_trouble(const TetDecRecord& record) { return trouble_of(record, ". "); }

std::string dec_text(const DecRecord& record) {
  const std::optional<ColumnCounts> columns = columns_of(record);
  return verdict_of(record) + labeled_text(view_of(record)) + (columns ? columns_text(*columns) : "") +
         text_of(record.files);
}

std::string dec_json(const DecRecord& record) { return dump(json_of(record)); }

std::string dec_text(const TetDecRecord& record) {
  return verdict_of(record) + labeled_text(view_of(record)) + text_of(record.files);
}

std::string dec_json(const TetDecRecord& record) { return dump(json_of(record)); }

std::vector<std::string> dec_warnings(const DecRecord& record) {
  const DecSummary& s = record.summary;
  std::vector<std::string> warnings;
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
  if (s.zero_star2 > 0) {
    warnings.push_back(
        fmt::format("{}: {} with a dual edge of length zero: star2 is 0 there, and the two-point flux is infinite",
                    record.path, plural(s.zero_star2, "interior face", "interior faces")));
  }
  return warnings;
}

}  // namespace temper::app
