#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>

#include "console.hpp"
#include "help/help.hpp"
#include "temper/detail/version.hpp"

namespace temper::app {
namespace {

/// Text for roff: a hyphen that can be copied, and no dot or quote at the beginning of a line.
std::string roff(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const bool begins_line = result.empty() || result.back() == '\n';
    if (begins_line && (c == '.' || c == '\'')) result += "\\&";
    result += c == '\\' ? "\\e" : c == '-' ? "\\-" : c == '^' ? "\\(ha" : c == '~' ? "\\(ti" : std::string(1, c);
  }
  return result;
}

/// Text in short lines for readers of the source: man fills them again.
std::string filled(std::string_view text) {
  constexpr std::size_t kColumns = 60;  // before hyphens become two characters
  std::string lines;
  for (const std::string& line : wrap(text, kColumns)) lines += roff(line) + "\n";
  return lines;
}

std::string upper(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

/// A word for roff, whose line may end between alternatives.
std::string breakable(std::string_view word) {
  std::string result;
  for (const char c : roff(word)) result += c == '|' ? "|\\:" : std::string(1, c);
  return result;
}

/// The names of "-o, --output FILE" are bold, the rest is in italics.
std::string item(const HelpRow& row) {
  std::string text = ".TP\n", gap;
  std::istringstream words(row.head);
  for (std::string word; words >> word; gap = " ") {
    const char font = gap.empty() || word[0] == '-' ? 'B' : 'I';
    const bool comma = word.ends_with(',');
    if (comma) word.pop_back();
    text += fmt::format("{}\\f{}{}\\fR{}", gap, font, breakable(word), comma ? "," : "");
  }
  return text + "\n" + filled(row.meaning);
}

}  // namespace

std::string man_page(const HelpPage& page) {
  const std::string name = page.verb.empty() ? "temper" : "temper-" + page.verb;
  // No date: the same sources give the same bytes.
  std::string text = fmt::format(
      ".TH {} 1 \"\" \"temper {}\" \"User Commands\"\n.SH NAME\n{} \\- {}\n"
      ".SH SYNOPSIS\n.B temper{}\n{}\n.SH DESCRIPTION\n{}",
      upper(name), version(), roff(name), roff(page.summary), page.verb.empty() ? "" : " " + page.verb,
      roff(page.usage), filled(page.description));
  bool in_options = false;
  for (const HelpPart& part : page.parts) {
    const bool options = !page.verb.empty() && part.columns == kOptionColumns;
    if (options && !in_options) text += ".SH OPTIONS\n";
    in_options = options;
    text += options ? fmt::format(".SS \"{}\"\n{}", roff(part.title), part.note.empty() ? "" : filled(part.note))
                    : fmt::format(".SH \"{}\"\n", upper(part.title));
    if (!part.lines.empty()) text += ".nf\n" + roff(part.lines) + ".fi\n";
    for (const HelpRow& row : part.rows) text += item(row);
  }
  text += ".SH \"SEE ALSO\"\n.BR temper (1)";
  for (const Verb& verb : verbs()) text += fmt::format(",\n.BR temper\\-{} (1)", verb.name);
  return text + "\n";
}

}  // namespace temper::app
