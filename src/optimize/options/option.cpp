// Functions for all rows of the table of options.
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/text.hpp"
#include "temper/detail/optimize_table.hpp"
#include "temper/detail/suggest.hpp"

namespace temper {
namespace {

std::optional<double> number_of(const OptionValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  if (const auto* real = std::get_if<double>(&value)) return *real;
  if (const auto* length_parameter = std::get_if<LengthParameter>(&value)) return length_parameter->value;
  return std::nullopt;
}

bool contains(const OptionRange& range, double x) {
  return std::isfinite(x) && (range.open ? x > range.low && x < range.high : x >= range.low && x <= range.high);
}

/// The first alternative of a value is none. The others follow the order of the kinds.
bool has_kind(const OptionValue& value, OptionKind kind) { return value.index() == 1 + static_cast<std::size_t>(kind); }
template <OptionKind kind>
using ValueOf = std::variant_alternative_t<1 + static_cast<std::size_t>(kind), OptionValue>;
static_assert(std::is_same_v<ValueOf<OptionKind::vertex>, VertexId>);

bool may_have(const OptionRow& row, const OptionValue& value) {
  if (std::holds_alternative<std::monostate>(value)) return row.optional;
  if (!has_kind(value, row.kind)) return false;
  if (const auto number = number_of(value)) return contains(row.range, *number);
  const auto* name = std::get_if<std::string_view>(&value);
  return name == nullptr || std::find(row.choices.begin(), row.choices.end(), *name) != row.choices.end();
}

/// Makes "a, b or c" from words between bars, or from a list.
template <class Words>
std::string list_of(const Words& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 < words.size() ? ", " : " or ";
    text += words[i];
  }
  return text;
}

std::vector<std::string_view> parts_of(std::string_view words, char at) {
  std::vector<std::string_view> list;
  for (std::size_t end = words.find(at); end != std::string_view::npos; end = words.find(at)) {
    list.push_back(words.substr(0, end));
    words.remove_prefix(end + 1);
  }
  list.push_back(words);
  return list;
}

bool holds(const OptionNeed& need, const OptimizeOptions& options) {
  if (need.holds != nullptr) return need.holds(options);
  const OptionRow* const row = find_option(need.option);
  const OptionValue value = row->get(options);
  if (need.values.empty()) return !std::holds_alternative<std::monostate>(value);
  for (const std::string_view wanted : parts_of(need.values, '|')) {
    if (option_text(*row, value) == wanted) return true;
  }
  return false;
}

}  // namespace

const OptionRow* find_option(std::string_view name) {
  for (const OptionRow& row : option_rows()) {
    if (row.name == name) return &row;
  }
  return nullptr;
}

std::string option_text(const OptionRow& row, const OptionValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return std::to_string(*whole);
  if (const auto* length = std::get_if<LengthParameter>(&value)) {
    return to_text(length->value) + (length->scale == LengthScale::absolute ? ":absolute" : "");
  }
  if (const auto number = number_of(value)) return to_text(*number);
  if (const auto* name = std::get_if<std::string_view>(&value)) return std::string(*name);
  if (const auto* vertex = std::get_if<VertexId>(&value)) return std::to_string(vertex->index);
  return std::string(row.absent_name);
}

std::string option_range_text(const OptionRow& row) {
  const auto bound = [&](const char* closed, const char* open, double at) {
    return std::isfinite(at) ? (row.range.open ? open : closed) + to_text(at) : std::string();
  };
  if (row.kind == OptionKind::choice) return list_of(row.choices);
  if (row.kind == OptionKind::vertex) return "a vertex";
  const std::string low = bound("at least ", "more than ", row.range.low);
  const bool any_count = row.kind == OptionKind::count;  // the largest int is no limit worth a word
  const std::string high = any_count ? "" : bound("at most ", "less than ", row.range.high);
  return low + (low.empty() || high.empty() ? "" : " and ") + high;
}

Expected<void> check_option(const OptionRow& row, const OptionValue& value) {
  const auto refused = [&](const std::string& expected) {
    return InputError{ErrorCode::invalid_option,
                      {},
                      "`" + std::string(row.name) + "` is " + option_text(row, value) + "; expected " + expected};
  };
  if (row.kind == OptionKind::count && number_of(value) > row.range.high) {
    return refused("at most " + to_text(row.range.high));
  }
  if (!may_have(row, value)) {
    const auto* word = std::get_if<std::string_view>(&value);
    return refused(option_range_text(row) + (row.optional ? ", or " + std::string(row.absent_name) : "") +
                   (word == nullptr ? "" : did_you_mean(*word, row.choices)));
  }
  return {};
}

std::string missing_need(const OptionRow& row, const OptimizeOptions& options) {
  for (const OptionNeed& need : row.needs) {
    if (need.option.empty() || holds(need, options)) continue;
    std::vector<std::string> wanted;
    for (const std::string_view value : parts_of(need.values, '|')) {
      wanted.push_back("`" + std::string(need.option) + (value.empty() ? "" : "=") + std::string(value) + "`");
    }
    return list_of(wanted);
  }
  return {};
}

std::string spell_options(std::string_view text, const OptionSpelling& spell) {
  std::string spelled;
  const std::vector<std::string_view> parts = parts_of(text, '`');
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::size_t equals = parts[i].find('=');
    const bool quoted = i % 2 == 1 && i + 1 < parts.size();
    const OptionRow* row = quoted ? find_option(parts[i].substr(0, equals)) : nullptr;
    if (row != nullptr) {
      spelled += spell(*row, equals == std::string_view::npos ? "" : parts[i].substr(equals + 1));
    } else if (quoted) {
      spelled += "`" + std::string(parts[i]) + "`";
    } else {
      spelled += parts[i];
    }
  }
  return spelled;
}

}  // namespace temper
