#include "files/size_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string_view>
#include <utility>

#include "console.hpp"
#include "exit.hpp"
#include "options/options.hpp"
#include "temper/detail/suggest.hpp"

namespace temper::app {
namespace {

/// A name of depths or heights of the bottom, and the direction in which its numbers grow.
struct DepthName {
  std::string_view name;
  bool positive_up;
};
constexpr DepthName kDepthNames[] = {{"depth", false},    {"deptho", false}, {"dp", false},      {"h", false},
                                     {"elevation", true}, {"z", true},       {"topo", true},     {"altitude", true},
                                     {"bed_level", true}, {"Band1", true},   {"band_data", true}};

const DepthName* depth_name(const std::string& name) {
  const auto* const row = std::ranges::find(kDepthNames, name, &DepthName::name);
  return row != std::end(kDepthNames) ? row : nullptr;
}

/// The data of that name. Without a name: `size`, or with depths one of their names, or the only data there are.
const io::DataArray& find_data(const Input& input, const std::string& name, bool depths) {
  std::string others;
  const io::DataArray* only = nullptr;
  const io::DataArray* usual = nullptr;
  std::size_t n = 0;
  for (const io::DataArray& array : input.file.point_data) {
    others += (others.empty() ? "" : ", ") + array.name;
    if (array.components != 1) {
      others += fmt::format(" ({} components)", array.components);
      continue;
    }
    if (array.name == name) return array;
    only = ++n == 1 ? &array : nullptr;
    if (usual == nullptr && (depths ? depth_name(array.name) != nullptr : array.name == "size")) usual = &array;
  }
  if (name.empty() && usual != nullptr) return *usual;
  if (name.empty() && only != nullptr) return *only;
  throw Failure(Exit::bad_input,
                fmt::format("{}: there is no point data {}of one component to take {} from; expected one of: {}. Next: "
                            "--size-data NAME",
                            input.path, name.empty() ? "" : fmt::format("\"{}\" ", name), depths ? "depths" : "sizes",
                            others.empty() ? "none in this file" : others));
}

std::vector<double> from_depths(const Input& input, const std::string& data, const DepthRule& rule,
                                std::vector<double> depths) {
  const DepthName* const known = depth_name(data);
  if (!rule.positive && known == nullptr) {
    throw Failure(Exit::bad_usage,
                  fmt::format("{}: the name \"{}\" does not say whether its numbers are depths or heights. Next: add "
                              "positive=down or positive=up to --from-depth",
                              input.path, data));
  }
  const bool is_up = rule.positive ? *rule.positive == io::Positive::up : known->positive_up;
  if (is_up) {
    for (double& depth : depths) depth = -depth;
  }
  if (std::ranges::none_of(depths, [](double depth) { return depth > 0; })) {
    throw Failure(Exit::bad_input,
                  fmt::format("{}: by the data \"{}\", no point is under water. Next: positive={} in --from-depth "
                              "reverses the sign",
                              input.path, data, is_up ? "down" : "up"));
  }
  return or_fail(sizes_from_depths(depths, rule.sizes));
}

struct DepthKey {
  std::string_view name;
  double DepthSizes::*number;
};
constexpr DepthKey kDepthKeys[] = {{"per_wavelength", &DepthSizes::per_wavelength},
                                   {"period", &DepthSizes::period},
                                   {"time_step", &DepthSizes::time_step},
                                   {"courant", &DepthSizes::courant},
                                   {"least", &DepthSizes::least},
                                   {"largest", &DepthSizes::largest}};

}  // namespace

DepthRule parse_depth_rule(const std::string& verb, const std::string& text) {
  DepthRule rule;
  const auto refuse = [&](const std::string& message) { refuse_usage(verb, "--from-depth: " + message); };
  for (const std::string& entry : separated(text)) {
    const std::size_t equals = std::min(entry.find('='), entry.size());
    const std::string key = entry.substr(0, equals), value = entry.substr(std::min(equals + 1, entry.size()));
    if (key == "positive") {
      if (value != "up" && value != "down")
        refuse(fmt::format("expected positive=up or positive=down, found '{}'", entry));
      rule.positive = value == "up" ? io::Positive::up : io::Positive::down;
      continue;
    }
    const auto* const known = std::ranges::find(kDepthKeys, key, &DepthKey::name);
    if (known == std::end(kDepthKeys)) {
      std::vector<std::string_view> names = {"positive"};
      for (const DepthKey& row : kDepthKeys) names.push_back(row.name);
      refuse(none_of(key, names));
    }
    const auto number = parse_number(value);
    if (!number) refuse(fmt::format("expected {}=NUMBER, found '{}'", key, entry));
    rule.sizes.*known->number = *number;
  }
  // The rules alone, before files are read.
  if (const auto tried = sizes_from_depths({}, rule.sizes); !tried) refuse(tried.error().message);
  return rule;
}

ReadSizeField read_size_field(const Input& input, const std::string& data, const std::optional<DepthRule>& depths) {
  const io::DataArray& array = find_data(input, data, depths.has_value());
  std::vector<double> sizes = at_vertices(input, array);
  if (depths) sizes = from_depths(input, array.name, *depths, std::move(sizes));
  const auto field = SizeField::from_values(input.mesh(), sizes, input.names.get());
  if (!field) {
    const bool names_file = !field.error().where.empty();
    throw Failure(Exit::bad_input, names_file ? field.error().what() : input.path + ": " + field.error().message);
  }
  return {*field, input.warnings()};
}

}  // namespace temper::app
