// The table of options: one row for each that a run may be given as a value. Range checks, the command line, what it
// echoes in reports and warns of, Python and the documentation loop over it, so that a new option is a field of
// OptimizeOptions or of one of its groups, and a row of src/optimize/options/table.cpp.
//
// In sentences, notes and errors an option stands in back quotes, `boundary` or `boundary=split`: a front end spells it
// as its users write it (spell_options).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "temper/detail/error.hpp"
#include "temper/optimize.hpp"

namespace temper {

enum class OptionKind { count, number, choice, length_parameter, vertex };

/// The value of any option. monostate: absent; text: the name of a choice.
using OptionValue = std::variant<std::monostate, std::int64_t, double, std::string_view, LengthParameter, VertexId>;

/// Numbers from low to high; open: without these two.
struct OptionRange {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool open = false;
};

/// Another option without which one has no effect.
struct OptionNeed {
  std::string_view option;  ///< its name; empty: nothing is needed
  std::string_view values;  ///< that it must have one of, "newton|alternating"; empty: any but none
  bool (*holds)(const OptimizeOptions&) = nullptr;  ///< where its value alone does not tell
};

struct OptionRow {
  std::string_view name = {};      ///< as in C++ and Python, but flat: accuracy.sweeps is accuracy_sweeps
  std::string_view sentence = {};  ///< what it does, in ASCII
  OptionKind kind = OptionKind::number;
  std::span<const std::string_view> choices = {};  ///< of OptionKind::choice
  OptionRange range = {};                          ///< of counts, numbers and length_parameters
  bool optional = false;                           ///< may be absent
  bool common = false;                             ///< one of the few that a first run may need
  std::string_view absent_name = "auto";           ///< how an absent value is written: "auto" is chosen by temper
  std::string_view absent = {};                    ///< what it stands for
  std::array<OptionNeed, 3> needs = {};
  OptionValue (*get)(const OptimizeOptions&) = nullptr;
  void (*set)(OptimizeOptions&, const OptionValue&) = nullptr;  ///< to a value that check_option() takes
};

struct OptionGroup {
  std::string_view title;
  std::span<const OptionRow> rows;
};

/// A set of options that a run may start from.
struct Method {
  std::string_view name;
  std::string_view sentence;
  OptimizeOptions (*options)();
};

/// The methods; the first is the default.
[[nodiscard]] std::span<const Method> methods();

/// The table.
[[nodiscard]] std::span<const OptionGroup> option_groups();
/// The row of that name, or null.
[[nodiscard]] const OptionRow* find_option(std::string_view name);

/// An error unless the value is one that the option may have.
[[nodiscard]] Expected<void> check_option(const OptionRow& row, const OptionValue& value);
/// The first option that has a value it may not have.
[[nodiscard]] Expected<void> check_options(const OptimizeOptions& options);

/// "4", "newton", "auto".
[[nodiscard]] std::string option_text(const OptionRow& row, const OptionValue& value);
/// What values it may have: "at least 2", "newton, golden or alternating".
[[nodiscard]] std::string option_range_text(const OptionRow& row);
/// What the options lack for this one to have an effect, as "`boundary=split`"; empty when it has one.
[[nodiscard]] std::string missing_need(const OptionRow& row, const OptimizeOptions& options);

/// How a front end calls an option, and a value of it; the value may be empty.
using OptionSpelling = std::function<std::string(const OptionRow& row, std::string_view value)>;
/// The text with each option that stands in back quotes as the front end calls it.
[[nodiscard]] std::string spell_options(std::string_view text, const OptionSpelling& spell);

}  // namespace temper
