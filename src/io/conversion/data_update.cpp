// Rules for data, and what both kinds of meshes share.
#include "io/conversion/data_update.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <type_traits>
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

/// A rule, its name, and what it is for.
struct NamedRule {
  DataRule rule;
  std::string_view name;
  bool of_points, of_cells;
  [[nodiscard]] bool is_of(DataOf of) const { return of == DataOf::points ? of_points : of_cells; }
};
constexpr NamedRule kRules[] = {{DataRule::interpolate, "interpolate", true, false},
                                {DataRule::keep, "keep", true, false},
                                {DataRule::sample, "sample", false, true},
                                {DataRule::conserve, "conserve", true, true}};

std::optional<DataRule> rule_named(std::string_view name, DataOf of) {
  const auto named = std::ranges::find(kRules, name, &NamedRule::name);
  return named != std::end(kRules) && named->is_of(of) ? std::optional(named->rule) : std::nullopt;
}

std::string all_rules(DataOf of) {
  std::string all;
  for (const NamedRule& rule : kRules) {
    if (rule.is_of(of)) all += text(rule.name, ", ");
  }
  return all + "or one of these with =NAME";
}

std::string_view what_of(DataOf of) { return of == DataOf::points ? "point data" : "cell data"; }

/// The first row with a value that is not finite.
std::optional<std::size_t> first_not_finite(const DataArray& array) {
  return std::visit(
      [&](const auto& values) -> std::optional<std::size_t> {
        const auto found =
            std::ranges::find_if_not(values, [](auto x) { return std::isfinite(static_cast<double>(x)); });
        if (found == values.end()) return {};
        return static_cast<std::size_t>(found - values.begin()) / static_cast<std::size_t>(array.components);
      },
      array.values);
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

Expected<DataRules> parse_data_rules(std::span<const std::string> words, DataOf of) {
  DataRules rules;
  std::optional<DataRule> of_all;
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    const std::optional<DataRule> rule = rule_named(std::string_view(word).substr(0, equals), of);
    if (!rule || equals + 1 == word.size()) return wrong_rule(text("'", word, "' is not ", all_rules(of)));
    const bool contradicts = equals == std::string::npos
                                 ? of_all.value_or(*rule) != *rule
                                 : rules.exceptions.emplace(word.substr(equals + 1), *rule).first->second != *rule;
    if (contradicts) return wrong_rule(text("'", word, "' contradicts what was said before it"));
    if (equals == std::string::npos) of_all = rule;
  }
  rules.rule = of_all.value_or(of == DataOf::points ? DataRule::interpolate : DataRule::sample);
  return rules;
}

std::vector<std::string> data_rule_words(const DataRules& rules) {
  const auto name = [](DataRule rule) { return std::string(std::ranges::find(kRules, rule, &NamedRule::rule)->name); };
  std::vector<std::string> words = {name(rules.rule)};
  for (const auto& [array, rule] : rules.exceptions) words.push_back(text(name(rule), "=", array));
  return words;
}

Expected<void> check_data_rules(const DataRules& rules, const std::vector<DataArray>& arrays, DataOf of) {
  for (const auto& [name, rule] : rules.exceptions) {
    const DataArray* array = find(arrays, name);
    if (array == nullptr)
      return wrong_rule(text("there is no ", what_of(of), " '", name, "'; there are: ", names_of(arrays)));
    const bool is_number = is_floating(array->values);
    if (!is_number && rule == DataRule::interpolate) {
      return wrong_rule(text("point data '", name, "' are integers (", type_name(array->values),
                             "), which stay with their points: only floating point data are interpolated"));
    }
    if (rule != DataRule::conserve) continue;
    if (!is_number) {
      return wrong_rule(text(what_of(of), " '", name, "' are integers (", type_name(array->values),
                             "), of which there are no means: only floating point data are conserved"));
    }
    if (const std::optional<std::size_t> row = first_not_finite(*array)) {
      return wrong_rule(text(what_of(of), " '", name, "' have a value in row ", *row,
                             ", counted from 0, that is not finite, so they have no integral. Next: ",
                             of == DataOf::points ? "interpolate" : "sample", "=", name));
    }
  }
  return {};
}

bool is_conserved(const DataArray& array, const DataRules& rules) {
  return array.name != kCornerWeights && rules.of(array) == DataRule::conserve && !first_not_finite(array);
}

Values conserved_values(const DataArray& array, const CellOverlaps& overlaps, DataReport& report) {
  const auto n = static_cast<std::size_t>(array.components);
  return std::visit(
      [&](const auto& values) -> Values {
        std::remove_cvref_t<decltype(values)> result(n * overlaps.n_cells);
        std::vector<double> former(values.size() / n);
        for (std::size_t k = 0; k < n; ++k) {
          for (std::size_t i = 0; i < former.size(); ++i) former[i] = static_cast<double>(values[n * i + k]);
          const Conserved conserved = conserve(overlaps, former);
          for (std::size_t i = 0; i < overlaps.n_cells; ++i)
            result[n * i + k] = static_cast<ElementOf<decltype(values)>>(conserved.values[i]);
          report.integral_change = std::max(report.integral_change, conserved.change);
          report.out_of_range = std::max(report.out_of_range, conserved.beyond);
        }
        return result;
      },
      array.values);
}

}  // namespace temper::io
