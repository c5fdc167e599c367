// Text and numbers as XML wants them.
#pragma once

#include <string>
#include <string_view>

namespace temper {

/// Text for the content of an element: markup escaped, control characters dropped, bytes that are not UTF-8
/// replaced by U+FFFD, so that any title makes a valid document.
[[nodiscard]] std::string xml_text(std::string_view text);

/// A number with at most three digits after the point, without trailing zeros, never in scientific form.
[[nodiscard]] std::string short_number(double value);

}  // namespace temper
