#include "temper/detail/error.hpp"

#include <cstddef>

namespace temper {

std::string_view name(ErrorCode code) {
  switch (code) {
    case ErrorCode::not_found:
      return "not_found";
    case ErrorCode::empty_input:
      return "empty_input";
    case ErrorCode::truncated:
      return "truncated";
    case ErrorCode::syntax:
      return "syntax";
    case ErrorCode::unsupported:
      return "unsupported";
    case ErrorCode::index_out_of_range:
      return "index_out_of_range";
    case ErrorCode::size_mismatch:
      return "size_mismatch";
    case ErrorCode::not_finite:
      return "not_finite";
    case ErrorCode::not_planar:
      return "not_planar";
    case ErrorCode::not_on_sphere:
      return "not_on_sphere";
    case ErrorCode::duplicate_point:
      return "duplicate_point";
    case ErrorCode::unused_point:
      return "unused_point";
    case ErrorCode::zero_area:
      return "zero_area";
    case ErrorCode::zero_volume:
      return "zero_volume";
    case ErrorCode::non_manifold_face:
      return "non_manifold_face";
    case ErrorCode::non_manifold_edge:
      return "non_manifold_edge";
    case ErrorCode::non_manifold_vertex:
      return "non_manifold_vertex";
    case ErrorCode::overlap:
      return "overlap";
    case ErrorCode::missing_edge:
      return "missing_edge";
    case ErrorCode::geographic:
      return "geographic";
    case ErrorCode::out_of_scale:
      return "out_of_scale";
    case ErrorCode::invalid_option:
      return "invalid_option";
    case ErrorCode::hidden_vertex:
      return "hidden_vertex";
    case ErrorCode::stopped:
      return "stopped";
    case ErrorCode::trace_mismatch:
      return "trace_mismatch";
    case ErrorCode::rank_mismatch:
      return "rank_mismatch";
    case ErrorCode::not_writable:
      return "not_writable";
  }
  return "unknown";
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
  if (is_control(code) && code != '\n' && code != '\t') return append_escape(text, code);
  if (code < 0x80) {
    text += static_cast<char>(code);
  } else {
    text += {static_cast<char>(0xc0 | code >> 6), static_cast<char>(0x80 | (code & 0x3f))};
  }
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
      append_latin(result, first);
    } else if (below_256) {
      append_latin(result, (first & 3u) << 6 | (static_cast<unsigned char>(text[1]) & 0x3fu));
    } else {
      result += text.substr(0, n);
    }
    text.remove_prefix(n == 0 ? 1 : n);
  }
  return result;
}

}  // namespace temper
