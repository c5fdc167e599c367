#include "options/table_options.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "suggest.hpp"

namespace temper::app {
namespace {

/// A flag that is a shorter form of an option.
struct Shorthand {
  std::string flag;
  std::string_view option, value;
  std::string sentence;
};

const Shorthand kShorthands[] = {
    {"--no-flips", "flips", "none", "Keep the connectivity."},
};

std::string with(char to, char from, std::string_view text) {
  std::string result(text);
  std::replace(result.begin(), result.end(), from, to);
  return result;
}
std::string dashed(std::string_view text) { return with('-', '_', text); }

/// The program has `for`, which is short; in C++, Python and JavaScript it is a keyword.
std::string name_of(const OptionRow& row) { return row.name == "target" ? "--for" : "--" + dashed(row.name); }

std::string relative_name(const OptionRow& row) { return name_of(row) + "-rel"; }

std::vector<std::string> names_of(const OptionRow& row) {
  std::vector<std::string> names = {name_of(row)};
  if (row.kind == OptionKind::length_parameter) names.push_back(relative_name(row));
  for (const Shorthand& s : kShorthands) {
    if (s.option == row.name) names.push_back(s.flag);
  }
  return names;
}

/// The library's name of a choice with this spelling.
std::string_view choice_of(const OptionRow& row, const std::string& text) {
  std::vector<std::string> names;
  for (const std::string_view choice : row.choices) names.push_back(dashed(choice));
  expect_name(text, std::vector<std::string_view>(names.begin(), names.end()));
  return row.choices[static_cast<std::size_t>(std::find(names.begin(), names.end(), text) - names.begin())];
}

OptionValue value_of(const OptionRow& row, const std::string& text) {
  if (row.optional && text == row.absent_name) return {};
  if (row.kind == OptionKind::choice) return choice_of(row, text);
  if (row.kind == OptionKind::number) return to_number(text, row.range);
  const std::int64_t count = to_count(text, static_cast<std::int64_t>(row.range.low));
  if (static_cast<double>(count) > row.range.high) throw BadValue(text + " is too large");
  return count;
}

std::string value_name(const OptionRow& row) {
  std::string name = row.kind == OptionKind::number ? "X" : row.kind == OptionKind::count ? "N" : "VERTEX";
  if (row.kind == OptionKind::choice) {
    name.clear();
    for (const std::string_view choice : row.choices) name += (name.empty() ? "" : "|") + dashed(choice);
  }
  return name + (row.optional ? "|" + std::string(row.absent_name) : "");
}

std::string without_period(std::string text) {
  if (text.ends_with('.')) text.pop_back();
  return text;
}

std::string sentence_of(const OptionRow& row) {
  std::string sentence = spell_options(row.sentence);
  if (!row.optional) return sentence;
  return fmt::format("{}. '{}': {}.", without_period(sentence), row.absent_name,
                     without_period(spell_options(row.absent)));
}

/// γ and h°: one option for a length, one for a multiple of each edge's.
void add_length_parameter(Command& command, const OptionRow& row, OptimizeOptions& target) {
  const auto add = [&](const std::string& name, LengthScale scale, const std::string& sentence) -> Option& {
    const auto take = [&row, &target, scale](const std::string& text) {
      row.set(target, LengthParameter{to_number(text, row.range), scale});
    };
    const auto spell = [&row, &target, scale] {
      const OptionValue value = row.get(target);
      const auto* length_parameter = std::get_if<LengthParameter>(&value);
      return length_parameter != nullptr && length_parameter->scale == scale ? option_text(row, value) : std::string();
    };
    return command.add(
        {.names = name, .value_name = "X", .sentence = sentence, .take = take, .spell = spell, .rare = !row.common});
  };
  add(name_of(row), LengthScale::absolute,
      fmt::format("{}, as a length in the units of the mesh. If you do not give it: {}.",
                  without_period(std::string(row.sentence)), without_period(std::string(row.absent))));
  add(relative_name(row), LengthScale::relative,
      fmt::format("As {}, but as a multiple of each edge's length.", name_of(row)))
      .excludes = name_of(row);
}

void add_row(Command& command, const OptionRow& row, TableOptions& target) {
  OptimizeOptions& options = target.options;
  if (row.kind == OptionKind::length_parameter) return add_length_parameter(command, row, options);
  Option option = {.names = name_of(row),
                   .value_name = value_name(row),
                   .sentence = sentence_of(row),
                   .take = {},
                   .rare = !row.common};
  if (row.kind == OptionKind::vertex) {
    option.take = [&row, &target](const std::string& text) { target.vertices[row.name] = text; };
    option.sentence = without_period(sentence_of(row)) + ". VERTEX is its number in the file.";
  } else {
    option.take = [&row, &options](const std::string& text) { row.set(options, value_of(row, text)); };
    option.spell = [&row, &options] {
      const OptionValue value = row.get(options);
      return std::holds_alternative<std::monostate>(value) ? std::string() : dashed(option_text(row, value));
    };
  }
  command.add(std::move(option));
}

void add_shorthands(Command& command, const OptionRow& row, OptimizeOptions& options) {
  std::string before;
  for (const Shorthand& s : kShorthands) {
    if (s.option != row.name) continue;
    const auto take = [&row, &options, &s](const std::string&) { row.set(options, s.value); };
    command.add({.names = s.flag, .value_name = "", .sentence = s.sentence, .take = take, .rare = true}).excludes =
        before;
    before = s.flag;
  }
}

}  // namespace

void add_option(Command& command, const OptionRow& row, TableOptions& target) {
  add_row(command, row, target);
  for (const std::string& name : names_of(row)) {
    Option& option = command.option(name);
    option.spell = {};
    option.default_text.clear();
    option.rare = false;
  }
}

bool was_given(const Command& command, const OptionRow& row) {
  const std::vector<std::string> names = names_of(row);
  return std::ranges::any_of(names, [&](const std::string& name) { return command.was_given(name); });
}

void add_group(Command& command, const OptionGroup& group, TableOptions& target) {
  command.group(std::string(group.title));
  for (const OptionRow& row : group.rows) {
    add_row(command, row, target);
    add_shorthands(command, row, target.options);
  }
}

void expect_no_contradictions(Command& command) {
  for (const Shorthand& s : kShorthands) {
    const std::string option = name_of(*find_option(s.option));
    if (!command.was_given(s.flag) || !command.was_given(option)) continue;
    const std::string& given = command.option(option).given.front();
    if (given == s.value) continue;
    refuse_usage(command.name(), fmt::format("{} contradicts {} {}", s.flag, option, given));
  }
}

std::vector<std::string> idle_options(const Command& command, const TableOptions& given, const OptimizeOptions& usual) {
  std::vector<std::string> warnings;
  for (const OptionGroup& group : temper::option_groups()) {
    for (const OptionRow& row : group.rows) {
      const std::string missing = missing_need(row, given.options);
      if (missing.empty() || row.get(given.options) == row.get(usual)) continue;
      for (const std::string& name : names_of(row)) {
        if (command.was_given(name)) warnings.push_back(name + " has no effect without " + spell_options(missing));
      }
    }
  }
  return warnings;
}

InputError spell_options(InputError error) {
  error.message = spell_options(error.message);
  return error;
}

std::string spell_options(std::string_view text) {
  return temper::spell_options(text, [](const OptionRow& row, std::string_view value) {
    return name_of(row) + (value.empty() ? "" : " " + dashed(value));
  });
}

}  // namespace temper::app
