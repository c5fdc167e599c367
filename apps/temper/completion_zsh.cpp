// Specifications of _arguments, a function of verbs' own words.
#include <fmt/format.h>

#include "completions.hpp"
#include "temper/version.hpp"

namespace temper::app {
namespace {

std::string zsh_quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? "'\\''" : std::string(1, c);
  return result + "'";
}

/// ":FILE:_files" or ":newton|golden:(newton golden)"
std::string value_spec(const Option& option) {
  const Completion completion = completion_of(option);
  const std::string words = joined(completion.words);
  std::string action = " ";
  if (completion.kind == Completion::Kind::words) action = "(" + words + ")";
  if (completion.kind == Completion::Kind::file) action = "_files";
  if (completion.kind == Completion::Kind::folder) action = "_files -/";
  return ":" + escaped(option.is_argument() ? option.names : option.value_name, ":\\") + ":" + action;
}

std::string option_spec(const Option& option) {
  const std::vector<std::string> names = single_names(option.names);
  const std::string text = "[" + escaped(first_clause(option.sentence), "[]\\") + "]" +
                           (option.is_flag() ? std::string() : value_spec(option));
  const std::string repeated = option.values == Values::one ? "" : "*";
  if (names.size() == 1) return zsh_quoted(repeated + names[0] + text);
  const std::string either = repeated.empty() ? zsh_quoted("(" + joined(names) + ")") : zsh_quoted(repeated);
  std::string list;
  for (const std::string& name : names) {
    if (!list.empty()) list += ',';
    list += name;
  }
  return either + "{" + list + "}" + zsh_quoted(text);
}

std::string specs(const Command& command, const std::string& indent) {
  std::string text;
  for (const Option& option : command.options()) {
    const std::string spec = !option.is_argument()          ? option_spec(option)
                             : option.values == Values::one ? zsh_quoted(value_spec(option))
                                                            : zsh_quoted("*" + value_spec(option));
    text.append(" \\\n").append(indent).append(spec);
  }
  return text;
}

}  // namespace

std::string zsh_begin() {
  std::string text = fmt::format(
      "#compdef temper\n# Completion of temper {} for zsh: temper --help=zsh\n_temper() {{\n  local -a verbs=(\n",
      version());
  for (const Verb& verb : verbs()) text += "    " + zsh_quoted(fmt::format("{}:{}", verb.name, verb.summary)) + "\n";
  return text +
         "  )\n"
         "  if ((CURRENT == 2)); then\n"
         "    _describe verb verbs\n"
         "    _arguments '--help[verbs and examples]' '--version[the version, and what it was built from]'\n"
         "    return\n"
         "  fi\n"
         "  local verb=$words[2]\n"
         "  shift words\n"
         "  ((CURRENT--))\n"
         "  case $verb in\n";
}

std::string zsh_verb(const Command& command) {
  std::string text = fmt::format("    {})\n", command.name());
  if (!command.subcommands().empty()) {
    std::vector<std::string> inner;
    std::string cases;
    for (const Command& each : command.subcommands()) {
      inner.push_back(each.name());
      if (each.options().empty()) continue;
      cases += fmt::format("        *' {} '*) specs+=({}) ;;\n", each.name(), specs(each, "          "));
    }
    return text +
           fmt::format(
               "      local -a specs=({} \\\n        ':{}:({})')\n      case \" $words[2,-1] \" in\n{}      esac\n"
               "      _arguments $specs ;;\n",
               specs(command, "        "), "name", joined(inner), cases);
  }
  return text + "      _arguments" + specs(command, "        ") + " ;;\n";
}

std::string zsh_end() {
  return "  esac\n}\nif [[ $funcstack[1] == _temper ]]; then _temper \"$@\"; else compdef _temper temper; fi\n";
}

}  // namespace temper::app
