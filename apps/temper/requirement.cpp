#include "requirement.hpp"

#include <fmt/format.h>

#include <cmath>

#include "exit.hpp"
#include "options.hpp"
#include "suggest.hpp"

namespace temper::app {
namespace {

const Measure* find_measure(std::string_view key) {
  for (const Measure& measure : measures()) {
    if (key == measure.key || (!measure.alias.empty() && key == measure.alias)) return &measure;
  }
  return nullptr;
}

bool is_energy_key(std::string_view key) {
  for (const EnergyKey& energy : energy_keys()) {
    if (energy.key == key) return true;
  }
  return false;
}

[[noreturn]] void refuse(const std::string& message) {
  throw Failure(Exit::bad_usage, "check: --require: " + message + "\nSee temper check --help");
}

[[noreturn]] void refuse_key(std::string_view key) {
  std::vector<std::string_view> names;
  for (const Measure& measure : measures()) {
    if (!measure.alias.empty()) names.push_back(measure.alias);
    names.push_back(measure.key);
  }
  const std::string_view guess = nearest(key, names);
  refuse(fmt::format("unknown key '{}'{}; the keys are {}, and energy.NAME.STAR (energy.BP.1)", key,
                     guess.empty() ? "" : fmt::format(", did you mean '{}'?", guess), join(names)));
}

Requirement parse_requirement(std::string_view text) {
  const std::size_t at = text.find_first_of("<>=");
  if (at == std::string_view::npos) refuse(fmt::format("'{}' is not key=value", text));
  const std::string_view key = text.substr(0, at);
  const bool two = text.substr(at).size() > 1 && text[at + 1] == '=';
  if (!two && text[at] != '=') refuse(fmt::format("'{}': write <= or >=, the ends always belong", text));

  Requirement requirement;
  requirement.text = text;
  const Measure* measure = find_measure(key);
  if (measure == nullptr && !is_energy_key(key)) refuse_key(key);
  requirement.key = measure != nullptr ? measure->key : key;
  if (two) {
    requirement.better = text[at] == '<' ? Better::less : text[at] == '>' ? Better::larger : Better::equal;
  } else {
    requirement.better = measure != nullptr ? measure->better : Better::less;
  }
  const std::string_view value = text.substr(at + (two ? 2 : 1));
  const std::optional<double> number = parse_number(value);
  if (!number) refuse(fmt::format("'{}': '{}' is not a number", text, value));
  requirement.value = *number;
  return requirement;
}

double value_of(const std::string& key, const Quality& quality) {
  if (const Measure* measure = find_measure(key)) return measure->of(quality);
  for (const EnergyKey& energy : energy_keys()) {
    if (energy.key == key) return quality.energy[energy.row][energy.star];
  }
  return std::nan("");
}

bool holds(Better better, double found, double wanted) {
  switch (better) {
    case Better::equal:
      return found == wanted;
    case Better::larger:
      return found >= wanted;
    case Better::less:
      return found <= wanted;
  }
  return false;
}

}  // namespace

std::vector<Requirement> parse_requirements(std::string_view list) {
  std::vector<Requirement> requirements;
  for (const std::string& word : comma_separated(list)) requirements.push_back(parse_requirement(word));
  return requirements;
}

std::optional<std::string> unmet(const Requirement& requirement, const Quality& quality) {
  const double found = value_of(requirement.key, quality);
  if (holds(requirement.better, found, requirement.value)) return std::nullopt;
  const char* sign = requirement.better == Better::equal ? "=" : requirement.better == Better::larger ? ">=" : "<=";
  return fmt::format("{} wants {} {} {}, found {}", requirement.text, requirement.key, sign, requirement.value, found);
}

std::string requirement_keys() {
  std::string text;
  for (const Measure& measure : measures()) {
    if (!text.empty()) text += ", ";
    text += measure.key;
    if (!measure.alias.empty()) text += fmt::format(" ({})", measure.alias);
  }
  return text + ", energy.NAME.STAR";
}

}  // namespace temper::app
