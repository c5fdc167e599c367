#include "help.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>
#include <vector>

#include "console.hpp"
#include "verbs.hpp"

namespace temper::app {
namespace {

constexpr std::size_t kWidth = 100;       // of a line: fits half of a wide screen
constexpr std::size_t kNameColumns = 26;  // of option names; longer ones get a line to themselves

/// "-o, --output FILE"
std::string option_head(const Option& option) {
  std::string text = option.names;
  if (const std::size_t comma = text.find(','); comma != std::string::npos) text.insert(comma + 1, " ");
  return option.value_name.empty() ? text : text + " " + option.value_name;
}

/// The line of a head; alternatives (a|b|c) beyond the width go on below the first one.
std::string head_lines(const std::string& head) {
  std::string rest = "  " + head, lines;
  const std::size_t column = rest.rfind(' ') + 1;
  while (rest.size() > kWidth) {
    const std::size_t bar = rest.rfind('|', kWidth - 1);
    if (bar == std::string::npos) break;
    lines += rest.substr(0, bar + 1) + "\n";
    rest = std::string(column, ' ') + rest.substr(bar + 1);
  }
  return lines + rest;
}

/// A head, and what it means in the columns to its right.
std::string beside(const std::string& head, const std::string& description) {
  std::string text = head_lines(head);
  const bool own_line = head.size() > kNameColumns;
  bool first = true;
  for (const std::string& line : wrap(description, kWidth - kNameColumns - 4)) {
    text += first && !own_line ? std::string(kNameColumns + 2 - head.size(), ' ')
                               : "\n" + std::string(kNameColumns + 4, ' ');
    text += line;
    first = false;
  }
  return text + "\n";
}

std::string option_text(const Option& option) { return beside(option_head(option), described(option)); }

/// Options in the order in which they were added: all, by group, or those that are not rare.
std::string option_groups(const Command& command, bool all) {
  std::string text, group;
  const bool grouped = all || std::ranges::none_of(command.options(), &Option::rare);
  for (const Option& option : command.options()) {
    if (option.rare && !all) continue;
    const std::string title = option.is_argument() ? "Arguments" : grouped ? option.group : "Options";
    if (title != group) text += "\n" + title + ":\n";
    group = title;
    text += option_text(option);
  }
  return text;
}

std::string paragraph(const std::string& text) {
  std::string wrapped;
  for (const std::string& line : wrap(text, kWidth)) wrapped += line + "\n";
  return wrapped;
}

std::string exit_lines(const std::vector<Exit>& exits) {
  std::string text = "\nExit codes:\n";
  for (const Exit exit : exits) text += fmt::format("  {}  {}\n", static_cast<int>(exit), meaning(exit));
  return text;
}

}  // namespace

std::string described(const Option& option) {
  if (option.default_text.empty()) return option.sentence;
  return fmt::format("{} (default: {})", option.sentence, option.default_text);
}

std::string_view meaning(Exit exit) {
  switch (exit) {
    case Exit::done:
      return "done";
    case Exit::bad_input:
      return "bad input, or an output that cannot be written; nothing was written but what the message names";
    case Exit::bad_usage:
      return "bad usage: options that make no sense";
    case Exit::requirement:
      return "what --require or --require-claims asks for is not met";
    case Exit::stopped_early:
      return "stopped by a signal or --time-limit, best mesh written; or edges that may flip are not regular";
    case Exit::internal:
      return "out of memory, or an internal error: please report that";
    case Exit::infeasible:
      return "weights: there are none that do what was asked; nothing was written but the certificate";
  }
  return "";
}

std::span<const ProgramOption> program_options() {
  static constexpr auto kOptions = std::to_array<ProgramOption>({
      {"-h, --help", "this text; temper VERB --help has the options and examples of a verb"},
      {"--help=FORMAT", "the same for man, or completions for bash, zsh or fish: man <(temper optimize --help=man)"},
      {"--version", "the version, and what the program was built from"},
  });
  return kOptions;
}

const VerbHelp& program_help() {
  static const VerbHelp help = {
      .usage = "VERB ...",
      .examples =
          "  temper example horseshoe -o horseshoe.vtu\n"
          "  temper check horseshoe.vtu\n"
          "  temper optimize horseshoe.vtu -o tempered.vtu --draw before-after.svg\n",
      .exits = {Exit::done, Exit::bad_input, Exit::bad_usage, Exit::requirement, Exit::stopped_early, Exit::internal,
                Exit::infeasible},
  };
  return help;
}

namespace {

/// All examples, or those without rare options.
std::string examples(const Command& command, bool all) {
  std::string text;
  std::istringstream lines(command.help().examples);
  for (std::string line; std::getline(lines, line);) {
    const auto uses = [&line](const Option& option) {
      return option.rare && (line + " ").find(" " + long_name(option.names) + " ") != std::string::npos;
    };
    if (all || std::ranges::none_of(command.options(), uses)) text += line + "\n";
  }
  return text;
}

std::string help_text(const Command& command, bool all) {
  const VerbHelp& help = command.help();
  std::string text = paragraph(command.description());
  text += fmt::format("\nUsage: temper {} {}\n", command.name(), help.usage);
  text += option_groups(command, all);
  for (const Command& inner : command.subcommands()) {
    text += fmt::format("\n{}: {}\n", inner.name(), inner.description());
    for (const Option& option : inner.options()) text += option_text(option);
  }
  return text + "\nExamples:\n" + examples(command, all) + exit_lines(help.exits);
}

}  // namespace

std::string help_text(const Command& command) { return help_text(command, false); }
std::string whole_help_text(const Command& command) { return help_text(command, true); }

std::string short_help() {
  std::string text = "Usage: temper VERB ...\n\n";
  for (const Verb& verb : verbs()) text += fmt::format("  {:<11}{}\n", verb.name, verb.summary);
  return text + "\nSee temper --help and temper VERB --help.\n";
}

std::string full_help() {
  std::string text = fmt::format("temper: {}\n\nUsage: temper VERB ...\n\nVerbs:\n", kProgramSummary);
  for (const Verb& verb : verbs()) text += fmt::format("  {:<11}{}\n", verb.name, verb.summary);
  text += "\nOptions:\n";
  for (const ProgramOption& option : program_options()) {
    text += beside(std::string(option.names), std::string(option.sentence));
  }
  return text + "\nExamples:\n" + program_help().examples + exit_lines(program_help().exits);
}

}  // namespace temper::app
