// The command line of a verb as data: its arguments, their help and, once parsed, their values.
//
// An option is a row. options.hpp makes rows of the usual kinds. Code with a table of options loops over it:
//
//   for (const Row& row : kRows) {
//     command.add({.names = row.name,
//                  .value_name = "X",
//                  .sentence = row.sentence,
//                  .take = [&](const std::string& text) { row.set(settings, to_number(text, row.range)); },
//                  .spell = [&] { return row.text(settings); }});
//   }
//
// The parser is in command.cpp alone: its headers take longer to compile than everything else here.
#pragma once

#include <deque>
#include <functional>
#include <list>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "exit.hpp"
#include "temper/detail/cell_kinds.hpp"
#include "verbs.hpp"

namespace temper::app {

/// BadValue: the reason why the text of an option is no value of it. The message of the user starts with the option's
/// name.
struct BadValue : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The number of values that an option takes.
enum class Values {
  one,       ///< `--gamma 1`, and only once
  repeated,  ///< `--require a --require b`
  words,     ///< `--fix a b c`: all words that follow, up to the next option
};

/// Option: one option of a verb, or an argument that is known by its place.
struct Option {
  std::string names;       ///< "-o,--output", the long one last; without dashes ("IN"): an argument by place
  std::string value_name;  ///< "X", "FILE", "newton|golden"; empty: a flag
  std::string sentence;    ///< for --help
  /// Called with each value, in the order in which options were added; of a flag with "true". May throw BadValue.
  std::function<void(const std::string& text)> take;
  std::function<std::string()> spell = {};  ///< the default; none: there is none, or default_text says it
  Values values = Values::one;
  bool required = false;
  bool rare = false;                 ///< left out by --help, not by --help-all
  CellKinds cells = CellKinds::all;  ///< cells of the meshes that it is for
  /// The cells that a value is for; none: each value is for all cells of the option.
  std::function<CellKinds(std::string_view text)> cells_of = {};
  /// Values with their meanings, each in a line below the option.
  std::vector<std::pair<std::string, std::string>> meanings = {};
  std::string excludes = {};  ///< the option that may not be given, too
  std::string default_text = {};
  std::string group = {};               ///< the title above it in --help; Command::add fills it in
  std::vector<std::string> given = {};  ///< the values on the command line; parse fills it in

  [[nodiscard]] bool is_argument() const { return !names.starts_with('-'); }
  [[nodiscard]] bool is_flag() const { return value_name.empty() && !is_argument(); }
  [[nodiscard]] bool is_help() const { return !take; }
  /// The option must be given, so it has no default.
  Option& require();
  /// Spells the default now.
  Option& defaults_to(std::function<std::string()> spell);
};

/// The words between commas, empty ones included; at least one: "-o,--output" as "-o" and "--output".
[[nodiscard]] std::vector<std::string> separated(std::string_view list, char separator = ',');
/// "--output" of "-o,--output": the name of an option in messages.
[[nodiscard]] std::string long_name(const std::string& names);

struct HelpRow {
  std::string head, meaning;  ///< "-o, --output FILE" and its sentence
};

inline constexpr std::size_t kOptionColumns = 27;

/// Below its title a part has rows, or lines.
struct HelpPart {
  std::string title;
  std::vector<HelpRow> rows = {};
  std::size_t columns = kOptionColumns;  ///< of the heads
  std::string note = {};                 ///< beside the title
  std::string lines = {};                ///< to be shown as they are
};

/// The parts of --help besides the options.
struct VerbHelp {
  std::string usage;     ///< what follows `temper VERB`
  std::string examples;  ///< lines "temper …"; comments start with #
  std::vector<Exit> exits;
  /// Further lists of --help-all, and of --help-paper: the options of --set.
  std::vector<HelpPart> all = {}, paper = {};
  /// What to write instead of an unknown option, named without dashes; or nothing.
  std::function<std::string(std::string_view name)> instead = {};
};

/// Command: a verb, or a word that selects further options of it (`temper example random`).
class Command {
 public:
  Command(std::string name, std::string description);

  /// The title of options that are added from here on.
  void group(std::string title) { group_ = std::move(title); }
  /// Returns the option in the command: changes to it count until parse.
  Option& add(Option option);
  Option& add_flag(std::string name, bool& target, std::string sentence);
  /// Adds -h,--help, which prints this help.
  void add_help(VerbHelp help);
  /// At most one of them can be given. The options of the verb may also come after it.
  Command& add_subcommand(std::string name, std::string description);

  /// Reads the arguments. False: help was requested and printed. Bad usage is a Failure with a suggestion.
  [[nodiscard]] bool parse(const Arguments& arguments);
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const std::string& description() const { return description_; }
  [[nodiscard]] const VerbHelp& help() const { return help_; }
  [[nodiscard]] const std::deque<Option>& options() const { return options_; }
  [[nodiscard]] const std::list<Command>& subcommands() const { return subcommands_; }
  /// The subcommand that was given, or null.
  [[nodiscard]] const Command* chosen() const { return chosen_; }
  /// An option by one of its names, dashes included. It must be there.
  [[nodiscard]] Option& option(std::string_view name);
  [[nodiscard]] Option& option_at(std::size_t index) { return options_[index]; }
  [[nodiscard]] bool was_given(std::string_view name) const;
  /// Refuses (bad usage) an option or a value that was given, but is for other cells than the mesh in `path` has.
  void expect_for(CellKinds cells, const std::string& path) const;

 private:
  class Parser;
  [[nodiscard]] std::size_t index_of(std::string_view name) const;

  std::string name_, description_, group_;
  VerbHelp help_;
  std::deque<Option> options_;      // whose references stay good
  std::list<Command> subcommands_;  // the same, of a type that is not complete here
  const Command* chosen_ = nullptr;
};

}  // namespace temper::app
