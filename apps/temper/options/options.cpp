#include "options/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "temper/detail/suggest.hpp"
#include "threads.hpp"

namespace temper::app {
namespace {

std::string range_text(Interval allowed) {
  const bool low = std::isfinite(allowed.low), high = std::isfinite(allowed.high);
  if (low && high) {
    return allowed.open ? fmt::format("between {} and {}, without the ends", allowed.low, allowed.high)
                        : fmt::format("between {} and {}", allowed.low, allowed.high);
  }
  return low ? fmt::format("{} {}", allowed.open ? ">" : ">=", allowed.low) : "finite";
}

bool contains(Interval allowed, double value) {
  return allowed.open ? value > allowed.low && value < allowed.high : value >= allowed.low && value <= allowed.high;
}

template <class T>
Option& add_counted(Command& command, const std::string& name, T& target, T least, const std::string& description) {
  const auto take = [least, &target](const std::string& text) { target = to_count(text, least); };
  const auto spell = [&target] { return fmt::format("{}", target); };
  return command.add({.names = name, .value_name = "N", .sentence = description, .take = take, .spell = spell});
}

}  // namespace

std::string without_unit(const std::string& text) {
  const std::size_t end = text.find_last_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ°% ") + 1;
  if (end == 0 || end == text.size() || !parse_number(text.substr(0, end))) return {};
  return ": numbers have no unit. Next: the number alone. Lengths are in the unit of the coordinates, or in meters "
         "with "
         "--projection, and times are in seconds";
}

double to_number(const std::string& text, Interval allowed) {
  const std::optional<double> value = parse_number(text);
  if (!value) throw BadValue(fmt::format("'{}' is not a number{}", text, without_unit(text)));
  if (!contains(allowed, *value)) {
    throw BadValue(fmt::format("{} is out of range, it must be {}", text, range_text(allowed)));
  }
  return *value;
}

template <class T>
T to_count(const std::string& text, T least) {
  T value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range) throw BadValue(fmt::format("{} is too large", text));
  if (error != std::errc() || end != text.data() + text.size()) {
    throw BadValue(fmt::format("'{}' is not a whole number", text));
  }
  if (value < least) throw BadValue(fmt::format("{} is out of range, it must be >= {}", text, least));
  return value;
}
template int to_count(const std::string& text, int least);
template std::int64_t to_count(const std::string& text, std::int64_t least);
template std::uint64_t to_count(const std::string& text, std::uint64_t least);

void expect_name(const std::string& text, std::span<const std::string_view> names) {
  if (std::find(names.begin(), names.end(), text) == names.end()) throw BadValue(none_of(text, names));
}

