// Numbers as text for error messages, without iostream or std::format.
#pragma once

#include <charconv>
#include <cstddef>
#include <string>

namespace temper {

/// Shortest decimal that reads back to the same double.
inline std::string to_text(double value) {
  char buffer[32];
  const auto result = std::to_chars(buffer, buffer + sizeof buffer, value);
  return {buffer, result.ptr};
}

/// "0.1234": rounded for people, to whom four digits are enough. Reports have the numbers in full.
inline std::string rounded(double value, int digits = 4) {
  char buffer[64];
  const auto result = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, digits);
  return {buffer, result.ptr};
}

}  // namespace temper
