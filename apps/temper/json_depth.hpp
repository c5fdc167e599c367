// The depth of JSON from anywhere, looked at before it is parsed: what prints or drops a value goes down into it, and a
// file must not decide how much of the stack that takes.
#pragma once

#include <cstddef>
#include <string_view>

namespace temper::app {

/// Deeper than whatever temper writes.
inline constexpr int kDeepestJson = 16;

/// Whether arrays and objects are nested more than kDeepestJson deep; brackets within strings do not count.
[[nodiscard]] inline bool is_too_deep(std::string_view json) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      if (++depth > kDeepestJson) return true;
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return false;
}

}  // namespace temper::app
