#include "help/help.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <sstream>
#include <string_view>
#include <vector>

#include "console.hpp"
#include "subject.hpp"
#include "verbs.hpp"

namespace temper::app {
namespace {

constexpr std::size_t kWidth = 100;  // of a line: fits half of a wide screen

/// "-o, --output FILE"
std::string option_head(const Option& option) {
  std::string text = option.names;
  if (const std::size_t comma = text.find(','); comma != std::string::npos) text.insert(comma + 1, " ");
  return option.value_name.empty() ? text : text + " " + option.value_name;
}

/// The line of a head; alternatives (a|b|c) beyond the width continue below the first one.
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

/// A head, with its meaning in the columns to its right; a longer head gets a line to itself.
std::string beside(const HelpRow& row, std::size_t columns) {
  std::string text = head_lines(row.head);
  std::string gap = row.head.size() > columns ? "\n" + std::string(columns + 4, ' ')
                                              : std::string(columns + 2 - row.head.size(), ' ');
  for (const std::string& line : wrap(row.meaning, kWidth - columns - 4)) {
    text += gap + line;
    gap = "\n" + std::string(columns + 4, ' ');
  }
  return text + "\n";
}

HelpRow row_of(const Option& option) {
  return {option_head(option), option.default_text.empty()
                                   ? option.sentence
                                   : fmt::format("{} (default: {})", option.sentence, option.default_text)};
}

/// The rows of an option: itself, and its values that have a meaning of their own.
void add_rows(std::vector<HelpRow>& rows, const Option& option) {
  rows.push_back(row_of(option));
  for (const auto& [value, meaning] : option.meanings) rows.push_back({"    " + value, meaning + "."});
}

/// Options in the order in which they were added: all, by group, or those that are not rare.
void add_options(HelpPage& page, const Command& command, bool all) {
  const bool grouped = all || std::ranges::none_of(command.options(), &Option::rare);
  for (const Option& option : command.options()) {
    if (option.rare && !all) continue;
    const std::string title = option.is_argument() && grouped ? "Arguments" : grouped ? option.group : "Options";
    if (page.parts.empty() || page.parts.back().title != title) page.parts.push_back({title});
    add_rows(page.parts.back().rows, option);
  }
  for (const Command& inner : command.subcommands()) {
    page.parts.push_back({inner.name(), {}, kOptionColumns, inner.description()});
    for (const Option& option : inner.options()) add_rows(page.parts.back().rows, option);
  }
}

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

HelpPart verb_part() {
  HelpPart part = {"Verbs", {}, 9};
  for (const Verb& verb : verbs()) part.rows.push_back({std::string(verb.name), verb.summary});
  return part;
}

void add_end(HelpPage& page, std::string examples, std::span<const Exit> exits) {
  page.parts.push_back({"Examples", {}, 0, {}, std::move(examples)});
  if (!exits.empty()) page.parts.push_back({"Exit codes", {}, 1});
  for (const Exit exit : exits)
    page.parts.back().rows.push_back({std::to_string(static_cast<int>(exit)), std::string(meaning(exit, page.verb))});
}

std::string text_of(const HelpPart& part) {
  std::string text = part.lines;
  for (const HelpRow& row : part.rows) text += beside(row, part.columns);
  return text;
}

}  // namespace

HelpPage help_of(const Command& command, HelpForm form) {
  const VerbHelp& help = command.help();
  HelpPage page = {command.name(), {}, command.description(), help.usage, {}};
  for (const Verb& verb : verbs()) {
    if (verb.name == page.verb) page.summary = verb.summary;
  }
  if (form == HelpForm::paper) {
    page.parts = help.paper;
    return page;
  }
  const bool all = form == HelpForm::all;
  add_options(page, command, all);
  if (all) page.parts.insert(page.parts.end(), help.all.begin(), help.all.end());
  const bool short_form = !all && std::ranges::any_of(command.options(), &Option::rare);
  add_end(page, examples(command, all), short_form ? std::span<const Exit>() : std::span(help.exits));
  return page;
}

HelpPage help_of_program() {
  const std::string summary = "primal-dual meshes of " + any_elements("and") + " that solvers can trust";
  HelpPage page = {"", summary, "temper: " + summary, "VERB ...", {verb_part()}};
  page.parts.push_back(
      {"Options",
       {{"-h, --help", "Print this text. For the options and examples of a verb, run temper VERB --help."},
        {"--help=FORMAT",
         "Print a page for man, or completions for bash, zsh or fish. Example: man <(temper optimize --help=man)"},
        {"--version", "Print the version, and the commit, compiler and libraries of the program."}},
       kOptionColumns});
  page.parts.push_back(
      {"Environment",
       {{"TEMPER_NETCDF",
         "File of libnetcdf, which reads and writes files of MPAS and UGRID. Set it if several are installed, or if "
         "the loader does not find the library."},
        {"TEMPER_HDF5", "File of libhdf5, which reads and writes VTKHDF files. Set it in the same cases."}}});
  add_end(page,
          "  temper example horseshoe -o horseshoe.vtu\n"
          "  temper check horseshoe.vtu\n"
          "  temper optimize horseshoe.vtu -o tempered.vtu --write before-after.svg\n",
          std::to_array({Exit::done, Exit::bad_input, Exit::bad_usage, Exit::requirement, Exit::stopped_early,
                         Exit::internal, Exit::infeasible}));
  return page;
}

std::string text_of(const HelpPage& page) {
  std::string text;
  for (const std::string& line : wrap(page.description, kWidth)) text += line + "\n";
  text += fmt::format("\nUsage: temper {}{}{}\n", page.verb, page.verb.empty() ? "" : " ", page.usage);
  for (const HelpPart& part : page.parts)
    text += fmt::format("\n{}:{}{}\n{}", part.title, part.note.empty() ? "" : " ", part.note, text_of(part));
  return text;
}

std::string short_help() {
  return fmt::format("Usage: temper VERB ...\n\n{}\nSee temper --help and temper VERB --help.\n", text_of(verb_part()));
}

}  // namespace temper::app
