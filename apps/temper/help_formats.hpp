// Help in other forms than text: --help=man, and completions for shells. All are made from the same rows as --help.
#pragma once

#include <string>
#include <string_view>

#include "command.hpp"

namespace temper::app {

/// HelpFormat: `temper --help=NAME` prints program(), then verb() of each verb and end() where these belong to one
/// script; `temper VERB --help=NAME` prints verb().
struct HelpFormat {
  std::string_view name;
  std::string (*program)();
  std::string (*verb)(const Command& command);
  bool has_verbs = false;
  std::string (*end)() = nullptr;  ///< null: nothing follows
};

/// The row that the only word of a command line asks for, or null where it is another word. Failure: there is no such
/// row.
[[nodiscard]] const HelpFormat* asked_help_format(const Arguments& arguments);

}  // namespace temper::app
