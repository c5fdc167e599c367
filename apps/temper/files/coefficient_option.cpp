#include "files/coefficient_option.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <variant>

#include "options/options.hpp"
#include "suggest.hpp"

namespace temper::app {
namespace {

/// The data of triangles with this name.
std::vector<double> from_data(const Command& command, const std::string& name, const Input& input) {
  std::vector<std::string_view> names;
  for (const io::DataArray& array : input.file.cell_data) {
    if (array.components != 1) continue;
    if (array.name == name)
      return std::visit([](const auto& values) { return std::vector<double>(values.begin(), values.end()); },
                        array.values);
    names.push_back(array.name);
  }
  throw Failure(Exit::bad_usage,
                fmt::format("{}: {}: --coefficient: there are no data '{}' of triangles; {}. Next: give one of these, "
                            "or REGION=K,...",
                            command.name(), input.path, name,
                            names.empty() ? "the file has none of one number" : "there are " + join(names)));
}

/// The number of a region, by its number or its name.
std::int32_t region_of(const Command& command, const std::string& word, const Input& input) {
  std::vector<std::string_view> names;
  for (const io::PhysicalName& n : input.file.names) {
    if (n.dimension != 2) continue;
    if (n.name == word) return n.tag;
    names.push_back(n.name);
  }
  const auto number = parse_number(word);
  if (number && *number == static_cast<std::int32_t>(*number)) return static_cast<std::int32_t>(*number);
  refuse_usage(command.name(), fmt::format("--coefficient: expected the number or name of a region before '=', found "
                                           "'{}'{}",
                                           word, names.empty() ? "" : "; names are " + join(names)));
}

std::map<std::int32_t, double> values_of_regions(const Command& command, const std::string& text, const Input& input) {
  std::map<std::int32_t, double> values;
  for (const std::string& entry : separated(text)) {
    const std::size_t equals = entry.rfind('=');
    const auto value = equals == std::string::npos ? std::nullopt : parse_number(entry.substr(equals + 1));
    if (!value) {
      refuse_usage(command.name(), fmt::format("--coefficient: expected REGION=K, found '{}'", entry));
    }
    const std::int32_t region = region_of(command, entry.substr(0, equals), input);
    if (!values.emplace(region, *value).second) {
      refuse_usage(command.name(), fmt::format("--coefficient: region {} has two values", region));
    }
  }
  return values;
}

std::vector<double> from_regions(const Command& command, const std::string& text, const Input& input) {
  const std::map<std::int32_t, double> values = values_of_regions(command, text, input);
  std::map<std::int32_t, std::size_t> triangles;
  std::vector<double> coefficient;
  std::string missing;
  for (const TriangleId t : input.mesh().triangles()) {
    const std::int32_t region = input.mesh().region(t);
    const auto found = values.find(region);
    if (++triangles[region] == 1 && found == values.end())
      missing += fmt::format("{}{}", missing.empty() ? "" : ", ", region);
    coefficient.push_back(found == values.end() ? 0 : found->second);
  }
  if (!missing.empty()) {
    throw Failure(Exit::bad_usage, fmt::format("{}: {}: --coefficient: there is no value for region {}", command.name(),
                                               input.path, missing));
  }
  for (const auto& [region, value] : values) {
    if (triangles.count(region) != 0) continue;
    throw Failure(Exit::bad_usage,
                  fmt::format("{}: {}: --coefficient: the mesh has no region {}", command.name(), input.path, region));
  }
  return coefficient;
}

}  // namespace

void add_coefficient(Command& command, std::string& target) {
  add_text(command, "--coefficient", "NAME", target,
           "Coefficient K > 0 of -div(K grad u) on each triangle: the name of data of triangles. Or write a value for "
           "each region, by number or name: 1=1e-4,clay=1e-9.");
}

std::vector<double> read_coefficient(const Command& command, const std::string& text, const Input& input) {
  if (text.empty()) return {};
  return text.find('=') == std::string::npos ? from_data(command, text, input) : from_regions(command, text, input);
}

}  // namespace temper::app
