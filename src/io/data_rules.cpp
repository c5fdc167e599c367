// Which data are interpolated, as users say it.
#include <optional>
#include <string_view>
#include <utility>

#include "io/failure.hpp"
#include "io/values.hpp"
#include "temper/io.hpp"

namespace temper::io {
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

Expected<void> check_data_rules(const DataRules& rules, const MeshFile& file) {
  for (const auto& [name, rule] : rules.exceptions) {
    const DataArray* array = find(file.point_data, name);
    if (array == nullptr)
      return wrong_rule(text("there is no point data '", name, "'; there are: ", names_of(file.point_data)));
    if (rule == DataRule::interpolate && !is_floating(array->values)) {
      return wrong_rule(text("point data '", name, "' are integers (", type_name(array->values),
                             "), which stay with their points: only floating point data are interpolated"));
    }
  }
  return {};
}

}  // namespace temper::io
