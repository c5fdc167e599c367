// Values of regions that a user gives by number or name, at the elements of a mesh.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "files/input.hpp"

namespace temper::app {

/// The tag of a region, or of lines (dimension 1), by its number or its name. Failure if it is neither.
[[nodiscard]] std::int32_t tag_of(const std::string& option, const std::string& word, int dimension,
                                  const std::string& path, const std::vector<io::PhysicalName>& all);
template <class Subject>
[[nodiscard]] std::int32_t tag_of(const std::string& option, const std::string& word, int dimension,
                                  const InputOf<Subject>& input) {
  return tag_of(option, word, dimension, input.path, input.file.names);
}

/// The value of the region of each element. Failure if a region of the mesh has no value, or a value no region.
template <class Value, class Subject>
[[nodiscard]] std::vector<Value> at_elements(const std::string& option, const std::map<std::int32_t, Value>& values,
                                             const InputOf<Subject>& input) {
  std::map<std::int32_t, std::size_t> elements;
  std::vector<Value> all;
  std::string missing;
  for (const auto t : elements_of(input.mesh())) {
    const std::int32_t region = input.mesh().region(t);
    const auto found = values.find(region);
    if (++elements[region] == 1 && found == values.end())
      missing += fmt::format("{}{}", missing.empty() ? "" : ", ", region);
    all.push_back(found == values.end() ? Value() : found->second);
  }
  if (!missing.empty()) {
    throw Failure(Exit::bad_usage, fmt::format("{}: {}: there is no value for region {}", input.path, option, missing));
  }
  for (const auto& [region, value] : values) {
    if (elements.count(region) == 0)
      throw Failure(Exit::bad_usage, fmt::format("{}: {}: the mesh has no region {}", input.path, option, region));
  }
  return all;
}

}  // namespace temper::app
