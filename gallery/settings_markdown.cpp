// The table of docs/explanation/paper.md with the settings of the figures: a row for each figure that runs the
// optimizer.
#include <string>

#include "reading.hpp"
#include "results.hpp"

namespace temper::gallery {
namespace {

std::string cell(const std::set<std::string>& values) {
  std::string text;
  for (const std::string& value : values) text += (text.empty() ? "" : ", ") + value;
  return text;
}

std::string row(const Result& result) {
  std::string text = "| " + std::to_string(result.figure.number) + " | " + std::to_string(result.page.settings.runs);
  for (const auto& values : result.page.settings.values) text += " | " + cell(values);
  return text + " |\n";
}

std::string dashed(std::string_view name) {
  std::string text(name);
  for (char& c : text) c = c == '_' ? '-' : c;
  return text;
}

}  // namespace

std::string settings_markdown(std::span<const Result> results) {
  std::string text = "| figure | runs |", rule = "|-|-|";
  for (const std::string_view name : kOpen) {
    text += " `--" + dashed(name) + "` |";
    rule += "-|";
  }
  text += "\n" + rule + "\n";
  for (const Result& result : results) {
    if (result.page.settings.runs > 0) text += row(result);
  }
  return text;
}

}  // namespace temper::gallery
