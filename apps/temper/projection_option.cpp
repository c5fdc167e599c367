#include "projection_option.hpp"

#include <fmt/format.h>

#include <string_view>

namespace temper::app {

void add_projection(Command& command, std::string& target) {
  add_text(command, "--projection", "KIND[:lon,lat]|none", target,
           "the map for points in longitude and latitude: stereographic, mercator or transverse-mercator about this "
           "center (default: the middle of the points), to metres; a mesh that is written has degrees again; none: "
           "coordinates are those of a plane, whatever they look like");
}

void expect_projection(const std::string& path, bool geographic, const std::string& projection, bool guessed) {
  if (!geographic || !projection.empty()) return;
  constexpr std::string_view kOption = "`projection`";
  std::string message = io::needs_projection(guessed);
  message.replace(message.find(kOption), kOption.size(), "--projection");
  throw Failure(Exit::bad_usage, fmt::format("{}: {}", path, message));
}

void take_to_map(io::MeshFile& file, const std::string& path, const std::string& projection) {
  expect_projection(path, file.geographic, projection, file.geographic_is_guessed);
  if (projection.empty()) return;
  or_fail(io::project(file, projection));
}

}  // namespace temper::app
