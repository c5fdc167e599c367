// The library's table of options as options of a verb: `max_sweeps` is --max-sweeps, as_is is as-is, and what
// may be none takes that word.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "options/options.hpp"
#include "temper/detail/optimize_table.hpp"

namespace temper::app {

/// What the options of the table are taken into.
struct TableOptions {
  OptimizeOptions options;  ///< where none is given, these stay
  /// Those that name a vertex, as in the file: it is looked up when that has been read. "none": absent.
  std::map<std::string_view, std::string> vertices = {};
};

/// Adds one option, without a default: the one of `target` is not its own.
void add_option(Command& command, const OptionRow& row, TableOptions& target);
/// After parse.
[[nodiscard]] bool was_given(const Command& command, const OptionRow& row);

/// Adds the options of a group under its title.
void add_group(Command& command, const OptionGroup& group, TableOptions& target);
/// Flags that stand for a value of an option may not be given beside another one. After parse.
void expect_no_contradictions(Command& command);

/// Options that were given, are not as in `usual`, and have no effect: the command of a report gives defaults, too.
[[nodiscard]] std::vector<std::string> idle_options(const Command& command, const TableOptions& given,
                                                    const OptimizeOptions& usual);

/// A text of the library with its options as they are called here.
[[nodiscard]] std::string spell_options(std::string_view text);
/// The same for an error.
[[nodiscard]] InputError spell_options(InputError error);

}  // namespace temper::app
