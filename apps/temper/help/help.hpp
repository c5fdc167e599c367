// The help of the program and of each verb: as data, as the text of --help, as a manual page, and for completions of
// shells. All are made from the rows of Command. The text is plain ASCII and equal on every machine, because
// docs/reference/cli/ contains it word for word.
#pragma once

#include <string>
#include <vector>

#include "help/command.hpp"

namespace temper::app {

struct HelpPage {
  std::string verb;  ///< empty: the program itself
  std::string summary, description;
  std::string usage;  ///< what follows `temper VERB`
  std::vector<HelpPart> parts;
};

/// The forms of the help of a verb: the options of a first run, all options in groups, the switches of the paper.
enum class HelpForm { first, all, paper };
[[nodiscard]] HelpPage help_of(const Command& command, HelpForm form);
[[nodiscard]] HelpPage help_of_program();

/// What --help prints.
[[nodiscard]] std::string text_of(const HelpPage& page);
/// The text that `temper` alone prints.
[[nodiscard]] std::string short_help();
/// A manual page in the man macros of roff, as temper(1) or temper-optimize(1).
[[nodiscard]] std::string man_page(const HelpPage& page);

/// If the words request another form of help, `--help=FORMAT`, of the program or a verb, prints it and returns true.
/// Failure if there is no such form.
[[nodiscard]] bool print_other_help(const Arguments& words, const Command* verb = nullptr);
/// With the words of a command line after it: lists the possible values of the last word.
inline constexpr std::string_view kHelpWords = "--help=words";

}  // namespace temper::app
