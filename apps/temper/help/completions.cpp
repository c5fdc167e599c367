// Completions. The function of a shell runs `temper --help=words WORD...`, with the words up to the unfinished one. The
// answer lists the possible words: one per line with its meaning, :file or :directory.
#include <algorithm>
#include <array>

#include "console.hpp"
#include "help/help.hpp"
#include "temper/detail/suggest.hpp"

namespace temper::app {
namespace {

constexpr std::string_view kBash = R"sh(# Completion of temper for bash
_temper() {
  local word=${COMP_WORDS[COMP_CWORD]} offer
  COMPREPLY=()
  while IFS=$'\t' read -r offer _; do
    case $offer in
      :*) compopt -o filenames 2>/dev/null
        mapfile -tO ${#COMPREPLY[@]} COMPREPLY < <(compgen -A "${offer:1}" -- "$word") ;;
      "$word"*) COMPREPLY+=("$offer") ;;
    esac
  done < <("${COMP_WORDS[0]/#\~/$HOME}" --help=words "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null)
}
complete -F _temper temper
)sh";
constexpr std::string_view kZsh = R"sh(#compdef temper
_temper() {
  local offer tab=$'\t'
  local -a offers
  for offer in "${(@f)$(${~words[1]} --help=words "${(@)words[2,CURRENT]}" 2>/dev/null)}"; do
    case $offer in
      :file) _files ;;
      :directory) _files -/ ;;
      ?*) offers+=("${${offer//:/\\:}//$tab/:}") ;;
    esac
  done
  _describe temper offers
  ((compstate[nmatches]))
}
if [[ $funcstack[1] == _temper ]]; then _temper "$@"; else compdef _temper temper; fi
)sh";
constexpr std::string_view kFish = R"sh(# Completion of temper for fish
function __temper_offers
  set -l words (commandline -opc) "$(commandline -ct)"
  set -l offers ($words[1] --help=words $words[2..] 2>/dev/null)
  string match -rv (string match -q -- '-*' $words[-1]; and echo '^:'; or echo '^[:-]') -- $offers
  contains :file $offers; and __fish_complete_path $words[-1]
  contains :directory $offers; and __fish_complete_directories $words[-1]
end
complete -c temper -f -a '(__temper_offers)'
)sh";

constexpr std::array<std::string_view, 4> kFormats = {"man", "bash", "zsh", "fish"},
                                          kScripts = {"", kBash, kZsh, kFish};

bool has(const auto& names, std::string_view name) { return std::ranges::find(names, name) != std::end(names); }

/// A line: the word, and the first clause of its meaning.
std::string offer(std::string_view word, std::string_view meaning) {
  constexpr std::size_t kLongest = 70;
  std::string_view clause = meaning.substr(0, std::min(meaning.find_first_of(";(:"), meaning.find(". ")));
  if (clause.ends_with('.')) clause.remove_suffix(1);
  if (clause.size() > kLongest) clause = clause.substr(0, clause.rfind(' ', kLongest));
  return std::string(word) + "\t" + std::string(clause) + "\n";
}

/// "all|lines|FILE" as two words and files. Names of values that stand for something are listed here.
std::string offered_values(const std::string& value_name) {
  static constexpr std::string_view kFiles[] = {"FILE", "IN", "IN0", "MESH", "OUT", "OUTLINE", "TRACE"};
  static constexpr std::string_view kStandIns[] = {"N", "X", "X[:absolute]", "VERTEX", "KIND[:lon,lat]"};
  const std::vector<std::string> parts = separated(value_name, '|');
  std::string text;
  for (const std::string& part : parts) {
    const bool word = parts.size() > 1 && !has(kStandIns, part);
    text += has(kFiles, part) ? ":file\n" : part == "DIR" ? ":directory\n" : word ? part + "\n" : "";
  }
  return text;
}

std::string offers(const Command& command, const Arguments& words) {
  const bool dash = words.back().starts_with('-');
  std::string names, places;
  std::vector<const Command*> commands = {&command};
  for (const Command& inner : command.subcommands()) {
    if (has(words, inner.name())) commands.push_back(&inner);
    places += offer(inner.name(), inner.description());
  }
  for (const Command* each : commands) {
    for (const Option& option : each->options()) {
      const std::vector<std::string> spelled = separated(option.names);
      if (option.is_argument() && places.empty()) places = offered_values(option.names);
      if (!option.is_flag() && !dash && has(spelled, words[words.size() - 2])) return offered_values(option.value_name);
      for (const std::string& name : spelled) names += option.is_argument() ? "" : offer(name, option.sentence);
    }
  }
  return dash ? names : commands.size() > 1 ? "" : places;
}

std::string offered_verbs() {
  std::string text = offer("--help", "verbs and examples") + offer("--version", "also of what it was built from");
  for (const Verb& verb : verbs()) text += offer(verb.name, verb.summary);
  return text;
}

}  // namespace

bool print_other_help(const Arguments& words, const Command* verb) {
  constexpr std::string_view kHelpEquals = "--help=";
  if (words.empty() || !words[0].starts_with(kHelpEquals)) return false;
  const std::string format = words[0].substr(kHelpEquals.size());
  const auto row = std::ranges::find(kFormats, format);
  if (words[0] == kHelpWords) {
    print(verb == nullptr ? offered_verbs() : words.size() > 1 ? offers(*verb, words) : "");
  } else if (row == kFormats.end() || words.size() > 1) {
    throw Failure(Exit::bad_usage, "--help: " + none_of(format, kFormats));
  } else if (row == kFormats.begin()) {
    print(man_page(verb == nullptr ? help_of_program() : help_of(*verb, HelpForm::all)));
  } else {
    print(kScripts.at(static_cast<std::size_t>(row - kFormats.begin())));
  }
  return true;
}

}  // namespace temper::app
