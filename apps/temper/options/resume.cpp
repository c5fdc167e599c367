#include "options/resume.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>

namespace temper::app {
namespace {

constexpr std::string_view kResume = "--resume";

void add_words(const Option& option, Arguments& words) {
  for (const std::string& value : option.given) {
    const bool looks_like_option = value.starts_with('-');
    if (option.is_argument()) {
      words.push_back(looks_like_option ? "./" + value : value);
    } else {
      words.push_back(option.is_flag() ? long_name(option.names) : long_name(option.names) + "=" + value);
    }
  }
}

[[noreturn]] void refuse(const Command& command, const std::string& what) {
  std::vector<std::string> names;
  for (const Option& option : command.options()) {
    if (option.may_be_anew) names.push_back(long_name(option.names));
  }
  throw Failure(Exit::bad_usage, fmt::format("{}: {}; beside {} expected no more than {}\nSee temper {} --help",
                                             command.name(), what, kResume, fmt::join(names, ", "), command.name()));
}

}  // namespace

Arguments given_words(const Command& command) {
  Arguments words;
  for (const Option& option : command.options()) {
    if (!option.is_help()) add_words(option, words);
  }
  return words;
}

Arguments resumed_words(const Command& now, const Command& then) {
  Arguments words;
  for (std::size_t i = 0; i < now.options().size(); ++i) {
    const Option &given = now.options()[i], &before = then.options()[i];
    const std::string name = long_name(given.names);
    if (given.is_help() || name == kResume) continue;
    if (given.given.empty()) {
      add_words(before, words);
    } else if (!given.may_be_anew) {
      refuse(now, fmt::format("{} is that of the run that is resumed, and cannot be given anew", name));
    } else if (name == "--trace" && before.given.empty()) {
      refuse(now, "--trace: the run was not traced from its beginning");
    } else {
      add_words(given, words);
    }
  }
  return words;
}

}  // namespace temper::app
