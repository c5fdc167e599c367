// Paths as temper has them, UTF-8 in std::string, and as std::filesystem has them. (On Windows the latter would take
// text for that of the code page.)
#pragma once

#include <filesystem>
#include <string>

namespace temper {

[[nodiscard]] inline std::filesystem::path path_of(const std::string& utf8) {
  return std::u8string(utf8.begin(), utf8.end());
}
[[nodiscard]] inline std::string utf8(const std::filesystem::path& path) {
  const std::u8string text = path.u8string();
  return {text.begin(), text.end()};
}

}  // namespace temper
