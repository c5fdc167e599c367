// Numbers inside the sentences of claims, the cells of tables, and drawings.
#pragma once

#include <cmath>
#include <cstdio>
#include <string>

namespace temper::gallery {

/// That many significant digits: "0.3333", "1.2e−7", "+∞".
[[nodiscard]] inline std::string digits(double value, int significant = 4) {
  if (std::isnan(value)) return "undefined";
  if (std::isinf(value)) return value > 0 ? "+∞" : "−∞";
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.*g", significant, value);
  std::string text = buffer;
  if (const std::size_t e = text.find('e'); e != std::string::npos) {  // "1e-05" → "1e−5"
    const std::string exponent = text.substr(text.find_first_not_of("+-0", e + 1));
    text = text.substr(0, e) + (text[e + 1] == '-' ? "e−" : "e") + exponent;
  }
  if (text.starts_with('-')) text.replace(0, 1, "−");
  return text;
}

/// For coordinates: hundredths of a pixel.
[[nodiscard]] inline std::string pixels(double value) {
  char buffer[48];
  std::snprintf(buffer, sizeof buffer, "%.2f", value);
  return buffer;
}

[[nodiscard]] inline std::string digits(std::size_t value) { return std::to_string(value); }

}  // namespace temper::gallery
