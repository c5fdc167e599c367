// Completions for shells, each in a source of its own: scripts that `temper --help=bash` and the like print. They know
// verbs, options, the values that have names, and which values are files.
#pragma once

#include <string>
#include <vector>

#include "command.hpp"

namespace temper::app {

[[nodiscard]] std::string bash_begin();
[[nodiscard]] std::string bash_verb(const Command& command);
[[nodiscard]] std::string bash_end();
[[nodiscard]] std::string zsh_begin();
[[nodiscard]] std::string zsh_verb(const Command& command);
[[nodiscard]] std::string zsh_end();
[[nodiscard]] std::string fish_begin();
[[nodiscard]] std::string fish_verb(const Command& command);

/// What a shell can offer for the value of an option.
struct Completion {
  enum class Kind { nothing, words, file, folder } kind = Kind::nothing;
  std::vector<std::string> words = {};  ///< also besides files: all|lines|FILE
};
[[nodiscard]] Completion completion_of(const Option& option);

/// The first clause of a sentence: what fits beside a word on offer.
[[nodiscard]] std::string first_clause(const std::string& sentence);
[[nodiscard]] std::string joined(const std::vector<std::string>& words);
/// With a backslash before each character that is one of `special`.
[[nodiscard]] std::string escaped(const std::string& text, std::string_view special);

}  // namespace temper::app
