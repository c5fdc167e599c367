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
constexpr auto kTargets = std::to_array<std::string_view>({"any", "valid", "vertex", "cell"});
constexpr auto kKept = std::to_array<std::string_view>({"positions", "weights", "edges", "boundary"});

/// The work of an effort. "quick" keeps the connectivity, and looks at no solver's error.
struct Effort {
  std::string_view name;
  int repair_trials;
  bool search_each;
  double small_margin;
  int accuracy_steps;
  std::size_t most_error_vertices;
};
constexpr OptimizeOptions kNormal;
constexpr Effort kEfforts[] = {{"quick", 0, false, 0, 30, 0},
                               {"normal", kNormal.repair_trials, kNormal.search_each, kNormal.small_margin,
                                kNormal.accuracy_steps, kNormal.most_error_vertices},
                               {"high", 40, true, 0.01, 1000, 100'000}};

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
  const auto* effort = std::ranges::find(kEfforts, words.effort, &Effort::name);
  if (effort == std::end(kEfforts))
    return InputError{ErrorCode::invalid_option, {}, "effort: expected quick, normal or high"};
  if (!has(kTargets, words.target)) return refused("target '" + std::string(words.target) + "'", join(kTargets));
  for (const std::string_view part : words.keep) {
    if (!has(kKept, part)) return refused("keep '" + std::string(part) + "'", join(kKept));
  }
  for (const std::string_view name : words.rows) {
    const OptionRow& row = *find_option(name);
    if (has(kRows, name) || row.get(table) == row.get({})) continue;
    return refused("`" + std::string(name) + "=" + option_text(row, row.get(table)) + "`",
                   "`" + join(kRows, "`, `") + "`");
  }
  OptimizeOptions options;
  options.slide_boundary = table.boundary == BoundaryVertices::slide;
  options.split_boundary = table.boundary == BoundaryVertices::split;
  options.keep_positions = table.unknowns == temper::Unknowns::weights;
  options.keep_weights = table.unknowns == temper::Unknowns::positions;
  options.repair_trials = effort->repair_trials;
  options.search_each = effort->search_each;
  options.small_margin = effort->small_margin;
  options.accuracy_steps = effort->accuracy_steps;
  options.most_error_vertices = effort->most_error_vertices;
  options.scheme = table.scheme;
  options.keep_edges = table.flips == Flips::none || options.repair_trials == 0;
  if (options.split_boundary && (options.keep_positions || options.keep_weights || options.keep_edges))
    return InputError{
        ErrorCode::invalid_option,
        {},
        "`boundary=split` inserts vertices, which keep=positions, weights or edges and effort=quick forbid. "
        "Next: leave one of them out"};
  options.max_sweeps = table.max_sweeps;
  options.time_limit = table.time_limit;
  return options;
}

}  // namespace temper::tets
