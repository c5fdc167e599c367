// Figures that were made, and the files that tell of them all: index.html for people, gallery.json for programs,
// claims.md and settings.md for gallery/claims.md.
//
// None holds a date, a duration or a path: the same pages give the same bytes.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "gallery.hpp"

namespace temper::gallery {

/// A figure and what its maker gave.
struct Result {
  Figure figure;
  Page page;
};

struct Tally {
  std::size_t hold = 0, all = 0;
  Tally& operator+=(Tally other);
};
/// The claims of one author.
[[nodiscard]] Tally count_claims(const Page& page, Author author);
[[nodiscard]] Tally count_claims(std::span<const Result> results, Author author);
/// "137 of 146 claims of the paper hold, and 3 of 4 of ours."
[[nodiscard]] std::string verdict_sentence(std::span<const Result> results);

/// One page that shows every figure: pictures by <img src="NAME.svg">, tables, claims. No scripts, nothing from
/// elsewhere.
[[nodiscard]] std::string index_html(std::span<const Result> results, Effort effort, std::string_view version);

/// {"version", "figures": [{"number", "title", "pictures": ["NAME.svg", …]}, …],
///  "claims": [{"figure", "claim", "paper", "temper", "holds", "why", "author"}, …]}, every key always there.
[[nodiscard]] std::string gallery_json(std::span<const Result> results, std::string_view version);

/// The claims as a table of Markdown, and after it what explains those that do not hold.
[[nodiscard]] std::string claims_markdown(std::span<const Result> results);

/// How each figure's runs took what the paper leaves open, as a table of Markdown.
[[nodiscard]] std::string settings_markdown(std::span<const Result> results);

}  // namespace temper::gallery
