// The layout of --help: usage, options in groups with wrapped descriptions, examples, exit codes. Plain ASCII, and
// the same on every machine, because docs/cli.md holds it word for word.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "command.hpp"

namespace temper::app {

/// The help text of a verb, without its rare options; and with them, in groups.
[[nodiscard]] std::string help_text(const Command& command);
[[nodiscard]] std::string whole_help_text(const Command& command);

/// The sentence of an option, and its default.
[[nodiscard]] std::string described(const Option& option);
/// What an exit code says.
[[nodiscard]] std::string_view meaning(Exit exit);

/// The program itself, whose options come before a verb.
struct ProgramOption {
  std::string_view names, sentence;
};
[[nodiscard]] std::span<const ProgramOption> program_options();
[[nodiscard]] const VerbHelp& program_help();
inline constexpr std::string_view kProgramSummary = "primal-dual triangle meshes that solvers can trust";

/// The texts that `temper --help` prints, and `temper` alone.
[[nodiscard]] std::string full_help();
[[nodiscard]] std::string short_help();

}  // namespace temper::app
