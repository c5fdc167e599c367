// Rules for data, and what both kinds of meshes share.
#include "io/conversion/data_update.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "io/conversion/known_arrays.hpp"
#include "io/conversion/update.hpp"
#include "io/text/failure.hpp"
#include "io/text/file_names.hpp"

namespace temper::io {

bool is_flag(const DataArray& a) { return a.name == kCorner || a.name == kRequired; }

std::vector<std::int32_t> required_points(const std::vector<DataArray>& point_data) {
  const DataArray* const required = find(point_data, kRequired);
  const auto* const flags = required == nullptr ? nullptr : std::get_if<std::vector<std::uint8_t>>(&required->values);
  std::vector<std::int32_t> points;
  for (std::size_t p = 0; flags != nullptr && p < flags->size(); ++p) {
    if ((*flags)[p] != 0) points.push_back(static_cast<std::int32_t>(p));
  }
  return points;
}

void take_rows(std::vector<DataArray>& arrays, const std::vector<std::size_t>& indices) {
  RunLength rows;
  for (const std::size_t i : indices) rows.push_back(static_cast<std::int64_t>(i));
  for (DataArray& a : arrays) a.values = gather(a.values, a.components, rows);
}

std::optional<std::string> warning_of_dropped(const std::vector<std::string>& names, std::string_view why) {
  std::string all;
  for (const std::string& name : names) all += text(all.empty() ? "" : ", ", name);
  if (all.empty()) return {};
  return text("data are dropped, because ", why, ": ", all);
}

bool is_weighted(const MeshFile& file) {
  return std::ranges::any_of(file.weights, [](double w) { return w != 0; });
}

void drop_zero_weights(MeshFile& file) {
  if (!is_weighted(file)) std::vector<double>().swap(file.weights);
}

namespace {

InputError wrong_rule(std::string message) { return {ErrorCode::invalid_option, {}, std::move(message)}; }

std::optional<DataRule> rule_named(std::string_view name) {
  if (name == "interpolate") return DataRule::interpolate;
  if (name == "keep") return DataRule::keep;
  return {};
}

std::string names_of(const std::vector<DataArray>& arrays) {
  std::string names;
  for (const DataArray& a : arrays) names += text(names.empty() ? "" : ", ", a.name);
  return names.empty() ? "none" : names;
}

}  // namespace

DataRule DataRules::of(const DataArray& array) const {
  if (!is_floating(array.values)) return DataRule::keep;
  const auto found = exceptions.find(array.name);
  return found == exceptions.end() ? rule : found->second;
}

Expected<DataRules> parse_data_rules(std::span<const std::string> words) {
  DataRules rules;
  std::optional<DataRule> of_all;
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    const std::optional<DataRule> rule = rule_named(std::string_view(word).substr(0, equals));
    if (!rule || equals + 1 == word.size()) {
      return wrong_rule(text("'", word, "' is not interpolate, keep, interpolate=NAME or keep=NAME"));
    }
    const bool contradicts = equals == std::string::npos
                                 ? of_all.value_or(*rule) != *rule
                                 : rules.exceptions.emplace(word.substr(equals + 1), *rule).first->second != *rule;
    if (contradicts) return wrong_rule(text("'", word, "' contradicts what was said before it"));
    if (equals == std::string::npos) of_all = rule;
  }
  rules.rule = of_all.value_or(DataRule::interpolate);
  return rules;
}

Expected<void> check_data_rules(const DataRules& rules, const std::vector<DataArray>& point_data) {
  for (const auto& [name, rule] : rules.exceptions) {
    const DataArray* array = find(point_data, name);
    if (array == nullptr)
      return wrong_rule(text("there is no point data '", name, "'; there are: ", names_of(point_data)));
    if (rule == DataRule::interpolate && !is_floating(array->values)) {
      return wrong_rule(text("point data '", name, "' are integers (", type_name(array->values),
                             "), which stay with their points: only floating point data are interpolated"));
    }
  }
  return {};
}

}  // namespace temper::io
