// One `complete` a row: each with the verb that it belongs to as its condition.
#include <fmt/format.h>

#include "completions.hpp"
#include "temper/version.hpp"

namespace temper::app {
namespace {

std::string fish_quoted(const std::string& text) { return "'" + escaped(text, "'\\") + "'"; }

std::string row(const std::string& condition, const std::string& rest) {
  return "complete -c temper -n " + fish_quoted(condition) + " " + rest + "\n";
}

std::string value_rule(const Option& option) {
  const Completion completion = completion_of(option);
  const std::string words = completion.words.empty() ? "" : " -a " + fish_quoted(joined(completion.words));
  switch (completion.kind) {
    case Completion::Kind::file:
      return " -r -F" + words;
    case Completion::Kind::folder:
      return " -x -a '(__fish_complete_directories)'";
    default:
      return " -x" + words;
  }
}

std::string option_rows(const Command& command, const std::string& condition) {
  std::string text;
  for (const Option& option : command.options()) {
    if (option.is_argument()) continue;
    std::string names;
    for (const std::string& name : single_names(option.names))
      names += name.starts_with("--") ? "-l " + name.substr(2) + " " : "-s " + name.substr(1) + " ";
    text += row(condition, names + "-d " + fish_quoted(first_clause(option.sentence)) +
                               (option.is_flag() ? std::string() : value_rule(option)));
  }
  return text;
}

}  // namespace

std::string fish_begin() {
  std::string text =
      fmt::format("# Completion of temper {} for fish: temper --help=fish\ncomplete -c temper -f\n", version());
  for (const Verb& verb : verbs()) {
    text += row("__fish_use_subcommand",
                fmt::format("-a {} -d {}", verb.name, fish_quoted(first_clause(std::string(verb.summary)))));
  }
  return text + row("__fish_use_subcommand", "-l help") + row("__fish_use_subcommand", "-l version");
}

std::string fish_verb(const Command& command) {
  const std::string condition = "__fish_seen_subcommand_from " + command.name();
  std::string text;
  for (const Option& option : command.options()) {
    if (!option.is_argument() || completion_of(option).kind != Completion::Kind::file) continue;
    text += row(condition, "-F");
    break;
  }
  text += option_rows(command, condition);
  for (const Command& inner : command.subcommands()) {
    text += row(condition, "-a " + inner.name() + " -d " + fish_quoted(first_clause(inner.description())));
    text += option_rows(inner, condition + "; and __fish_seen_subcommand_from " + inner.name());
  }
  return text;
}

}  // namespace temper::app
