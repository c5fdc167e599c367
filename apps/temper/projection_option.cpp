#include "projection_option.hpp"

#include <fmt/format.h>

#include <string_view>

namespace temper::app {

std::string spell_projection(std::string message) {
  constexpr std::string_view kOption = "`projection`";
  const std::size_t at = message.find(kOption);
  return at == std::string::npos ? message : message.replace(at, kOption.size(), "--projection");
}

void expect_projection(const std::string& path, bool geographic, const std::string& projection, bool guessed) {
  if (!geographic || !projection.empty()) return;
  throw Failure(Exit::bad_usage, fmt::format("{}: {}", path, spell_projection(io::needs_projection(guessed))));
}

void take_to_map(io::MeshFile& file, const std::string& path, const std::string& projection) {
  expect_projection(path, file.geographic, projection, file.geographic_is_guessed);
  if (projection.empty()) return;
  or_fail(io::project(file, projection));
}

}  // namespace temper::app
