#include "options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "console.hpp"
#include "help.hpp"

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

double checked_number(const std::string& name, const std::string& text, Interval allowed) {
  const std::optional<double> value = parse_number(text);
  if (!value) throw CLI::ValidationError(name, fmt::format("'{}' is not a number", text));
  if (!contains(allowed, *value)) {
    throw CLI::ValidationError(name, fmt::format("{} is out of range, it must be {}", text, range_text(allowed)));
  }
  return *value;
}

template <class T>
T checked_count(const std::string& name, const std::string& text, T least) {
  T value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range) throw CLI::ValidationError(name, fmt::format("{} is too large", text));
  if (error != std::errc() || end != text.data() + text.size()) {
    throw CLI::ValidationError(name, fmt::format("'{}' is not a whole number", text));
  }
  if (value < least) throw CLI::ValidationError(name, fmt::format("{} is out of range, it must be >= {}", text, least));
  return value;
}

/// "--gamma" of "-g,--gamma": how messages call an option.
std::string long_name(const std::string& names) {
  const std::size_t comma = names.rfind(',');
  return comma == std::string::npos ? names : names.substr(comma + 1);
}

CLI::Option* add_parsed(CLI::App& app, const std::string& name, const std::string& value_name,
                        const std::function<void(const std::string&)>& use, const std::string& description) {
  // CLI11 gives an option the word after it, whatever it is: `-o --quiet` would write a file named --quiet.
  const auto guarded = [name, use, &app](const std::string& text) {
    const std::string option = text.substr(0, text.find('='));
    if (option.size() > 1 && option[0] == '-' && app.get_option_no_throw(option) != nullptr) {
      throw CLI::ValidationError(long_name(name), fmt::format("needs a value, found the option {}", text));
    }
    use(text);
  };
  return app.add_option_function<std::string>(name, guarded, description)->type_name(value_name);
}

}  // namespace

CLI::Option* spell_default(CLI::Option* option, const std::function<std::string()>& spell) {
  return option->default_function(spell)->capture_default_str();
}

void spell_defaults_again(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) option->capture_default_str();
}

