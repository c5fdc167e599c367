#include "draw/text.hpp"

#include <charconv>
#include <cmath>
#include <cstddef>

namespace temper {
namespace {

// Bytes of the UTF-8 sequence at the start of text; 0 when XML does not allow it.
std::size_t sequence_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t n = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : first >= 0xc2 ? 2 : 0;
  if (n == 0 || first > 0xf4 || text.size() < n) return 0;
  for (std::size_t i = 1; i < n; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
  }
  const bool overlong = (first == 0xe0 && byte(1) < 0xa0) || (first == 0xf0 && byte(1) < 0x90);
  const bool not_a_character = (first == 0xed && byte(1) >= 0xa0) || (first == 0xf4 && byte(1) >= 0x90) ||
                               (first == 0xef && byte(1) == 0xbf && byte(2) >= 0xbe);
  return overlong || not_a_character ? 0 : n;
}

}  // namespace

std::string xml_text(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t n = sequence_length(text);
    const char c = text.front();
    if (n == 0) {
      result += "\xef\xbf\xbd";
    } else if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else if (c == '>') {
      result += "&gt;";
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      if (c == '\t' || c == '\n') result += ' ';
    } else {
      result += text.substr(0, n);
    }
    text.remove_prefix(n == 0 ? 1 : n);
  }
  return result;
}

std::string short_number(double value) {
  char buffer[340];  // the largest double has 309 digits
  const auto result = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed, 3);
  std::string text(buffer, result.ptr);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

namespace {

constexpr double kScriptSize = 0.7;                     // font of raised and lowered parts
constexpr double kRaise = -0.38, kLower = 0.22;         // of the font size
constexpr double kLeastFixed = 1e-3, kMostFixed = 1e6;  // numbers outside get a power of ten

constexpr std::string_view kMinus = "\xe2\x88\x92";

// Calls piece(text, '_', '^' or 0) for each part of the markup.
template <class Piece>
void for_each_piece(std::string_view label, Piece&& piece) {
  std::size_t from = 0;
  for (std::size_t i = 0; i + 1 < label.size(); ++i) {
    if ((label[i] != '_' && label[i] != '^') || label[i + 1] != '{') continue;
    const std::size_t end = label.find('}', i);
    if (end == std::string_view::npos) break;
    if (i > from) piece(label.substr(from, i - from), '\0');
    piece(label.substr(i + 2, end - i - 2), label[i]);
    from = end + 1;
    i = end;
  }
  if (from < label.size()) piece(label.substr(from), '\0');
}

// Width of a letter relative to the font size.
double letter_width(char c) {
  if (std::string_view("iIjl.,:;'|! ").find(c) != std::string_view::npos) return 0.3;
  if (std::string_view("ftr()[]-/\"").find(c) != std::string_view::npos) return 0.36;
  if (std::string_view("mwMW%@").find(c) != std::string_view::npos) return 0.9;
  return c >= 'A' && c <= 'Z' ? 0.7 : 0.57;
}

std::string with_minus(std::string text) {
  if (text.starts_with('-')) text.replace(0, 1, kMinus);
  return text;
}

// At most four significant digits, without trailing zeros.
std::string significant(double value) {
  char buffer[64];
  const bool is_long = std::abs(value) >= 9999.5;  // four digits would need a power of ten
  const auto result = is_long ? std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed, 0)
                              : std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, 4);
  return {buffer, result.ptr};
}

}  // namespace

std::string rich_text(std::string_view label) {
  std::string svg;
  double back = 0;  // what returns to the baseline, in ems of the full size
  for_each_piece(label, [&](std::string_view text, char script) {
    const double shift = script == '_' ? kLower : script == '^' ? kRaise : 0;
    const double dy = back + shift;
    back = -shift;
    if (script == '\0' && dy == 0) {
      svg += xml_text(text);
      return;
    }
    // dy counts in ems of the element's own font.
    const double em = script == '\0' ? dy : dy / kScriptSize;
    svg += "<tspan dy=\"" + short_number(em) + "em\"";
    if (script != '\0') svg += " font-size=\"" + short_number(100 * kScriptSize) + "%\"";
    svg += ">" + xml_text(text) + "</tspan>";
  });
  return svg;
}

double text_width(std::string_view label, double font_size) {
  double width = 0;
  for_each_piece(label, [&](std::string_view text, char script) {
    double piece = 0;
    for (const char c : text) {
      const bool continues = (static_cast<unsigned char>(c) & 0xc0) == 0x80;  // within a UTF-8 sequence
      if (!continues) piece += static_cast<unsigned char>(c) < 0x80 ? letter_width(c) : 0.62;
    }
    width += script == '\0' ? piece : kScriptSize * piece;
  });
  return width * font_size;
}

std::string fixed_label(double value, int decimals) {
  char buffer[340];
  const auto result = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed, decimals);
  const std::string text(buffer, result.ptr);
  const bool zero = text.find_first_not_of("-0.") == std::string::npos;
  return with_minus(zero && text.starts_with('-') ? text.substr(1) : text);
}

std::string number_label(double value) {
  const double size = std::abs(value);
  if (value == 0 || (size >= kLeastFixed && size < kMostFixed)) return with_minus(significant(value));
  char buffer[64];
  const auto result = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::scientific, 2);
  std::string mantissa(buffer, result.ptr);
  const std::size_t e = mantissa.find('e');
  if (e == std::string::npos) return with_minus(mantissa);  // not finite
  std::string exponent = mantissa.substr(e + (mantissa[e + 1] == '+' ? 2 : 1));
  mantissa.resize(e);
  while (mantissa.back() == '0') mantissa.pop_back();
  if (mantissa.back() == '.') mantissa.pop_back();
  const bool negative = exponent.starts_with('-');
  exponent.erase(0, exponent.find_first_not_of("-0"));
  std::string power = "10^{" + (negative ? std::string(kMinus) : "") + exponent + "}";
  if (mantissa == "1") return power;
  if (mantissa == "-1") return std::string(kMinus) + power;
  return with_minus(mantissa) + "\xc2\xb7" + power;
}

std::string text_element(Vec2 at, std::string_view label, const TextLook& look) {
  std::string svg = "<text x=\"" + short_number(at.x) + "\" y=\"" + short_number(at.y) + "\"";
  if (std::string_view(look.anchor) != "start") svg += " text-anchor=\"" + std::string(look.anchor) + "\"";
  if (look.size != kPlotFont) svg += " font-size=\"" + short_number(look.size) + "\"";
  if (std::string_view(look.color) != kPlotInk) svg += " fill=\"" + std::string(look.color) + "\"";
  if (!look.more.empty()) svg += " " + look.more;
  return svg + ">" + rich_text(label) + "</text>\n";
}

// Spaces are kept: else they would be lost at either end of a <tspan>.
std::string picture_document(double width, double height, const std::string& body) {
  const std::string w = short_number(width), h = short_number(height);
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + w + "\" height=\"" + h + "\" viewBox=\"0 0 " + w + " " +
         h + "\" xml:space=\"preserve\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"" +
         short_number(kPlotFont) + "\" fill=\"" + kPlotInk + "\">\n<rect width=\"" + w + "\" height=\"" + h +
         "\" fill=\"#ffffff\"/>\n" + body + "</svg>\n";
}

}  // namespace temper
