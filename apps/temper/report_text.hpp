// Reports for people: tables, histograms made of bars, the worst triangles in the numbers of their file.
#pragma once

#include <string>

#include "input.hpp"
#include "temper/quality.hpp"

namespace temper::app {

/// Columns of the tables of `temper check` and `temper optimize`.
inline constexpr std::size_t kLabelColumns = 30, kNumberColumns = 14;

/// The style of text that the terminal wants.
struct TextStyle {
  bool utf8 = true;  ///< else bars and symbols in ASCII
  std::size_t columns = 100;
};
/// By the locale and the terminal.
[[nodiscard]] TextStyle text_style();

/// The library's sentences, for a terminal without UTF-8.
[[nodiscard]] std::string in_ascii(std::string text);

/// Counts, margins, all energies, histograms, the worst triangles: `temper check`.
[[nodiscard]] std::string quality_text(const Quality& quality, const Input& input, const TextStyle& style);

/// Counts, margins and the energies of one star, before and after: `temper optimize`.
[[nodiscard]] std::string comparison_text(const Quality& before, const Quality& after, int star,
                                          const TextStyle& style);

/// "46 of 96 triangles are not well-centered, every edge is regular"
[[nodiscard]] std::string verdict(const Quality& quality);

/// Triangles that are not well-centered.
[[nodiscard]] std::size_t bad_triangles(const Quality& quality);

}  // namespace temper::app
