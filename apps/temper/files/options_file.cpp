#include "files/options_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "temper/detail/path.hpp"
#include "temper/detail/suggest.hpp"

namespace temper::app {
namespace {

using Json = nlohmann::ordered_json;

/// "size_data" of "--size-data".
std::string member_of(std::string_view flag) {
  std::string member(flag.substr(2));
  std::ranges::replace(member, '-', '_');
  return member;
}

[[noreturn]] void fail_at(const std::string& path, const std::string& message) {
  throw Failure(Exit::bad_input, fmt::format("{}: {}", path, message));
}

/// JSON itself takes the last of two values for a key: one of them would be lost.
Json::parser_callback_t expect_each_key_once(const std::string& path) {
  return
      [path, keys = std::vector<std::set<std::string>>()](int depth, Json::parse_event_t event, Json& parsed) mutable {
        const auto level = static_cast<std::size_t>(depth);
        if (event == Json::parse_event_t::object_start) {
          keys.resize(level + 2);
          keys.back().clear();
        } else if (event == Json::parse_event_t::key) {
          const auto name = parsed.get<std::string>();
          if (!keys.at(level).insert(name).second)
            fail_at(path, fmt::format("{} is given more than once; expected one value", name));
        }
        return true;
      };
}

Json parse(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path_of(path), error))
    fail_at(path, "is a directory; expected a JSON file with options");
  std::ifstream stream(path_of(path));
  if (!stream)
    fail_at(path, fmt::format("cannot be opened: {}; expected a JSON file with options", std::strerror(errno)));
  if (stream.peek() == '\0') fail_at(path, "is no text; expected a JSON file with options");
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  Json json;
  try {
    json = Json::parse(text, expect_each_key_once(path));
  } catch (const Json::parse_error& wrong) {
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(wrong.byte - 1), '\n');
    fail_at(fmt::format("{}:{}", path, line),
            "is no JSON; expected an object such as {\"for\": \"cell\", \"max_sweeps\": 20}");
  } catch (const Json::out_of_range&) {
    fail_at(path, "has a number that is too large");
  }
  const bool is_report = json.is_object() && json.contains("schema");
  if (is_report && json.contains("options")) json = Json(json["options"]);
  if (!json.is_object() || (is_report && json.contains("schema")))
    fail_at(path, "expected a JSON object with options, or a report of temper optimize");
  return json;
}

/// A value as the text that a flag takes; nothing: it is no text or number.
std::optional<std::string> text_of(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_integer()) return std::to_string(value.get<std::int64_t>());
  if (value.is_number()) return fmt::format("{}", value.get<double>());
  return std::nullopt;
}

/// The texts of a member: one, or those of a list.
std::vector<std::string> texts_of(const std::string& path, const std::string& member, const Json& value) {
  std::vector<std::string> texts;
  for (const Json& item : value.is_array() ? value : Json::array({value})) {
    std::optional<std::string> text = text_of(item);
    if (!text) fail_at(path, fmt::format("{} is {}; expected a text or a number", member, value.dump()));
    texts.push_back(*std::move(text));
  }
  return texts;
}

Assignment assignment_of(const std::string& path, const OptionRow& row, const Json& value) {
  if (value.is_null()) return parse_assignment(row.name, std::string(row.absent_name));
  return parse_assignment(row.name, texts_of(path, std::string(row.name), value).front());
}

Json value_of(const OptionRow& row, const OptionValue& value) {
  if (std::holds_alternative<std::monostate>(value)) return nullptr;
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return *whole;
  if (const auto* real = std::get_if<double>(&value)) return *real;
  return option_text(row, value);
}

}  // namespace

void read_options(Command& command, const std::string& path, Assignments& assignments) {
  Assignments read;
  std::vector<std::string> known;
  std::ranges::transform(kFlagsOfARun, std::back_inserter(known), member_of);
  const Json json = parse(path);
  for (const auto& [member, value] : json.items()) {
    try {
      const auto flag = std::ranges::find(known, member);
      if (flag == known.end()) {
        const OptionRow* const row = find_option(member);
        read.push_back(row != nullptr ? assignment_of(path, *row, value) : parse_assignment(member, ""));
        continue;
      }
      Option& option = command.option(kFlagsOfARun.at(static_cast<std::size_t>(flag - known.begin())));
      if (!option.given.empty() || value.is_null()) continue;
      for (const std::string& text : texts_of(path, member, value)) {
        option.take(text);
        option.given.push_back(text);
      }
    } catch (const BadValue& bad) {
      fail_at(path, fmt::format("{}: {}", member, bad.what()));
    }
  }
  assignments.insert(assignments.begin(), read.begin(), read.end());
}

std::string options_json(const Command& command, const Assignments& assignments) {
  Json json = Json::object();
  for (const Option& option : command.options()) {
    if (option.given.empty() || std::ranges::find(kFlagsOfARun, long_name(option.names)) == kFlagsOfARun.end())
      continue;
    const std::string member = member_of(long_name(option.names));
    if (option.values == Values::one) {
      json[member] = option.given.front();
    } else {
      json[member] = option.given;
    }
  }
  for (const Assignment& a : assignments) {
    json[std::string(a.row->name)] = a.vertex.empty() ? value_of(*a.row, a.value) : Json(a.vertex);
  }
  return json.dump();
}

std::string options_json(const OptimizeOptions& options, CellKinds cells) {
  Json json = Json::object();
  for (const OptionRow& row : option_rows()) {
    if (fits(row.cells, cells)) json[std::string(row.name)] = value_of(row, row.get(options));
  }
  return json.dump();
}

}  // namespace temper::app
