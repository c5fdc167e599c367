#include "help.hpp"

#include <fmt/format.h>

#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "console.hpp"
#include "verbs.hpp"

namespace temper::app {
namespace {

constexpr std::size_t kWidth = 100;       // of a line: fits half of a wide screen
constexpr std::size_t kNameColumns = 26;  // of option names; longer ones get a line to themselves

/// "-o, --output FILE"
std::string option_head(const CLI::Option& option) {
  if (option.get_snames().empty() && option.get_lnames().empty()) return option.get_name(true);
  std::string text;
  for (const std::string& name : option.get_snames()) text += (text.empty() ? "-" : ", -") + name;
  for (const std::string& name : option.get_lnames()) text += (text.empty() ? "--" : ", --") + name;
  const bool flag = option.get_items_expected_max() == 0;
  return flag ? text : text + " " + option.get_type_name();
}

std::string option_text(const CLI::Option& option) {
  const std::string head = option_head(option);
  std::string description = option.get_description();
  if (!option.get_default_str().empty()) description += fmt::format(" (default: {})", option.get_default_str());

  std::string text = "  " + head;
  const bool own_line = head.size() > kNameColumns;
  bool first = true;
  for (const std::string& line : wrap(description, kWidth - kNameColumns - 4)) {
    const bool beside = first && !own_line;
    text += beside ? std::string(kNameColumns + 2 - head.size(), ' ') : "\n" + std::string(kNameColumns + 4, ' ');
    text += line;
    first = false;
  }
  return text + "\n";
}

/// Options by group, in the order in which they were added.
std::string option_groups(const CLI::App& app) {
  std::vector<std::pair<std::string, std::string>> groups;
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;  // hidden
    const std::string title = option->nonpositional() ? option->get_group() : "Arguments";
    if (groups.empty() || groups.back().first != title) groups.emplace_back(title, "");
    groups.back().second += option_text(*option);
  }
  std::string text;
  for (const auto& [title, options] : groups) text += "\n" + title + ":\n" + options;
  return text;
}

std::string paragraph(const std::string& text) {
  std::string wrapped;
  for (const std::string& line : wrap(text, kWidth)) wrapped += line + "\n";
  return wrapped;
}

std::string_view meaning(Exit exit) {
  switch (exit) {
    case Exit::done:
      return "done";
    case Exit::bad_input:
      return "bad input, or an output that cannot be written; nothing was written but what the message names";
    case Exit::bad_usage:
      return "bad usage: options that make no sense";
    case Exit::requirement:
      return "what --require or --require-claims asks for is not met";
    case Exit::stopped_early:
      return "stopped early by a signal or --time-limit; the best mesh so far is written";
    case Exit::internal:
      return "out of memory, or an internal error: please report that";
    case Exit::infeasible:
      return "weights: there are none that do what was asked; nothing was written but the certificate";
  }
  return "";
}

std::string exit_lines(std::initializer_list<Exit> exits) {
  std::string text = "\nExit codes:\n";
  for (const Exit exit : exits) text += fmt::format("  {}  {}\n", static_cast<int>(exit), meaning(exit));
  return text;
}

class HelpFormatter : public CLI::Formatter {
 public:
  explicit HelpFormatter(const VerbHelp& help)
      : usage_(help.usage), footer_("\nExamples:\n" + help.examples + exit_lines(help.exits)) {}

  std::string make_help(const CLI::App* app, std::string, CLI::AppFormatMode) const override {
    std::string text = paragraph(app->get_description());
    text += fmt::format("\nUsage: temper {} {}\n", app->get_name(), usage_);
    text += option_groups(*app);
    for (const CLI::App* inner : app->get_subcommands([](const CLI::App*) { return true; })) {
      text += fmt::format("\n{}: {}\n", inner->get_name(), inner->get_description());
      for (const CLI::Option* option : inner->get_options()) text += option_text(*option);
    }
    return text + footer_;
  }

 private:
  std::string usage_, footer_;
};

}  // namespace

void set_help(CLI::App& app, const VerbHelp& help) { app.formatter(std::make_shared<HelpFormatter>(help)); }

std::string help_text(const CLI::App& app) {
  return app.get_formatter()->make_help(&app, "", CLI::AppFormatMode::Normal);
}

std::string short_help() {
  std::string text = "Usage: temper VERB ...\n\n";
  for (const Verb& verb : verbs()) text += fmt::format("  {:<11}{}\n", verb.name, verb.summary);
  return text + "\nSee temper --help and temper VERB --help.\n";
}

std::string full_help() {
  std::string text = "temper: primal-dual triangle meshes that solvers can trust\n\nUsage: temper VERB ...\n\nVerbs:\n";
  for (const Verb& verb : verbs()) text += fmt::format("  {:<11}{}\n", verb.name, verb.summary);
  text +=
      "\nOptions:\n"
      "  -h, --help                this text; temper VERB --help has the options and examples of a verb\n"
      "  --version                 the version\n"
      "\nExamples:\n"
      "  temper example horseshoe -o horseshoe.vtu\n"
      "  temper check horseshoe.vtu\n"
      "  temper optimize horseshoe.vtu -o tempered.vtu --draw before-after.svg\n";
  return text + exit_lines({Exit::done, Exit::bad_input, Exit::bad_usage, Exit::requirement, Exit::stopped_early,
                            Exit::internal, Exit::infeasible});
}

}  // namespace temper::app
