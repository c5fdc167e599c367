#include "help/command.hpp"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <optional>
#include <utility>

#include "console.hpp"
#include "help/help.hpp"
#include "temper/detail/suggest.hpp"

namespace temper::app {
namespace {

constexpr std::string_view kHelpAll = "--help-all";
constexpr std::string_view kHelpPaper = "--help-paper";

}  // namespace

std::vector<std::string> separated(std::string_view list, char separator) {
  std::vector<std::string> words = {""};
  for (const char c : list) {
    if (c == separator) {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  return words;
}

std::string long_name(const std::string& names) { return separated(names).back(); }

Option& Option::require() {
  required = true;
  spell = nullptr;
  default_text.clear();
  return *this;
}

Option& Option::defaults_to(std::function<std::string()> function) {
  spell = std::move(function);
  default_text = spell();
  return *this;
}

/// Parser: CLI11, made for one command line.
class Command::Parser {
 public:
  explicit Parser(Command& command) : command_(command), app_(command.description_, command.name_) {
    declare(command, app_);
    app_.require_subcommand(0, 1);
    for (Command& inner : command.subcommands_) {
      CLI::App* added = app_.add_subcommand(inner.name_, inner.description_);
      declare(inner, *added);
      added->fallthrough();
    }
  }

  /// The form of help that was asked for; nothing: the arguments have been read.
  std::optional<HelpForm> read(const Arguments& arguments) {
    std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());  // CLI11 takes them from the back
    std::string message;
    try {
      app_.parse(reversed);
      return asked_;
    } catch (const CLI::CallForHelp&) {
      return HelpForm::first;
    } catch (const CLI::CallForAllHelp&) {
      return HelpForm::all;
    } catch (const CLI::ExtrasError&) {
      const std::vector<CLI::App*> inner = app_.get_subcommands();
      message = explain_extras(inner.empty() || inner.front()->remaining_size() == 0 ? app_ : *inner.front());
    } catch (const CLI::ArgumentMismatch& error) {
      const CLI::Option* const twice = given_twice();
      message = twice != nullptr ? twice->get_name() + " is given more than once" : explain_lack(error.what());
    } catch (const CLI::ExcludesError&) {
      message = explain_both();
    } catch (const CLI::ParseError& error) {
      message = error.what();
    }
    fail(message);
  }

  /// Writes the given values into the rows.
  void store(Command& command) const {
    store_given(command, app_);
    for (Command& inner : command.subcommands_) {
      const CLI::App* parsed = app_.get_subcommand(inner.name_);
      store_given(inner, *parsed);
      if (parsed->parsed()) command.chosen_ = &inner;
    }
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { refuse_usage(app_.get_name(), message); }

  void declare(const Command& command, CLI::App& app) {
    app.allow_windows_style_options(false);  // a path may begin with /
    app.set_help_flag();
    app.set_help_all_flag(std::string(kHelpAll));
    for (const Option& option : command.options_) declare(option, app);
    for (const Option& option : command.options_) {
      if (!option.excludes.empty()) app.get_option(long_name(option.names))->excludes(app.get_option(option.excludes));
    }
  }

  void declare(const Option& option, CLI::App& app) {
    if (option.is_help()) {
      if (option.names == kHelpPaper) {
        app.add_flag_callback(option.names, [this] { asked_ = HelpForm::paper; })->trigger_on_parse();
      } else if (option.names != kHelpAll) {
        app.set_help_flag(option.names);
      }
      return;
    }
    CLI::Option* declared = nullptr;
    if (option.is_flag()) {
      const auto use = [&option](std::int64_t n) { option.take(n > 0 ? "true" : "false"); };
      declared = app.add_flag_function(option.names, use);
    } else if (option.values == Values::one) {
      declared = app.add_option_function<std::string>(
          option.names, [this, &option, &app](const std::string& text) { use_value(option, text, app); });
    } else {
      const auto use = [this, &option, &app](const std::vector<std::string>& texts) {
        for (const std::string& text : texts) use_value(option, text, app);
      };
      declared = app.add_option_function<std::vector<std::string>>(option.names, use);
      declared->allow_extra_args(option.values == Values::words);
    }
    if (!option.value_name.empty()) declared->type_name(option.value_name);
    declared->required(option.required);
  }

  void use_value(const Option& option, const std::string& text, const CLI::App& app) {
    const std::string name = long_name(option.names);
    // CLI11 gives an option the word after it, even another option: `-o --quiet` would write a file named --quiet.
    const std::string word = text.substr(0, text.find('='));
    if (option.values == Values::one && word.size() > 1 && word[0] == '-' && app.get_option_no_throw(word) != nullptr)
      throw CLI::ValidationError(name, "needs a value, found the option " + text);
    try {
      option.take(text);
    } catch (const BadValue& bad) {
      throw CLI::ValidationError(name, bad.what());
    }
  }

  [[nodiscard]] const CLI::Option* given_twice() const {
    std::vector<const CLI::App*> apps = {&app_};
    for (const CLI::App* inner : app_.get_subcommands()) apps.push_back(inner);
    for (const CLI::App* app : apps) {
      for (const CLI::Option* option : app->get_options()) {
        if (option->get_items_expected_max() == 1 && option->results().size() > 1) return option;
      }
    }
    return nullptr;
  }

  /// Calls f(option, parsed) for each option of the verb and of the word that was chosen; until it says true.
  template <class F>
  void find_declared(F&& f) const {
    const auto look = [&](const Command& command, const CLI::App& app) {
      return std::ranges::any_of(command.options_, [&](const Option& option) {
        return !option.is_help() && f(option, *app.get_option(long_name(option.names)));
      });
    };
    if (look(command_, app_)) return;
    for (const Command& inner : command_.subcommands_) {
      if (look(inner, *app_.get_subcommand(inner.name_))) return;
    }
  }

  /// The parser's words begin with the option's name.
  [[nodiscard]] std::string explain_lack(const std::string& words) const {
    std::string message = words;
    find_declared([&](const Option& option, const CLI::Option&) {
      const bool found = words.starts_with(long_name(option.names) + ":");
      if (found) message = long_name(option.names) + " needs a value, " + option.value_name;
      return found;
    });
    return message;
  }

  [[nodiscard]] std::string explain_both() const {
    std::string message;
    find_declared([&](const Option& option, const CLI::Option& parsed) {
      const bool both = !option.excludes.empty() && parsed.count() > 0 && app_.count(option.excludes) > 0;
      if (both)
        message =
            option.excludes + " and " + long_name(option.names) + " cannot be given together. Next: leave one out";
      return both;
    });
    return message;
  }

  [[nodiscard]] std::string explain_extras(const CLI::App& app) const {
    const std::vector<std::string> extras = app.remaining();
    if (extras.empty()) return "unexpected arguments";
    const std::string& word = extras.front();
    if (word.size() < 2 || word[0] != '-') {
      const CLI::Option* const output = app.get_option_no_throw("-o");
      const bool lacks_output = output != nullptr && output->count() == 0;
      return "unexpected argument '" + word + "'" + (lacks_output ? "; did you mean -o " + word + "?" : "");
    }
    const std::size_t begin = word.find_first_not_of('-');
    const std::string name = word.substr(begin == std::string::npos ? 0 : begin);
    if (command_.help_.instead) {
      const std::string other = command_.help_.instead(name.substr(0, name.find('=')));
      if (!other.empty()) return "unknown option " + word + "; did you mean " + other + "?";
    }
    std::vector<std::string_view> known;
    for (const CLI::Option* option : app.get_options()) {
      for (const std::string& other : option->get_lnames()) known.push_back(other);
    }
    const std::string_view guess = nearest(name.substr(0, name.find('=')), known);
    return "unknown option " + word + (guess.empty() ? "" : "; did you mean --" + std::string(guess) + "?");
  }

  static void store_given(Command& command, const CLI::App& app) {
    for (Option& option : command.options_) {
      if (!option.is_help()) option.given = app.get_option(long_name(option.names))->results();
    }
  }

  const Command& command_;
  CLI::App app_;
  std::optional<HelpForm> asked_;
};

Command::Command(std::string name, std::string description)
    : name_(std::move(name)), description_(std::move(description)), group_("Options") {}

Option& Command::add(Option option) {
  option.group = group_;
  if (option.spell) option.default_text = option.spell();
  options_.push_back(std::move(option));
  return options_.back();
}

Option& Command::add_flag(std::string name, bool& target, std::string sentence) {
  const auto take = [&target](const std::string& text) { target = text == "true"; };
  return add({.names = std::move(name), .value_name = "", .sentence = std::move(sentence), .take = take});
}

void Command::add_help(VerbHelp help) {
  help_ = std::move(help);
  const auto add_form = [this](std::string_view names, std::string_view sentence) {
    add({.names = std::string(names), .value_name = "", .sentence = std::string(sentence), .take = nullptr});
  };
  add({.names = "--quiet",
       .value_name = "",
       .sentence = "Print warnings, errors and JSON only.",
       .take = [](const std::string& text) {
         if (text == "true") be_quiet();
       }});
  const bool in_two = std::ranges::any_of(options_, &Option::rare);
  const bool in_three = !help_.paper.empty();
  add_form("-h,--help", in_three ? "Print this text. --help-all prints all options, such as --details and --set, "
                                   "--help-paper the paper's switches."
                        : in_two ? "Print this text. --help-all prints all options."
                                 : "Print this text.");
  if (in_two) add_form(kHelpAll, "Print all options.");
  if (in_three) add_form(kHelpPaper, "Print the switches of the paper, for --set.");
  for (Option& option : options_) option.rare = option.rare || option.names == kHelpAll || option.names == kHelpPaper;
}

Command& Command::add_subcommand(std::string name, std::string description) {
  return subcommands_.emplace_back(std::move(name), std::move(description));
}

bool Command::parse(const Arguments& arguments) {
  if (print_other_help(arguments, this)) return false;
  Parser parser(*this);
  if (const std::optional<HelpForm> asked = parser.read(arguments)) {
    print(text_of(help_of(*this, *asked)));
    return false;
  }
  parser.store(*this);
  return true;
}

Option& Command::option(std::string_view name) { return options_[index_of(name)]; }

bool Command::was_given(std::string_view name) const { return !options_[index_of(name)].given.empty(); }

void Command::expect_for(CellKinds cells, const std::string& path) const {
  for (const Option& option : options_) {
    for (const std::string& text : option.given) {
      const bool by_value = fits(option.cells, cells) && option.cells_of;
      const CellKinds kinds = by_value ? option.cells_of(text) : option.cells;
      if (fits(kinds, cells)) continue;
      if (option.is_flag() && text == "false") continue;
      refuse_usage(name_,
                   fmt::format("{} has {}, and {}{} is for {} alone. Next: leave it out", path, name_of_mesh(cells),
                               long_name(option.names), by_value ? " " + text : "", temper::name(kinds)));
    }
  }
}

std::size_t Command::index_of(std::string_view name) const {
  const auto named = [name](const Option& option) {
    const std::vector<std::string> names = separated(option.names);
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  const auto found = std::find_if(options_.begin(), options_.end(), named);
  if (found == options_.end()) throw std::logic_error("no option " + std::string(name));
  return static_cast<std::size_t>(found - options_.begin());
}

}  // namespace temper::app
