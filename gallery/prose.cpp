#include "prose.hpp"

#include <cstddef>

namespace temper::gallery {
namespace {

constexpr std::size_t kLongestSubscript = 3;  // letters: E_BHs; more is a name like min_h_over_l

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool continues_word(char c) { return is_letter(c) || is_digit(c) || c == '_'; }

/// Bytes of the run of letters, digits and ∂ that `text` begins with.
std::size_t subscript_length(std::string_view text) {
  constexpr std::string_view kPartial = "∂";
  std::size_t length = 0;
  while (length < text.size()) {
    const std::string_view rest = text.substr(length);
    if (rest.starts_with(kPartial)) {
      length += kPartial.size();
    } else if (is_letter(rest[0]) || is_digit(rest[0])) {
      ++length;
    } else {
      break;
    }
  }
  return length;
}

struct Symbol {
  std::string_view base, below, above;
  std::size_t length = 0;  ///< bytes of the text that it takes; 0: there is no symbol here
};

Symbol symbol_at(std::string_view text, std::size_t at) {
  const std::string_view rest = text.substr(at);
  const bool starts_word = at == 0 || !continues_word(text[at - 1]);
  if (!starts_word || rest.size() < 3 || !is_letter(rest[0]) || rest[1] != '_') return {};
  std::string_view below = rest.substr(2, subscript_length(rest.substr(2)));
  std::size_t end = 2 + below.size();
  std::string_view above;
  if (rest[0] == 'E' && below.size() > 1 && is_digit(below.back())) {
    above = below.substr(below.size() - 1);
    below.remove_suffix(1);
  } else if (end + 1 < rest.size() && rest[end] == '^' && is_digit(rest[end + 1])) {
    above = rest.substr(end + 1, 1);
    end += 2;
  }
  const bool is_name = end < rest.size() && continues_word(rest[end]);
  const std::size_t letters = below.starts_with("∂") ? below.size() - std::string_view("∂").size() : below.size();
  if (below.empty() || letters > kLongestSubscript || is_name) return {};
  return {rest.substr(0, 1), below, above, end};
}

void append_escaped(std::string& html, char c) {
  switch (c) {
    case '&':
      html += "&amp;";
      break;
    case '<':
      html += "&lt;";
      break;
    case '>':
      html += "&gt;";
      break;
    case '"':
      html += "&quot;";
      break;
    default:
      html += c;
  }
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string html;
  for (const char c : text) append_escaped(html, c);
  return html;
}

std::string prose(std::string_view text) {
  std::string html;
  for (std::size_t at = 0; at < text.size();) {
    const Symbol symbol = symbol_at(text, at);
    if (symbol.length == 0) {
      append_escaped(html, text[at++]);
      continue;
    }
    html.append("<i>").append(symbol.base).append("</i><sub>").append(symbol.below).append("</sub>");
    if (!symbol.above.empty()) html.append("<sup>").append(symbol.above).append("</sup>");
    at += symbol.length;
  }
  return html;
}

}  // namespace temper::gallery
