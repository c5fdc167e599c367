// "Did you mean …?": the name nearest to a mistyped one.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace temper {

/// The candidate with the least edit distance, or empty when none is near (letter case does not count).
[[nodiscard]] std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates);

/// "a, b, c"
[[nodiscard]] std::string join(std::span<const std::string_view> words, std::string_view separator = ", ");

/// "; did you mean 'word'?", or empty when none is near
[[nodiscard]] std::string did_you_mean(std::string_view word, std::span<const std::string_view> candidates);

/// "'wrod' is none of word, name; did you mean 'word'?"
[[nodiscard]] std::string none_of(std::string_view word, std::span<const std::string_view> candidates);

}  // namespace temper
