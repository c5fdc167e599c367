// Instances of the challenge CG:SHOP 2025, if they are there: JSON with points, a polygon around them, and constraints.
#pragma once

#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "temper/mesh.hpp"

namespace temper::test {

struct Instance {
  std::vector<Vec2> points;
  std::vector<std::array<std::int32_t, 2>> segments;  ///< edges of the polygon, then the constraints
};

/// Returns the numbers of the array with this name, nested or not.
inline std::vector<double> numbers_of(const std::string& json, const std::string& name) {
  std::vector<double> numbers;
  std::size_t at = json.find("\"" + name + "\"");
  if (at == std::string::npos) return numbers;
  at = json.find('[', at);
  for (int depth = 0; at < json.size(); ++at) {
    if (json[at] == '[') ++depth;
    if (json[at] == ']' && --depth == 0) break;
    if (json[at] != '-' && (json[at] < '0' || json[at] > '9')) continue;
    char* end = nullptr;
    numbers.push_back(std::strtod(json.c_str() + at, &end));
    at = static_cast<std::size_t>(end - json.c_str()) - 1;
  }
  return numbers;
}

inline Instance read_instance(const std::filesystem::path& path) {
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  const std::string json = text.str();
  const auto x = numbers_of(json, "points_x"), y = numbers_of(json, "points_y");
  const auto around = numbers_of(json, "region_boundary"), lines = numbers_of(json, "additional_constraints");
  Instance instance;
  for (std::size_t i = 0; i < x.size(); ++i) instance.points.push_back({x[i], y[i]});
  const auto add = [&](double a, double b) {
    instance.segments.push_back({static_cast<std::int32_t>(a), static_cast<std::int32_t>(b)});
  };
  for (std::size_t i = 0; i < around.size(); ++i) add(around[i], around[(i + 1) % around.size()]);
  for (std::size_t i = 0; i + 1 < lines.size(); i += 2) add(lines[i], lines[i + 1]);
  return instance;
}

}  // namespace temper::test
