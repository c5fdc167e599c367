// The library's table of options as options of a verb: `max_sweeps` becomes --max-sweeps, as_is becomes as-is. Options
// that may have no value take "none".
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "options/options.hpp"
#include "temper/detail/optimize_table.hpp"

namespace temper::app {

/// The values of the table's options.
struct TableOptions {
  OptimizeOptions options;  ///< where none is given, these stay
  /// Options that name a vertex, as in the file: the vertex is found when the file has been read. "none": absent.
  std::map<std::string_view, std::string> vertices = {};
};

/// Adds one option. It shows no default, as the value in `target` need not be the option's own.
void add_option(Command& command, const OptionRow& row, TableOptions& target);
/// After parse.
[[nodiscard]] bool was_given(const Command& command, const OptionRow& row);

/// Adds the options of a group under its title.
void add_group(Command& command, const OptionGroup& group, TableOptions& target);
/// Flags that stand for a value of an option exclude other values of it. After parse.
void expect_no_contradictions(Command& command);

/// Options that were given, differ from `usual`, and have no effect: the command of a report gives defaults, too.
[[nodiscard]] std::vector<std::string> idle_options(const Command& command, const TableOptions& given,
                                                    const OptimizeOptions& usual);

/// A text of the library with the program's names of options.
[[nodiscard]] std::string spell_options(std::string_view text);
/// An error with the names of options as the program spells them.
[[nodiscard]] InputError spell_options(InputError error);

}  // namespace temper::app
