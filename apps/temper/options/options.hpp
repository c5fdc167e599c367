// The usual kinds of options: strict numbers, named choices, texts; and an echo of the used values.
//
// Every option has a value name ("X", "NAME", "newton|golden") and, when it has a default, spells it. Help, echo and
// report are made from these declarations, so that none of them can forget an option.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "help/command.hpp"
#include "temper/detail/cells.hpp"
#include "temper/detail/optimize_table.hpp"
#include "temper/energy.hpp"
#include "temper/io.hpp"

namespace temper::app {

using Interval = OptionRange;
inline constexpr Interval kAnyNumber = {};
inline constexpr Interval kPositive = {0, std::numeric_limits<double>::infinity(), true};
inline constexpr Interval kNotNegative = {0, std::numeric_limits<double>::infinity(), false};

/// The whole text as a finite number, or nothing.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);
/// Numbers separated by commas, or nothing.
[[nodiscard]] std::optional<std::vector<double>> parse_numbers(std::string_view text);

/// If the text is a number with a unit: the rest of a message that says to leave the unit out. Else empty.
[[nodiscard]] std::string without_unit(const std::string& text);

/// The value of a text, for rows that are made elsewhere, or BadValue.
[[nodiscard]] double to_number(const std::string& text, Interval allowed);
template <class T>  // int, std::int64_t or std::uint64_t
[[nodiscard]] T to_count(const std::string& text, T least);
/// BadValue, with a suggestion, when the text is none of the names.
void expect_name(const std::string& text, std::span<const std::string_view> names);

/// The word for no value, of an option that may have none.
inline constexpr std::string_view kNone = "none";

Option& add_number(Command& command, const std::string& name, double& target, Interval allowed,
                   const std::string& description);
/// A number without a default.
Option& add_number(Command& command, const std::string& name, std::optional<double>& target, Interval allowed,
                   const std::string& description);
/// A list "x,y,…" of `count` numbers (0: any even number of them, at least 6: a polygon).
Option& add_numbers(Command& command, const std::string& name, const std::string& value_name, std::size_t count,
                    std::function<void(const std::vector<double>&)> use, const std::string& description);

Option& add_count(Command& command, const std::string& name, std::uint64_t& target, std::uint64_t least,
                  const std::string& description);
Option& add_count(Command& command, const std::string& name, int& target, int least, const std::string& description);

/// A count, or "none".
Option& add_count(Command& command, const std::string& name, std::optional<int>& target, int least,
                  const std::string& description);

/// --threads: 0, or at most a few times the processors.
Option& add_threads(Command& command, std::uint64_t& target,
                    const std::string& sentence = "Number of threads. 0 uses all threads of the machine.");

Option& add_text(Command& command, const std::string& name, const std::string& value_name, std::string& target,
                 const std::string& description);

/// The paths for "-".
inline constexpr const char* kStandardInput = "/dev/stdin";
inline constexpr const char* kStandardOutput = "/dev/stdout";

/// An argument known by its place: `temper check IN`. "-": standard input.
Option& add_argument(Command& command, const std::string& name, std::string& target, const std::string& description);
/// An option, or such arguments, of any number of values.
Option& add_texts(Command& command, const std::string& name, const std::string& value_name, Values values,
                  std::vector<std::string>& target, const std::string& description);

/// One of the values of an enumeration, by name.
template <class T>
struct Choice {
  std::string_view name;
  T value;
  CellKinds cells = CellKinds::all;  ///< cells of the meshes that it is for
};

/// The choices of --cells.
inline constexpr Choice<CellsOf> kCellsOf[] = {{"power", CellsOf::vertices, CellKinds::triangles},
                                               {"triangles", CellsOf::triangles, CellKinds::triangles}};

Option& add_name(Command& command, const std::string& name, std::vector<std::string_view> names,
                 std::function<void(std::string_view)> use, const std::string& description);

template <class T, std::size_t n>
Option& add_choice(Command& command, const std::string& name, const Choice<T> (&choices)[n],
                   std::type_identity_t<std::function<void(T)>> use, const std::string& description) {
  std::vector<std::string_view> names;
  for (const Choice<T>& choice : choices) names.push_back(choice.name);
  const std::span<const Choice<T>> table(choices);
  const auto use_name = [table, use](std::string_view text) {
    for (const Choice<T>& choice : table) {
      if (choice.name == text) use(choice.value);
    }
  };
  Option& option = add_name(command, name, names, use_name, description);
  option.cells_of = [table](std::string_view text) {
    const auto chosen = std::ranges::find(table, text, &Choice<T>::name);
    return chosen == table.end() ? CellKinds::all : chosen->cells;
  };
  return option;
}

/// Sets a variable directly, whose value is the default.
template <class T, std::size_t n>
Option& add_choice(Command& command, const std::string& name, const Choice<T> (&choices)[n], T& target,
                   const std::string& description) {
  const std::span<const Choice<T>> table(choices);
  const auto spell = [table, &target] {
    for (const Choice<T>& choice : table) {
      if (choice.value == target) return std::string(choice.name);
    }
    return std::string();
  };
  const auto use = [&target](T value) { target = value; };
  return add_choice(command, name, choices, use, description).defaults_to(spell);
}

/// γ or h°: "0.1" is a multiple of each edge's length, "0.1:absolute" a length.
[[nodiscard]] LengthParameter to_length_parameter(const std::string& text, Interval allowed);
Option& add_length_parameter(Command& command, const std::string& name, std::optional<LengthParameter>& target,
                             Interval allowed, const std::string& description);

/// `temper VERB POSITIONALS --option=value …` with the options that were given, quoted for a POSIX shell.
[[nodiscard]] std::string command_line(const Command& command, const std::vector<std::string>& positionals);
/// `temper VERB PATH --projection=P`
[[nodiscard]] std::string command_line(const std::string& verb, const std::string& path, const std::string& projection);
[[nodiscard]] std::string shell_quote(const std::string& word);

/// --projection, of verbs that read a mesh in longitude and latitude (projection_option.hpp).
void add_projection(Command& command, std::string& target);
/// How the z or the bed of a mesh is read: --flat and --positive.
struct Heights {
  bool flat = false;
  std::optional<io::Positive> positive = {};

  [[nodiscard]] io::ReadOptions to_read(Executor* executor) const {
    return {.executor = executor, .flat = flat, .positive = positive};
  }
};
/// --flat and --positive, of verbs that read a mesh.
void add_heights(Command& command, Heights& target);

}  // namespace temper::app
