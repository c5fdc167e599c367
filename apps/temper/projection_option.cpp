#include "projection_option.hpp"

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace temper::app {

std::string spell_projection(std::string message) {
  constexpr std::string_view kOption = "`projection`";
  const std::size_t at = message.find(kOption);
  return at == std::string::npos ? message : message.replace(at, kOption.size(), "--projection");
}

namespace {

[[noreturn]] void refuse_degrees(const std::string& path, std::string message) {
  throw Failure(Exit::bad_usage, fmt::format("{}: {}", path, spell_projection(std::move(message))));
}

}  // namespace

void expect_projection_of_outline(const std::string& path, bool geographic, const std::string& projection) {
  if (geographic && projection.empty()) refuse_degrees(path, io::needs_projection(false, "--sphere"));
}

void take_to_map(io::MeshFile& file, const std::string& path, const std::string& projection) {
  if (projection.empty()) {
    if (file.degrees() != nullptr) refuse_degrees(path, io::needs_projection(file.degrees()->is_guessed));
    return;
  }
  or_fail(io::project(file, projection));
}

}  // namespace temper::app
