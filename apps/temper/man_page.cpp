#include "man_page.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "console.hpp"
#include "help.hpp"
#include "temper/version.hpp"

namespace temper::app {
namespace {

/// Text as roff shows it: a hyphen that can be copied, and no dot or quote that begins a line.
std::string roff(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const bool begins_line = result.empty() || result.back() == '\n';
    if (begins_line && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else if (c == '^') {
      result += "\\(ha";
    } else if (c == '~') {
      result += "\\(ti";
    } else {
      result += c;
    }
  }
  return result;
}

/// Text in lines that are short for whoever looks at the source: man fills them again.
std::string filled(std::string_view text) {
  constexpr std::size_t kColumns = 60;  // before hyphens become two characters
  std::string lines;
  for (const std::string& line : wrap(text, kColumns)) lines += roff(line) + "\n";
  return lines;
}

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

std::string page_of(const std::string& verb) { return verb.empty() ? "temper" : "temper-" + verb; }

/// The page up to its synopsis. No date: the same sources give the same bytes.
std::string page_begin(const std::string& verb, std::string_view summary, const std::string& usage) {
  return fmt::format(
      ".TH {} 1 \"\" \"temper {}\" \"User Commands\"\n"
      ".SH NAME\n{} \\- {}\n"
      ".SH SYNOPSIS\n.B {}\n{}\n",
      upper(page_of(verb)), version(), roff(page_of(verb)), roff(summary),
      roff(verb.empty() ? "temper" : "temper " + verb), roff(usage));
}

std::string section(std::string_view title) { return fmt::format(".SH {}\n", title); }

/// A head in bold, and below it what it means.
std::string item(const std::string& head, std::string_view meaning) {
  return fmt::format(".TP\n{}\n{}", head, filled(meaning));
}
std::string bold(std::string_view text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(std::string_view text) { return "\\fI" + roff(text) + "\\fR"; }

std::string option_item(const Option& option) {
  if (option.is_argument()) return item(italic(option.names), described(option));
  std::string head;
  for (const std::string& name : single_names(option.names)) head += (head.empty() ? "" : ", ") + bold(name);
  if (!option.value_name.empty()) head += " " + italic(option.value_name);
  return item(head, described(option));
}

std::string options_section(const Command& command) {
  std::string text, group;
  for (const Option& option : command.options()) {
    if (text.empty()) text = section("OPTIONS");
    const std::string title = option.is_argument() ? "Arguments" : option.group;
    if (title != group) text += ".SS " + roff(title) + "\n";
    group = title;
    text += option_item(option);
  }
  for (const Command& inner : command.subcommands()) {
    text += fmt::format(".SS {}\n{}", roff(inner.name()), filled(inner.description()));
    for (const Option& option : inner.options()) text += option_item(option);
  }
  return text;
}

std::string page_end(const VerbHelp& help) {
  std::string text = section("EXAMPLES") + ".nf\n" + roff(help.examples) + ".fi\n" + section("EXIT STATUS");
  for (const Exit exit : help.exits) text += item(bold(std::to_string(static_cast<int>(exit))), meaning(exit));
  return text;
}

std::string_view summary_of(const std::string& verb) {
  for (const Verb& row : verbs()) {
    if (row.name == verb) return row.summary;
  }
  return "";
}

}  // namespace

std::string man_page(const Command& command) {
  const std::string& verb = command.name();
  return page_begin(verb, summary_of(verb), command.help().usage) + section("DESCRIPTION") +
         filled(command.description()) + options_section(command) + page_end(command.help()) + section("SEE ALSO") +
         ".BR temper (1)\n";
}

std::string man_page_of_program() {
  std::string text = page_begin("", kProgramSummary, program_help().usage) + section("VERBS");
  for (const Verb& verb : verbs()) text += item(bold(verb.name), verb.summary);
  text += section("OPTIONS");
  for (const ProgramOption& option : program_options()) text += item(bold(option.names), option.sentence);
  text += section("ENVIRONMENT");
  text +=
      item(bold("TEMPER_NETCDF"),
           "the file of libnetcdf, where several are installed or the loader does not find it: files of MPAS and UGRID "
           "are read and written by that library");
  text += item(bold("TEMPER_HDF5"), "the file of libhdf5, likewise: VTKHDF files are read and written by that library");
  text += page_end(program_help()) + section("SEE ALSO");
  for (const Verb& verb : verbs()) {
    text += fmt::format(".BR {} (1){}\n", roff(page_of(std::string(verb.name))), &verb == &verbs().back() ? "" : ",");
  }
  return text;
}

}  // namespace temper::app
