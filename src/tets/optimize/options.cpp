// Options for tetrahedra from the words and the table of options for triangles.
#include <algorithm>
#include <array>
#include <string>

#include "temper/detail/optimize_table.hpp"
#include "temper/detail/suggest.hpp"
#include "temper/tets/optimize.hpp"

namespace temper::tets {
namespace {

/// The rows of the table that have a meaning for tetrahedra. Others may only have their default.
constexpr auto kRows = std::to_array<std::string_view>({"max_sweeps", "time_limit", "unknowns", "boundary"});
constexpr auto kKept = std::to_array<std::string_view>({"positions", "weights", "edges", "boundary"});

/// The changes of connectivity that an effort tries. "quick" moves vertices alone.
struct Effort {
  std::string_view name;
  int repair_trials;
  double small_margin;
};
constexpr Effort kEfforts[] = {{"quick", 0, 0}, {"normal", OptimizeOptions().repair_trials, 0}, {"high", 40, 0.01}};

template <class Names>
bool has(const Names& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

InputError refused(const std::string& what, const std::string& instead) {
  return {ErrorCode::invalid_option,
          {},
          what + " is for triangles alone. Next: leave it out; for tetrahedra there are " + instead};
}

}  // namespace

Expected<OptimizeOptions> options_from(const temper::OptimizeOptions& table, const OptimizeWords& words) {
  for (const std::string_view part : words.keep) {
    if (!has(kKept, part)) return refused("keep '" + std::string(part) + "'", join(kKept));
  }
  for (const std::string_view name : words.rows) {
    const OptionRow& row = *find_option(name);
    if (has(kRows, name) || row.get(table) == row.get({})) continue;
    return refused("`" + std::string(name) + "=" + option_text(row, row.get(table)) + "`",
                   "`" + join(kRows, "`, `") + "`");
  }
  if (table.boundary == BoundaryVertices::slide) return refused("`boundary=slide`", "keep and split");
  OptimizeOptions options;
  options.split_boundary = table.boundary == BoundaryVertices::split;
  options.keep_positions = table.unknowns == Unknowns::weights;
  options.keep_weights = table.unknowns == Unknowns::positions;
  const Effort& effort = *std::ranges::find(kEfforts, words.effort, &Effort::name);
  options.repair_trials = effort.repair_trials;
  options.small_margin = effort.small_margin;
  options.keep_edges = table.flips == Flips::none || options.repair_trials == 0;
  options.max_sweeps = table.max_sweeps;
  options.time_limit = table.time_limit;
  return options;
}

}  // namespace temper::tets
