#include "help_formats.hpp"

#include <array>
#include <vector>

#include "completions.hpp"
#include "man_page.hpp"
#include "suggest.hpp"

namespace temper::app {
namespace {

constexpr std::string_view kHelpEquals = "--help=";

constexpr auto kHelpFormats = std::to_array<HelpFormat>({
    {"man", man_page_of_program, man_page},
    {"bash", bash_begin, bash_verb, true, bash_end},
    {"zsh", zsh_begin, zsh_verb, true, zsh_end},
    {"fish", fish_begin, fish_verb, true},
});

}  // namespace

const HelpFormat* asked_help_format(const Arguments& arguments) {
  if (arguments.size() != 1 || !arguments.front().starts_with(kHelpEquals)) return nullptr;
  const std::string asked = arguments.front().substr(kHelpEquals.size());
  std::vector<std::string_view> names;
  for (const HelpFormat& format : kHelpFormats) {
    if (format.name == asked) return &format;
    names.push_back(format.name);
  }
  throw Failure(Exit::bad_usage, "--help: " + none_of(asked, names));
}

}  // namespace temper::app
