#include "options/table_options.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "temper/detail/suggest.hpp"

namespace temper::app {
namespace {

/// The word after a length that is no multiple of each edge's length.
constexpr std::string_view kAbsolute = ":absolute";

/// "time-limit" of "time_limit".
std::string in_flag(std::string_view name) {
  std::string flag(name);
  std::ranges::replace(flag, '_', '-');
  return flag;
}

/// "--time-limit" of a row with a flag.
std::string flag_of(const OptionRow& row) { return "--" + in_flag(row.name); }

std::string without_period(std::string text) {
  if (text.ends_with('.')) text.pop_back();
  return text;
}

OptionValue value_of(const OptionRow& row, const std::string& text) {
  if (row.optional && text == row.absent_name) return {};
  switch (row.kind) {
    case OptionKind::choice:
      expect_name(text, row.choices);
      return *std::ranges::find(row.choices, std::string_view(text));
    case OptionKind::number:
      return to_number(text, row.range);
    case OptionKind::length_parameter:
      return to_length_parameter(text, row.range);
    default:
      break;
  }
  const std::int64_t count = to_count(text, static_cast<std::int64_t>(row.range.low));
  if (static_cast<double>(count) > row.range.high) throw BadValue(text + " is too large");
  return count;
}

std::string value_name(const OptionRow& row) {
  std::string name;
  switch (row.kind) {
    case OptionKind::choice:
      for (const std::string_view choice : row.choices) name += (name.empty() ? "" : "|") + std::string(choice);
      break;
    case OptionKind::number:
      name = "X";
      break;
    case OptionKind::count:
      name = "N";
      break;
    case OptionKind::length_parameter:
      name = "X[" + std::string(kAbsolute) + "]";
      break;
    case OptionKind::vertex:
      name = "VERTEX";
      break;
  }
  return name + (row.optional ? "|" + std::string(row.absent_name) : "");
}

/// A text of the table in the list of --set: boundary=slide.
std::string in_list(std::string_view text) {
  return without_period(temper::spell_options(text, [](const OptionRow& row, std::string_view value) {
    return std::string(row.name) + (value.empty() ? "" : "=" + std::string(value));
  }));
}

std::string sentence_of(const OptionRow& row) {
  std::string sentence = in_list(row.sentence);
  if (row.kind == OptionKind::length_parameter)
    sentence += fmt::format(". X is a multiple of each edge's length, and X{} is a length", kAbsolute);
  if (row.kind == OptionKind::vertex) sentence += ". VERTEX is its number in the file";
  if (row.optional) sentence += fmt::format(". '{}': {}", row.absent_name, in_list(row.absent));
  return sentence + ".";
}

std::string default_of(const OptionRow& row) { return option_text(row, row.get(OptimizeOptions())); }

const OptionRow& row_of(std::string_view name, std::span<const std::string_view> names) {
  std::vector<std::string_view> known(names.begin(), names.end());
  if (names.empty()) {
    for (const OptionRow& row : option_rows()) known.push_back(row.name);
  }
  if (std::ranges::find(known, name) != known.end()) return *find_option(name);
  const std::string flag = name == "target" ? "--for" : "--" + in_flag(name);
  if (std::ranges::find(kFlagsOfARun, flag) != kFlagsOfARun.end())
    throw BadValue(fmt::format("there is no option '{}'; did you mean {}?", name, flag));
  const std::string_view guess = nearest(name, known);
  throw BadValue(
      fmt::format("there is no option '{}'{}", name,
                  guess.empty() ? "; --help-all lists the names" : fmt::format("; did you mean '{}'?", guess)));
}

}  // namespace

Assignment parse_assignment(std::string_view name, const std::string& text) {
  const OptionRow& row = row_of(name, {});
  if (row.kind == OptionKind::vertex) return {&row, {}, text};
  return {&row, value_of(row, text)};
}

Option& add_set(Command& command, Assignments& target, std::span<const std::string_view> names) {
  const auto take = [&target, names](const std::string& text) {
    for (const std::string& part : separated(text)) {
      const std::size_t equals = part.find('=');
      if (equals == std::string::npos) throw BadValue(fmt::format("expected NAME=VALUE, found '{}'", part));
      const std::string name = part.substr(0, equals);
      row_of(name, names);
      try {
        target.push_back(parse_assignment(name, part.substr(equals + 1)));
      } catch (const BadValue& bad) {
        throw BadValue(fmt::format("{}: {}", name, bad.what()));
      }
    }
  };
  return command.add({.names = "--set",
                      .value_name = "NAME=VALUE",
                      .sentence = "Set any option of the lists below. Several are separated by commas.",
                      .take = take,
                      .values = Values::repeated});
}

Option& add_flag_of(Command& command, std::string_view name, Assignments& target) {
  const OptionRow& row = *find_option(name);
  return command.add(
      {.names = flag_of(row),
       .value_name = value_name(row),
       .sentence = sentence_of(row),
       .take = [&target, name](const std::string& text) { target.push_back(parse_assignment(name, text)); },
       .spell = [&row] { return default_of(row); },
       .cells = row.cells});
}

std::vector<HelpPart> help_parts(bool research) {
  std::vector<HelpPart> parts;
  for (const OptionGroup& group : option_groups()) {
    HelpPart part = {std::string(group.title) + ", for --set"};
    for (const OptionRow& row : group.rows) {
      if (row.research != research) continue;
      std::string sentence = sentence_of(row);
      if (!row.optional) sentence += fmt::format(" (default: {})", default_of(row));
      part.rows.push_back({fmt::format("{}={}", row.name, value_name(row)), std::move(sentence)});
    }
    if (!part.rows.empty()) parts.push_back(std::move(part));
  }
  return parts;
}

void assign(const Assignments& assignments, OptimizeOptions& options) {
  for (const Assignment& a : assignments) {
    if (a.vertex.empty()) a.row->set(options, a.value);
  }
}

std::vector<std::string> idle_assignments(const Assignments& assignments, const OptimizeOptions& options,
                                          const OptimizeOptions& usual) {
  std::vector<std::string> warnings;
  for (const Assignment& a : assignments) {
    const std::string missing = missing_need(*a.row, options);
    if (missing.empty() || a.row->get(options) == a.row->get(usual)) continue;
    const std::string name =
        spell_options(fmt::format("`{}={}`", a.row->name, option_text(*a.row, a.row->get(options))));
    warnings.push_back(name + " has no effect without " + spell_options(missing));
  }
  return warnings;
}

std::string differences(const OptimizeOptions& a, const OptimizeOptions& b) {
  std::string text;
  for (const OptionRow& row : option_rows()) {
    if (row.get(a) == row.get(b)) continue;
    text += fmt::format("{}{}={}", text.empty() ? "" : ", ", row.name, option_text(row, row.get(a)));
  }
  return text;
}

InputError spell_options(InputError error) {
  error.message = spell_options(error.message);
  return error;
}

std::string spell_options(std::string_view text) {
  return temper::spell_options(text, [](const OptionRow& row, std::string_view value) {
    if (row.common) return flag_of(row) + (value.empty() ? "" : " " + std::string(value));
    return value.empty() ? std::string(row.name) : fmt::format("--set {}={}", row.name, value);
  });
}

}  // namespace temper::app
