// Numbers as text for error messages, without iostream or std::format.
#pragma once

#include <charconv>
#include <cstddef>
#include <string>

#include "temper/detail/vec.hpp"

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

/// "1 vertex" or "3 vertices"
inline std::string count_of(std::size_t n, const char* one, const char* many) {
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

/// "3 points"
inline std::string quantity(std::size_t n, const std::string& what) { return std::to_string(n) + " " + what; }

inline std::string coordinates(Vec2 p) { return "(" + to_text(p.x) + ", " + to_text(p.y) + ")"; }
inline std::string coordinates(Vec3 p) { return "(" + to_text(p.x) + ", " + to_text(p.y) + ", " + to_text(p.z) + ")"; }

/// The number in the name of an element: "12" of "point 12".
inline std::string last_word(const std::string& name) { return name.substr(name.rfind(' ') + 1); }

}  // namespace temper