std::optional<double> parse_number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::vector<std::string> comma_separated(std::string_view list) {
  std::vector<std::string> words(1);
  for (const char c : list) {
    if (c == ',') {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  return words;
}

std::optional<std::vector<double>> parse_numbers(std::string_view text) {
  std::vector<double> values;
  for (const std::string& word : comma_separated(text)) {
    const std::optional<double> value = parse_number(word);
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  return values;
}

CLI::Option* add_number(CLI::App& app, const std::string& name, double& target, Interval allowed,
                        const std::string& description) {
  const auto use = [name, allowed, &target](const std::string& text) {
    target = checked_number(long_name(name), text, allowed);
  };
  return spell_default(add_parsed(app, name, "X", use, description), [&target] { return fmt::format("{}", target); });
}

CLI::Option* add_number(CLI::App& app, const std::string& name, std::optional<double>& target, Interval allowed,
                        const std::string& description) {
  const auto use = [name, allowed, &target](const std::string& text) {
    target = checked_number(long_name(name), text, allowed);
  };
  return add_parsed(app, name, "X", use, description);
}

CLI::Option* add_numbers(CLI::App& app, const std::string& name, const std::string& value_name, std::size_t count,
                         std::function<void(const std::vector<double>&)> use, const std::string& description) {
  const auto use_text = [name, value_name, count, use = std::move(use)](const std::string& text) {
    const std::optional<std::vector<double>> values = parse_numbers(text);
    const bool right = values && (count > 0 ? values->size() == count : values->size() % 2 == 0 && values->size() >= 6);
    if (!right) {
      throw CLI::ValidationError(
          long_name(name),
          fmt::format("'{}' is not a list of numbers {}, with commas and no spaces", text, value_name));
    }
    use(*values);
  };
  return add_parsed(app, name, value_name, use_text, description);
}

CLI::Option* add_count(CLI::App& app, const std::string& name, std::uint64_t& target, std::uint64_t least,
                       const std::string& description) {
  const auto use = [name, least, &target](const std::string& text) {
    target = checked_count(long_name(name), text, least);
  };
  return spell_default(add_parsed(app, name, "N", use, description), [&target] { return fmt::format("{}", target); });
}

CLI::Option* add_count(CLI::App& app, const std::string& name, int& target, int least, const std::string& description) {
  const auto use = [name, least, &target](const std::string& text) {
    target = checked_count(long_name(name), text, least);
  };
  return spell_default(add_parsed(app, name, "N", use, description), [&target] { return fmt::format("{}", target); });
}

CLI::Option* add_count(CLI::App& app, const std::string& name, std::optional<int>& target, int least,
                       const std::string& description) {
  const auto use = [name, least, &target](const std::string& text) {
    if (text == kNone) {
      target.reset();
    } else {
      target = checked_count(long_name(name), text, least);
    }
  };
  return spell_default(add_parsed(app, name, "N|" + std::string(kNone), use, description),
                       [&target] { return target ? fmt::format("{}", *target) : std::string(kNone); });
}

CLI::Option* add_text(CLI::App& app, const std::string& name, const std::string& value_name, std::string& target,
                      const std::string& description) {
  const auto use = [name, &target](const std::string& text) {
    if (text.empty()) throw CLI::ValidationError(long_name(name), "needs a value, found an empty one");
    target = text;
  };
  return add_parsed(app, name, value_name, use, description);
}

CLI::Option* add_name(CLI::App& app, const std::string& name, std::vector<std::string_view> names,
                      std::function<void(std::string_view)> use, const std::string& description) {
  const auto use_text = [name, names, use = std::move(use)](const std::string& text) {
    if (std::find(names.begin(), names.end(), text) == names.end()) {
      throw CLI::ValidationError(long_name(name), none_of(text, names));
    }
    use(text);
  };
  return add_parsed(app, name, join(names, "|"), use_text, description);
}

std::optional<Softening> SofteningOptions::value() const {
  if (absolute) return Softening{*absolute, LengthScale::absolute};
  if (relative) return Softening{*relative, LengthScale::relative};
  return std::nullopt;
}

void add_gamma(CLI::App& app, SofteningOptions& target, const std::string& default_text) {
  CLI::Option* absolute = add_number(app, "--gamma", target.absolute, kPositive,
                                     "gamma of E_BP, as a length in the units of the mesh" + default_text);
  CLI::Option* relative =
      add_number(app, "--gamma-rel", target.relative, kPositive, "gamma of E_BP, as a multiple of each edge's length");
  absolute->excludes(relative);
}

void add_h0(CLI::App& app, SofteningOptions& target, const std::string& default_text) {
  CLI::Option* absolute =
      add_number(app, "--h0", target.absolute, kNotNegative,
                 "how far below zero E_BHs lets h go (-h0 of the paper, so >= 0), as a length" + default_text);
  CLI::Option* relative =
      add_number(app, "--h0-rel", target.relative, kNotNegative, "the same, as a multiple of each edge's length");
  absolute->excludes(relative);
}

namespace {

std::vector<std::string_view> option_names(const CLI::App& app) {
  std::vector<std::string_view> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back(name);
  }
  return names;
}

std::string explain_extras(const CLI::App& app) {
  const std::vector<std::string> extras = app.remaining();
  if (extras.empty()) return "unexpected arguments";
  const std::string& word = extras.front();
  if (word.size() < 2 || word[0] != '-') return fmt::format("unexpected argument '{}'", word);
  const std::string name =
      word.substr(word.find_first_not_of('-') == std::string::npos ? 0 : word.find_first_not_of('-'));
  const std::string_view guess = nearest(name.substr(0, name.find('=')), option_names(app));
  return guess.empty() ? fmt::format("unknown option {}", word)
                       : fmt::format("unknown option {}; did you mean --{}?", word, guess);
}

}  // namespace

bool parse(CLI::App& app, const Arguments& arguments) {
  std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());  // CLI11 takes them from the back
  std::string message;
  try {
    app.parse(reversed);
    return true;
  } catch (const CLI::CallForHelp&) {
    print(help_text(app));
    return false;
  } catch (const CLI::ExtrasError&) {
    const std::vector<CLI::App*> inner = app.get_subcommands();
    message = explain_extras(inner.empty() || inner.front()->remaining_size() == 0 ? app : *inner.front());
  } catch (const CLI::ParseError& error) {
    message = error.what();
  }
  throw Failure(Exit::bad_usage, fmt::format("{0}: {1}\nSee temper {0} --help", app.get_name(), message));
}

std::vector<UsedOption> used_options(const CLI::App& app) {
  std::vector<UsedOption> used;
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_lnames().empty() || option == app.get_help_ptr()) continue;  // positionals
    UsedOption item;
    item.name = option->get_lnames().front();
    item.flag = option->get_items_expected_max() == 0;
    const std::string type = option->get_type_name();
    item.used = option->count() > 0 || !option->get_default_str().empty();
    if (!item.flag && item.used) {
      item.values = option->count() > 0 ? option->results() : std::vector<std::string>{option->get_default_str()};
    }
    const bool none = !item.values.empty() && item.values.front() == kNone;
    item.number = type == "X" || type == "N" || (type.starts_with("N|") && !none) ||
                  type.find_first_not_of("0123456789|") == std::string::npos;
    used.push_back(std::move(item));
  }
  return used;
}

std::string shell_quote(const std::string& word) {
  const std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+./,:=@%";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

std::string command_line(const std::string& verb, const std::vector<std::string>& positionals,
                         const std::vector<UsedOption>& options) {
  std::string text = "temper " + verb;
  for (const std::string& word : positionals) {
    text += " " + shell_quote(word.starts_with('-') ? "./" + word : word);  // not to be taken for an option
  }
  for (const UsedOption& option : options) {
    if (option.flag && option.used) text += " --" + option.name;
    for (const std::string& value : option.values) text += " --" + option.name + "=" + shell_quote(value);
  }
  return text;
}

}  // namespace temper::app
