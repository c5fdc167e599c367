// The table of gallery/readings.md: a row for each figure that runs the optimizer.
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

}  // namespace

std::string settings_markdown(std::span<const Result> results) {
  std::string text = "| figure | runs |", rule = "|-|-|";
  for (const std::string_view name : kOpen) {
    text += " `" + std::string(name) + "` |";
    rule += "-|";
  }
  text += "\n" + rule + "\n";
  for (const Result& result : results) {
    if (result.page.settings.runs > 0) text += row(result);
  }
  return text;
}

}  // namespace temper::gallery
