#include "temper/detail/error.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>

#include "temper/detail/utf8.hpp"

namespace temper {

std::string_view name(ErrorCode code) {
  constexpr std::string_view kNames[] = {
      // in the order of the enum
      "not_found",          "empty_input",         "truncated",     "syntax",       "unsupported",
      "index_out_of_range", "size_mismatch",       "not_finite",    "not_planar",   "not_on_sphere",
      "duplicate_point",    "unused_point",        "zero_area",     "zero_volume",  "non_manifold_face",
      "non_manifold_edge",  "non_manifold_vertex", "overlap",       "missing_edge", "geographic",
      "out_of_scale",       "invalid_option",      "hidden_vertex", "stopped",      "trace_mismatch",
      "rank_mismatch",      "not_writable"};
  const auto i = static_cast<std::size_t>(code);
  return i < std::size(kNames) ? kNames[i] : "unknown";
}

// Makes text from anywhere safe for a terminal: no byte of it moves the cursor, and all of it is UTF-8.

namespace {

/// The bytes of the first character, or 0 when the text begins with none. It may be cut off, longer than necessary, a
/// surrogate, or beyond Unicode.
std::size_t length_of_first(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const unsigned first = byte(0), second = byte(1);
  if (first < 0x80) return 1;
  const std::size_t n = first < 0xc2 ? 0 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : first < 0xf5 ? 4 : 0;
  for (std::size_t i = 1; i < n; ++i) {
    if ((byte(i) & 0xc0u) != 0x80u) return 0;
  }
  const bool too_long = (first == 0xe0 && second < 0xa0) || (first == 0xf0 && second < 0x90);
  const bool no_character = (first == 0xed && second > 0x9f) || (first == 0xf4 && second > 0x8f);
  return too_long || no_character ? 0 : n;
}

/// U+0000 to U+001F and U+007F to U+009F.
bool is_control(unsigned code) { return code < 0x20 || (code >= 0x7f && code < 0xa0); }

void append_escape(std::string& text, unsigned code) {
  constexpr std::string_view kHex = "0123456789abcdef";
  text += {'\\', 'x', kHex[code >> 4], kHex[code & 15]};
}

void append_latin(std::string& text, unsigned code) {
  if (code < 0x80) {
    text += static_cast<char>(code);
  } else {
    text += {static_cast<char>(0xc0 | code >> 6), static_cast<char>(0x80 | (code & 0x3f))};
  }
}

void append_printable(std::string& text, unsigned code) {
  if (is_control(code) && code != '\n' && code != '\t') return append_escape(text, code);
  append_latin(text, code);
}

}  // namespace

std::string printable(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const auto first = static_cast<unsigned char>(text[0]);
    const std::size_t n = length_of_first(text);
    const bool below_256 = n == 2 && first < 0xc4;
    if (n < 2) {
      append_printable(result, first);
    } else if (below_256) {
      append_printable(result, (first & 3u) << 6 | (static_cast<unsigned char>(text[1]) & 0x3fu));
    } else {
      result += text.substr(0, n);
    }
    text.remove_prefix(n == 0 ? 1 : n);
  }
  return result;
}

std::optional<std::string> recoded(std::string_view text) {
  std::optional<std::string> result;
  for (std::size_t i = 0, n = 0; i < text.size(); i += std::max<std::size_t>(n, 1)) {
    n = length_of_first(text.substr(i));
    if (n == 0 && !result) result = text.substr(0, i);
    if (!result) continue;
    if (n == 0)
      append_latin(*result, static_cast<unsigned char>(text[i]));
    else
      *result += text.substr(i, n);
  }
  return result;
}

}  // namespace temper
