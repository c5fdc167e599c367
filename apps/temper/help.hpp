// How --help looks: usage, options in groups with wrapped descriptions, examples, exit codes. Plain ASCII, and
// the same on every machine, because docs/cli.md holds it word for word.
#pragma once

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <initializer_list>
#include <string>

#include "exit.hpp"

namespace temper::app {

/// What --help says besides the options.
struct VerbHelp {
  std::string usage;     ///< what follows `temper VERB`
  std::string examples;  ///< lines "temper …"; comments start with #
  std::initializer_list<Exit> exits;
};
void set_help(CLI::App& app, const VerbHelp& help);

/// The help text of a verb.
[[nodiscard]] std::string help_text(const CLI::App& app);

/// What `temper --help` prints, and what `temper` alone prints.
[[nodiscard]] std::string full_help();
[[nodiscard]] std::string short_help();

}  // namespace temper::app
