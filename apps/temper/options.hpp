// Options of a verb: CLI11 with strict numbers, named choices, suggestions, and an echo of what was used.
//
// Every option has a value name ("X", "NAME", "newton|golden") and, when it has a default, spells it: help,
// echo and report are made from what is declared here, so that none of them can forget an option.
#pragma once

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "suggest.hpp"
#include "temper/energy.hpp"
#include "verbs.hpp"

namespace temper::app {

/// Which numbers an option takes.
struct Interval {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool open = false;  ///< the ends do not belong to it
};
inline constexpr Interval kAnyNumber = {};
inline constexpr Interval kPositive = {0, std::numeric_limits<double>::infinity(), true};
inline constexpr Interval kNotNegative = {0, std::numeric_limits<double>::infinity(), false};

/// The whole text as a finite number, or nothing.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);
/// The words between commas, empty ones included; at least one.
[[nodiscard]] std::vector<std::string> comma_separated(std::string_view list);
/// Numbers separated by commas, or nothing.
[[nodiscard]] std::optional<std::vector<double>> parse_numbers(std::string_view text);

/// The default of the option, spelled now, and again when a later option (--method) has changed it.
CLI::Option* spell_default(CLI::Option* option, const std::function<std::string()>& spell);
void spell_defaults_again(CLI::App& app);

/// How an option that may have no value is told so.
inline constexpr std::string_view kNone = "none";

CLI::Option* add_number(CLI::App& app, const std::string& name, double& target, Interval allowed,
                        const std::string& description);
/// The same, without a default.
CLI::Option* add_number(CLI::App& app, const std::string& name, std::optional<double>& target, Interval allowed,
                        const std::string& description);
/// A list "x,y,…" of `count` numbers (0: any even number of them, at least 6: a polygon).
CLI::Option* add_numbers(CLI::App& app, const std::string& name, const std::string& value_name, std::size_t count,
                         std::function<void(const std::vector<double>&)> use, const std::string& description);

CLI::Option* add_count(CLI::App& app, const std::string& name, std::uint64_t& target, std::uint64_t least,
                       const std::string& description);
CLI::Option* add_count(CLI::App& app, const std::string& name, int& target, int least, const std::string& description);

/// The same, or "none".
CLI::Option* add_count(CLI::App& app, const std::string& name, std::optional<int>& target, int least,
                       const std::string& description);

CLI::Option* add_text(CLI::App& app, const std::string& name, const std::string& value_name, std::string& target,
                      const std::string& description);

/// One of the values of an enumeration, by name.
template <class T>
struct Choice {
  std::string_view name;
  T value;
};

CLI::Option* add_name(CLI::App& app, const std::string& name, std::vector<std::string_view> names,
                      std::function<void(std::string_view)> use, const std::string& description);

template <class T, std::size_t n>
CLI::Option* add_choice(CLI::App& app, const std::string& name, const Choice<T> (&choices)[n],
                        std::type_identity_t<std::function<void(T)>> use, const std::string& description) {
  std::vector<std::string_view> names;
  for (const Choice<T>& choice : choices) names.push_back(choice.name);
  const std::span<const Choice<T>> table(choices);
  return add_name(
      app, name, names,
      [table, use](std::string_view text) {
        for (const Choice<T>& choice : table) {
          if (choice.name == text) use(choice.value);
        }
      },
      description);
}

/// The same, straight into a variable, whose value is the default.
template <class T, std::size_t n>
CLI::Option* add_choice(CLI::App& app, const std::string& name, const Choice<T> (&choices)[n], T& target,
                        const std::string& description) {
  const std::span<const Choice<T>> table(choices);
  const auto spell = [table, &target] {
    for (const Choice<T>& choice : table) {
      if (choice.value == target) return std::string(choice.name);
    }
    return std::string();
  };
  return spell_default(add_choice(
                           app, name, choices, [&target](T value) { target = value; }, description),
                       spell);
}

/// γ and h°: the same pair of options for optimize and check.
struct SofteningOptions {
  std::optional<double> absolute, relative;
  [[nodiscard]] std::optional<Softening> value() const;
};
void add_gamma(CLI::App& app, SofteningOptions& target, const std::string& default_text);
void add_h0(CLI::App& app, SofteningOptions& target, const std::string& default_text);

/// Reads the arguments. Nothing: help was asked for and printed. Bad usage becomes a Failure with a suggestion.
[[nodiscard]] bool parse(CLI::App& app, const Arguments& arguments);

/// One option as it was used: given on the command line, or its default.
struct UsedOption {
  std::string name;                 ///< without dashes
  std::vector<std::string> values;  ///< none for a flag
  bool flag = false;
  bool number = false;
  bool used = false;  ///< given, or has a default
};
[[nodiscard]] std::vector<UsedOption> used_options(const CLI::App& app);

/// `temper VERB POSITIONALS --option value …` with all used options, quoted for a POSIX shell.
[[nodiscard]] std::string command_line(const std::string& verb, const std::vector<std::string>& positionals,
                                       const std::vector<UsedOption>& options);
[[nodiscard]] std::string shell_quote(const std::string& word);

}  // namespace temper::app
