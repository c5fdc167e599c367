// Which figures a user asked for: "6", "6,8", "16-18", in any number of words.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "gallery.hpp"
#include "temper/detail/error.hpp"

namespace temper::gallery {

/// The figures of `all` that the words name, each once, by number; no words: all. A range skips the paper's
/// drawings. Errors (invalid_option): a word that is no number, list or range; a number that the paper has not, that
/// is a drawing, or that is not among `all`.
[[nodiscard]] Expected<std::vector<Figure>> select(std::span<const Figure> all, std::span<const std::string> words);

}  // namespace temper::gallery
