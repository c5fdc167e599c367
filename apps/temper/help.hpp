// The layout of --help: usage, options in groups with wrapped descriptions, examples, exit codes. Plain ASCII, and
// the same on every machine, because docs/cli.md holds it word for word.
#pragma once

#include <string>

#include "command.hpp"

namespace temper::app {

/// The help text of a verb.
[[nodiscard]] std::string help_text(const Command& command);

/// The texts that `temper --help` prints, and `temper` alone.
[[nodiscard]] std::string full_help();
[[nodiscard]] std::string short_help();

}  // namespace temper::app
