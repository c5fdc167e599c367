// Numbers from text, as std::from_chars reads them: the nearest double or float, no blanks, no plus, no hexadecimals.
//
// The build for browsers uses libc++ 19, whose from_chars reads no real numbers. There strtod of its C library reads
// them. It rounds correctly too, and the code here restricts it to the same texts.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <string_view>
#include <type_traits>
#include <version>

namespace temper {

/// Reads a real number by strtod, if from_chars cannot. It is a template, so that the tests can call it too.
template <class T>
std::from_chars_result read_by_strtod(const char* first, const char* last, T& value) {
  const std::string_view given(first, static_cast<std::size_t>(last - first));
  const std::size_t sign = given.starts_with('-') ? 1 : 0;
  const std::string_view start = given.substr(sign, 1);
  const bool is_word = !start.empty() && std::string_view("iInN").find(start) != std::string_view::npos;
  if (start.empty() || (!is_word && std::string_view("0123456789.").find(start) == std::string_view::npos))
    return {first, std::errc::invalid_argument};
  // strtod needs a zero at the end, and would read 0x10 as 16.
  const std::string text(given.substr(0, is_word ? given.size() : given.find_first_not_of("0123456789+-.eE", sign)));
  char* end = nullptr;
  T read{};
  if constexpr (std::is_same_v<T, float>) {
    read = std::strtof(text.c_str(), &end);
  } else {
    read = std::strtod(text.c_str(), &end);
  }
  const auto n = static_cast<std::size_t>(end - text.c_str());
  if (n == 0) return {first, std::errc::invalid_argument};
  const std::string_view digits = std::string_view(text).substr(0, std::min(n, text.find_first_of("eE")));
  const bool too_large = !is_word && std::isinf(read);
  const bool too_small = read == 0 && digits.find_first_of("123456789") != std::string_view::npos;
  if (too_large || too_small) return {first + n, std::errc::result_out_of_range};
  value = read;
  return {first + n, std::errc()};
}

/// Reads the number at the beginning of the text, and returns where it ends.
template <class T>
std::from_chars_result read_number(const char* first, const char* last, T& value) {
#ifndef __cpp_lib_to_chars
  if constexpr (std::is_floating_point_v<T>) {
    return read_by_strtod(first, last, value);
  } else
#endif
  {
    return std::from_chars(first, last, value);
  }
}

}  // namespace temper
