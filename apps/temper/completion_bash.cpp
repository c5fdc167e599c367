// A function that is called with the words so far; works with and without the package bash-completion.
#include <fmt/format.h>

#include "completions.hpp"
#include "temper/version.hpp"

namespace temper::app {
namespace {

std::string names_of(const Command& command) {
  std::vector<std::string> names;
  for (const Option& option : command.options()) {
    if (option.is_argument()) continue;
    for (const std::string& name : single_names(option.names)) names.push_back(name);
  }
  return joined(names);
}

/// "--gamma|--seed", as a pattern of `case`.
std::string pattern(const Option& option) {
  std::string text;
  for (const std::string& name : single_names(option.names)) text += (text.empty() ? "" : "|") + name;
  return text;
}

std::string value_cases(const Command& command) {
  std::string text;
  for (const Option& option : command.options()) {
    if (option.is_argument() || option.is_flag()) continue;
    const Completion completion = completion_of(option);
    constexpr const char* kKinds[] = {"none", "none", "file", "folder"};
    text += fmt::format("        {}) kind={} words='{}' ;;\n", pattern(option),
                        kKinds[static_cast<std::size_t>(completion.kind)], joined(completion.words));
  }
  return text.empty() ? text : "      case $before in\n" + text + "      esac\n";
}

}  // namespace

std::string bash_begin() {
  std::string names;
  for (const Verb& verb : verbs()) names += std::string(verb.name) + " ";
  return fmt::format(
      R"(# Completion of temper {} for bash: temper --help=bash
_temper() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} names='' words='' kind=''
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    COMPREPLY=($(compgen -W '{}--help --version' -- "$word"))
    return
  fi
  case ${{COMP_WORDS[1]}} in
)",
      version(), names);
}

std::string bash_verb(const Command& command) {
  std::string text = fmt::format("    {})\n      names='{}'\n", command.name(), names_of(command));
  if (!command.subcommands().empty()) {
    std::vector<std::string> inner;
    std::string cases;
    for (const Command& each : command.subcommands()) {
      inner.push_back(each.name());
      if (each.options().empty()) continue;
      cases += fmt::format("        *' {} '*) names+=' {}' ;;\n", each.name(), names_of(each));
    }
    text += fmt::format("      words='{}' kind=none\n      case \" ${{COMP_WORDS[*]:2}} \" in\n{}      esac\n",
                        joined(inner), cases);
  }
  return text + value_cases(command) + "      ;;\n";
}

std::string bash_end() {
  return R"(    *) return ;;
  esac
  if [[ $word == -* && -z $words ]] || [[ $word == -* && $kind == none ]]; then
    COMPREPLY=($(compgen -W "$names" -- "$word"))
    return
  fi
  [[ -z $words ]] || COMPREPLY=($(compgen -W "$words" -- "$word"))
  [[ $kind == none ]] && return
  compopt -o filenames 2>/dev/null
  local path
  while IFS= read -r path; do COMPREPLY+=("$path"); done < <(
    if [[ $kind == folder ]]; then compgen -d -- "$word"; else compgen -f -- "$word"; fi)
}
complete -F _temper temper
)";
}

}  // namespace temper::app
