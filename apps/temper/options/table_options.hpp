// The library's table of options in the program: `--set NAME=VALUE` for all of them, and flags for the few that a first
// run may need. Names and values are those of C++ and Python.
#pragma once

#include <array>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "help/help.hpp"
#include "options/options.hpp"
#include "temper/detail/optimize_table.hpp"

namespace temper::app {

/// The flags that an options file may hold besides the options of the table. A report holds those that were given.
inline constexpr auto kFlagsOfARun =
    std::to_array<std::string_view>({"--for", "--effort", "--keep", "--fix", "--size", "--size-data", "--tensor",
                                     "--projection", "--point-data", "--cell-data"});

/// An option of the table, and the value that the user gave.
struct Assignment {
  const OptionRow* row;
  OptionValue value;
  std::string vertex = {};  ///< number of a vertex in the file, which is known when the file has been read
};

/// The assignments of a run in the order in which they count: later ones override earlier ones.
using Assignments = std::vector<Assignment>;

/// Returns the setting `name`, `text`. BadValue if there is no such option, or no such value of it.
[[nodiscard]] Assignment parse_assignment(std::string_view name, const std::string& text);

/// Adds --set. `names` are the options that it may set; none: all.
Option& add_set(Command& command, Assignments& target, std::span<const std::string_view> names = {});
/// Adds the flag of one option: --time-limit for time_limit.
Option& add_flag_of(Command& command, std::string_view name, Assignments& target);

/// The table as NAME=VALUE for the help of --set: the switches of the paper, or all other options.
[[nodiscard]] std::vector<HelpPart> help_parts(bool research);

/// Puts the assignments into options, except vertices.
void assign(const Assignments& assignments, OptimizeOptions& options);

/// Assignments that differ from `usual` and have no effect.
[[nodiscard]] std::vector<std::string> idle_assignments(const Assignments& assignments, const OptimizeOptions& options,
                                                        const OptimizeOptions& usual);

/// "star=0, repair=vertices": the options in which `a` differs from `b`.
[[nodiscard]] std::string differences(const OptimizeOptions& a, const OptimizeOptions& b);

/// A text of the library with the program's spelling of options: --boundary slide, --set star=0.
[[nodiscard]] std::string spell_options(std::string_view text);
/// An error with the names of options as the program spells them.
[[nodiscard]] InputError spell_options(InputError error);

}  // namespace temper::app