std::optional<double> parse_number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<std::vector<double>> parse_numbers(std::string_view text) {
  std::vector<double> values;
  for (const std::string& word : separated(text)) {
    const std::optional<double> value = parse_number(word);
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  return values;
}

Option& add_number(Command& command, const std::string& name, double& target, Interval allowed,
                   const std::string& description) {
  const auto take = [allowed, &target](const std::string& text) { target = to_number(text, allowed); };
  const auto spell = [&target] { return fmt::format("{}", target); };
  return command.add({.names = name, .value_name = "X", .sentence = description, .take = take, .spell = spell});
}

Option& add_number(Command& command, const std::string& name, std::optional<double>& target, Interval allowed,
                   const std::string& description) {
  const auto take = [allowed, &target](const std::string& text) { target = to_number(text, allowed); };
  return command.add({.names = name, .value_name = "X", .sentence = description, .take = take});
}

Option& add_numbers(Command& command, const std::string& name, const std::string& value_name, std::size_t count,
                    std::function<void(const std::vector<double>&)> use, const std::string& description) {
  const auto take = [value_name, count, use = std::move(use)](const std::string& text) {
    const std::optional<std::vector<double>> values = parse_numbers(text);
    const bool right = values && (count > 0 ? values->size() == count : values->size() % 2 == 0 && values->size() >= 6);
    if (!right) {
      throw BadValue(fmt::format("'{}' is not a list of numbers {}, with commas and no spaces", text, value_name));
    }
    use(*values);
  };
  return command.add({.names = name, .value_name = value_name, .sentence = description, .take = take});
}

Option& add_count(Command& command, const std::string& name, std::uint64_t& target, std::uint64_t least,
                  const std::string& description) {
  return add_counted(command, name, target, least, description);
}

Option& add_count(Command& command, const std::string& name, int& target, int least, const std::string& description) {
  return add_counted(command, name, target, least, description);
}

Option& add_count(Command& command, const std::string& name, std::optional<int>& target, int least,
                  const std::string& description) {
  const auto take = [least, &target](const std::string& text) {
    target = text == kNone ? std::nullopt : std::optional(to_count(text, least));
  };
  const auto spell = [&target] { return target ? fmt::format("{}", *target) : std::string(kNone); };
  const std::string value_name = "N|" + std::string(kNone);
  return command.add({.names = name, .value_name = value_name, .sentence = description, .take = take, .spell = spell});
}

Option& add_threads(Command& command, std::uint64_t& target, const std::string& sentence) {
  const auto take = [&target](const std::string& text) {
    target = to_count(text, std::uint64_t{0});
    if (target > most_threads())
      throw BadValue(
          fmt::format("{} is out of range, it must be <= {} on this machine: more threads than a few times "
                      "the processors only wait for each other. Next: leave it out",
                      text, most_threads()));
  };
  return command.add({.names = "--threads",
                      .value_name = "N",
                      .sentence = sentence + " The result does not depend on it.",
                      .take = take,
                      .spell = [&target] { return fmt::format("{}", target); }});
}

Option& add_text(Command& command, const std::string& name, const std::string& value_name, std::string& target,
                 const std::string& description) {
  const auto take = [&target](const std::string& text) {
    if (text.empty()) throw BadValue("needs a value, found an empty one");
    target = text;
  };
  return command.add({.names = name, .value_name = value_name, .sentence = description, .take = take});
}

Option& add_argument(Command& command, const std::string& name, std::string& target, const std::string& description) {
  const auto take = [&target, name, verb = command.name()](const std::string& text) {
    if (text.empty()) refuse_usage(verb, name + " is missing: expected the name of a file, found an empty one");
    target = text == "-" ? kStandardInput : text;
  };
  return command.add({.names = name, .value_name = "", .sentence = description, .take = take});
}

Option& add_texts(Command& command, const std::string& name, const std::string& value_name, Values values,
                  std::vector<std::string>& target, const std::string& description) {
  const auto take = [&target](const std::string& text) { target.push_back(text); };
  return command.add(
      {.names = name, .value_name = value_name, .sentence = description, .take = take, .values = values});
}

Option& add_name(Command& command, const std::string& name, std::vector<std::string_view> names,
                 std::function<void(std::string_view)> use, const std::string& description) {
  const auto take = [names, use = std::move(use)](const std::string& text) {
    expect_name(text, names);
    use(text);
  };
  return command.add({.names = name, .value_name = join(names, "|"), .sentence = description, .take = take});
}

LengthParameter to_length_parameter(const std::string& text, Interval allowed) {
  constexpr std::string_view kAbsolute = ":absolute";
  if (!text.ends_with(kAbsolute)) return {to_number(text, allowed), LengthScale::relative};
  return {to_number(text.substr(0, text.size() - kAbsolute.size()), allowed), LengthScale::absolute};
}

Option& add_length_parameter(Command& command, const std::string& name, std::optional<LengthParameter>& target,
                             Interval allowed, const std::string& description) {
  const auto take = [allowed, &target](const std::string& text) { target = to_length_parameter(text, allowed); };
  return command.add({.names = name, .value_name = "X[:absolute]", .sentence = description, .take = take});
}

std::string shell_quote(const std::string& word) {
  const std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+./,:=@%";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

std::string command_line(const std::string& verb, const std::string& path, const std::string& projection) {
  // A name with a dash must not be taken for an option.
  const std::string map = projection.empty() ? "" : " --projection=" + shell_quote(projection);
  return fmt::format("temper {} {}{}", verb, shell_quote(path.starts_with('-') ? "./" + path : path), map);
}

std::string command_line(const Command& command, const std::vector<std::string>& positionals) {
  std::string text = "temper " + command.name();
  for (const std::string& word : positionals) text += " " + shell_quote(word.starts_with('-') ? "./" + word : word);
  for (const Option& option : command.options()) {
    if (option.is_argument()) continue;
    const std::string name = " " + long_name(option.names);
    for (const std::string& value : option.given) text += name + (option.is_flag() ? "" : "=" + shell_quote(value));
  }
  return text;
}

void add_projection(Command& command, std::string& target) {
  add_text(command, "--projection", "KIND[:lon,lat]|sphere[:radius=R]|none", target,
           "Map from longitude and latitude to meters: stereographic, mercator or transverse-mercator about this "
           "center. Without a center, the middle of the points is used. The mesh that is written has degrees again. "
           "'sphere' makes a mesh of the sphere without a map, with radius 6371000 unless you give R. 'none' uses all "
           "coordinates as coordinates of a plane. A curved surface that is nearly a sphere around the origin gets its "
           "points on the sphere, by default of their own radius.")
      .cells = CellKinds::triangles;
}

void add_heights(Command& command, Heights& target) {
  command
      .add_flag("--flat", target.flat,
                "Take the mesh as one of the plane of x and y, with z as point data 'z': heights or depths, which "
                "follow the vertices. Formats with three coordinates get z back.")
      .cells = CellKinds::triangles;
  static constexpr Choice<io::Positive> kSigns[] = {{"up", io::Positive::up}, {"down", io::Positive::down}};
  const auto use = [&target](io::Positive sign) { target.positive = sign; };
  add_choice(
      command, "--positive", kSigns, use,
      "Sign of the bed in the input: 'up' for heights, 'down' for depths. Only z needs it, since other data have "
      "a name that tells. In 2DM, z is a height unless you say 'down'. The output gets the sign of its format.")
      .cells = CellKinds::triangles;
}

}  // namespace temper::app
