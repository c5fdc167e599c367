// Options, words and values that are for some kinds of meshes alone.
#include <algorithm>
#include <string>
#include <vector>

#include "temper/detail/optimize_table.hpp"
#include "temper/detail/suggest.hpp"

namespace temper {
namespace {

using Names = std::vector<std::string_view>;

/// Refuses what is for `others`; `instead` lists what these cells have.
InputError for_others(const std::string& what, CellKinds others, CellKinds cells, const std::string& instead) {
  return {ErrorCode::invalid_option,
          {},
          what + " is for " + std::string(name(others)) + " alone. Next: leave it out; for " +
              std::string(name(cells)) + " there are " + instead};
}

/// Refuses a word that is for other cells. Other words are checked elsewhere.
Expected<void> check_word(const std::string& what, std::span<const Preset> presets, std::string_view word,
                          CellKinds cells) {
  const auto preset = std::ranges::find(presets, word, &Preset::name);
  if (preset == presets.end() || fits(preset->cells, cells)) return {};
  Names names;
  for (const Preset& each : presets) {
    if (fits(each.cells, cells)) names.push_back(each.name);
  }
  return for_others(what + " '" + std::string(word) + "'", preset->cells, cells, join(names));
}

std::string with_value(const OptionRow& row, const OptimizeOptions& options) {
  return "`" + std::string(row.name) + "=" + option_text(row, row.get(options)) + "`";
}

/// The choices that a row has for some cells. Empty: all.
Names choices_for(const OptionRow& row, CellKinds cells) {
  std::string_view names = cells == CellKinds::triangles    ? row.for_triangles
                           : cells == CellKinds::tetrahedra ? row.for_tetrahedra
                                                            : row.for_surfaces;
  Names allowed;
  for (; !names.empty(); names.remove_prefix(std::min(names.size(), allowed.back().size() + 1)))
    allowed.push_back(names.substr(0, names.find('|')));
  return allowed;
}

/// Refuses a choice that is for other cells.
Expected<void> check_choice(const OptionRow& row, const OptimizeOptions& options, CellKinds cells) {
  const std::string chosen = option_text(row, row.get(options));
  const auto has_it = [&](const Names& names) {
    return names.empty() || std::ranges::find(names, chosen) != names.end();
  };
  const Names allowed = choices_for(row, cells);
  if (has_it(allowed)) return {};
  auto others = CellKinds();
  for (const CellKinds kind : {CellKinds::triangles, CellKinds::tetrahedra, CellKinds::surfaces}) {
    if (fits(row.cells, kind) && has_it(choices_for(row, kind))) others = others | kind;
  }
  return for_others(with_value(row, options), others, cells, join(allowed));
}

/// The options for these cells, in back quotes, without the paper's switches.
std::string rows_for(CellKinds cells) {
  Names names;
  for (const OptionRow& row : option_rows()) {
    if (fits(row.cells, cells) && !row.research) names.push_back(row.name);
  }
  return "`" + join(names, "`, `") + "`";
}

}  // namespace

Expected<void> check_options(const OptimizeOptions& options, CellKinds cells) {
  for (const OptionRow& row : option_rows()) {
    if (!fits(row.cells, cells)) continue;
    if (auto right = check_option(row, row.get(options)); !right) return right;
    if (auto right = check_choice(row, options, cells); !right) return right;
  }
  return {};
}

Expected<void> check_cells(const OptimizeOptions& options, const GivenNames& given, CellKinds cells) {
  if (auto right = check_word("target", targets(), given.target, cells); !right) return right;
  for (const std::string_view part : given.keep) {
    if (auto right = check_word("keep", keeps(), part, cells); !right) return right;
  }
  for (const std::string_view name : given.options) {
    const OptionRow& row = *find_option(name);
    if (!fits(row.cells, cells) && row.get(options) != row.get({}))
      return for_others(with_value(row, options), row.cells, cells, rows_for(cells));
    if (!fits(row.cells, cells)) continue;
    if (auto right = check_choice(row, options, cells); !right) return right;
  }
  return {};
}

}  // namespace temper
