// Text of pictures: numbers for people, labels with raised and lowered parts, and their width.
//
// The width is an estimate from the classes of letters of the usual sans-serif fonts, and rather too large than too
// small. So texts do not overlap, whichever font the viewer has.
#pragma once

#include <string>
#include <string_view>

#include "temper/detail/vec.hpp"

namespace temper {

/// Text for the content of an element, so that any title makes a valid document. Markup is escaped, control characters
/// are dropped, and bytes that are not UTF-8 become U+FFFD.
[[nodiscard]] std::string xml_text(std::string_view text);

/// A number with at most three digits after the point, without trailing zeros, never in scientific form.
[[nodiscard]] std::string short_number(double value);

inline constexpr double kPlotFont = 14;       // pixels: 6.5 pt when 480 pixels are printed 8 cm wide
inline constexpr double kPlotSmallFont = 12;  // levels and marks
inline constexpr const char* kPlotInk = "#222222";

/// Label markup as SVG: "E_{F}^{1}" lowers F and raises 1; the rest is text.
[[nodiscard]] std::string rich_text(std::string_view label);
/// Width of a label in pixels at that font size, without markup; never much too small.
[[nodiscard]] double text_width(std::string_view label, double font_size);

/// A number for people: four significant digits at most, a true minus sign, powers of ten raised (markup).
[[nodiscard]] std::string number_label(double value);
[[nodiscard]] std::string fixed_label(double value, int decimals);

struct TextLook {
  const char* anchor = "start";  ///< "start", "middle", "end"
  double size = kPlotFont;
  const char* color = kPlotInk;
  std::string more = {};  ///< further attributes
};

/// A <text> element at a point (pixels, y down) of its baseline.
[[nodiscard]] std::string text_element(Vec2 at, std::string_view label, const TextLook& look = {});

/// The <svg> element around a picture: size, font, white background.
[[nodiscard]] std::string picture_document(double width, double height, const std::string& body);

}  // namespace temper
