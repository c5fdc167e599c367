#include "options/requirement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "console.hpp"
#include "options/options.hpp"
#include "temper/detail/suggest.hpp"

namespace temper::app {
namespace {

/// Triangles or tetrahedra that are not well-centered, as the reports count them.
constexpr std::string_view kBad = "bad";

/// "energy.BP.1", and the place of that energy.
struct EnergyKey {
  std::string key;
  std::size_t row, star;
};

std::vector<EnergyKey> energy_keys() {
  std::vector<EnergyKey> keys;
  for (std::size_t row = 0; row < energies().size(); ++row) {
    for (std::size_t star = 0; star < 3; ++star) {
      keys.push_back({"energy." + std::string(energies()[row].name) + "." + std::to_string(star), row, star});
    }
  }
  return keys;
}

template <class Row>
const Row* find_row(std::span<const Row> rows, std::string_view key) {
  for (const Row& row : rows) {
    if (key == row.key || (!row.alias.empty() && key == row.alias)) return &row;
  }
  return nullptr;
}

/// A measure without its function, for meshes of either kind.
struct Key {
  std::string_view key, alias;
  Preference better;
  bool count;
  std::optional<double> wanted;

  /// Says whether a plain = stands for a comparison. No value equals a length or a volume, which are rounded.
  [[nodiscard]] bool has_equal_sign() const { return count || better != Preference::equal; }
};
std::vector<Key> keys_of(CellKinds kind) {
  std::vector<Key> keys;
  const auto add = [&](const auto& rows) {
    for (const auto& row : rows) keys.push_back({row.key, row.alias, row.better, row.count, row.wanted});
  };
  kind == CellKinds::triangles ? add(quality_measures()) : add(tets::quality_measures());
  keys.push_back({kBad, {}, Preference::equal, true, 0});
  return keys;
}

bool is_energy_key(std::string_view key) {
  for (const EnergyKey& energy : energy_keys()) {
    if (energy.key == key) return true;
  }
  return false;
}

[[noreturn]] void refuse(const std::string& message) { throw BadValue(message); }

/// Names that are near, and those that begin with the same word: "min_angle" has "min_h".
[[noreturn]] void refuse_key(std::string_view key, std::span<const Key> keys, CellKinds kind) {
  const std::string_view word = key.substr(0, key.find_first_of("_."));
  std::vector<std::string_view> names, alike;
  for (const Key& each : keys) {
    if (!each.alias.empty()) names.push_back(each.alias);
    names.push_back(each.key);
    if (each.key.starts_with(word)) alike.push_back(each.alias.empty() ? each.key : each.alias);
  }
  const std::string_view guess = nearest(key, names);
  if (kind == CellKinds::triangles && word == "energy") alike.emplace_back("energy.NAME.STAR, such as energy.BP.1");
  const std::string near = !guess.empty()   ? fmt::format(", did you mean '{}'?", guess)
                           : !alike.empty() ? fmt::format("; there are {}.", join(alike))
                                            : ".";
  refuse(fmt::format("unknown key '{}'{}{} Next: temper check --help lists all keys", key,
                     kind == CellKinds::triangles ? "" : " for tetrahedra", near));
}

/// A key alone stands for the usual requirement.
Requirement usual_requirement(std::string_view key, std::span<const Key> keys, CellKinds kind) {
  const Key* measure = find_row(keys, key);
  if (key.empty()) refuse("'' is not key=value");
  if (measure == nullptr && kind == CellKinds::triangles && is_energy_key(key))
    refuse(fmt::format("'{0}' has no usual value: write {0}<=VALUE", key));
  if (measure == nullptr) refuse_key(key, keys, kind);
  if (!measure->wanted) {
    refuse(measure->has_equal_sign()
               ? fmt::format("'{0}' has no usual value: write {0}{1}VALUE", key, sign(measure->better))
               : fmt::format("'{0}' has no usual value: write {0}>=VALUE or {0}<=VALUE", key));
  }
  return {std::string(key), std::string(measure->key), measure->better, *measure->wanted};
}

Requirement parse_requirement(std::string_view text, std::span<const Key> keys, CellKinds kind) {
  const std::size_t at = text.find_first_of("<>=");
  if (at == std::string_view::npos) return usual_requirement(text, keys, kind);
  const std::string_view key = text.substr(0, at);
  const bool two = text.substr(at).size() > 1 && text[at + 1] == '=';
  if (!two && text[at] != '=') refuse(fmt::format("'{}': write <= or >=, both include the value", text));

  Requirement requirement;
  requirement.text = text;
  const Key* measure = find_row(keys, key);
  const bool known = measure != nullptr || (kind == CellKinds::triangles && is_energy_key(key));
  if (!known) refuse_key(key, keys, kind);
  requirement.key = measure != nullptr ? measure->key : key;
  if (!two && measure != nullptr && !measure->has_equal_sign())
    refuse(fmt::format("'{0}': {1} is rounded, so that = decides nothing: write {1}>=VALUE or {1}<=VALUE", text, key));
  if (two) {
    requirement.better = text[at] == '<' ? Preference::less : text[at] == '>' ? Preference::larger : Preference::equal;
  } else {
    requirement.better = measure != nullptr ? measure->better : Preference::less;
  }
  const std::string_view value = text.substr(at + (two ? 2 : 1));
  const std::optional<double> number = parse_number(value);
  if (!number) refuse(fmt::format("'{}': '{}' is not a number", text, value));
  requirement.value = *number;
  return requirement;
}

double value_of(const std::string& key, const Quality& quality) {
  if (key == kBad) return static_cast<double>(bad_elements(quality));
  if (const QualityMeasure* measure = find_row(quality_measures(), key)) return measure->of(quality);
  for (const EnergyKey& energy : energy_keys()) {
    if (energy.key == key) return quality.energy[energy.row][energy.star];
  }
  return std::nan("");
}

double value_of(const std::string& key, const tets::Quality& quality) {
  if (key == kBad) return static_cast<double>(bad_elements(quality));
  const tets::QualityMeasure* measure = find_row(tets::quality_measures(), key);
  return measure == nullptr ? std::nan("") : measure->of(quality);
}

bool holds(Preference better, double found, double wanted) {
  switch (better) {
    case Preference::equal:
      return found == wanted;
    case Preference::larger:
      return found >= wanted;
    case Preference::less:
      return found <= wanted;
  }
  return false;
}

/// Says whether no value meets both: `at least a` must be above `b at most`.
bool contradict(const Requirement& a, const Requirement& b) {
  return a.key == b.key && a.better != Preference::less && b.better != Preference::larger && a.value > b.value;
}

/// The keys and short names of fields of reports, for --help.
std::string requirement_keys(CellKinds kind) {
  std::string text;
  for (const Key& each : keys_of(kind)) {
    if (each.key == kBad) continue;
    if (!text.empty()) text += ", ";
    text += each.key;
    if (!each.alias.empty()) text += fmt::format(" ({})", each.alias);
  }
  return text;
}

template <class Report>
std::vector<Outcome> outcomes_of(std::span<const Requirement> requirements, const Report& quality) {
  std::vector<Outcome> outcomes;
  for (const Requirement& requirement : requirements) {
    const double found = value_of(requirement.key, quality);
    outcomes.push_back({requirement, found, holds(requirement.better, found, requirement.value)});
  }
  return outcomes;
}

}  // namespace

std::size_t bad_elements(const Quality& quality) {
  const double good = quality.well_centered_fraction * static_cast<double>(quality.triangles);
  return quality.triangles - std::min(quality.triangles, static_cast<std::size_t>(std::lround(good)));
}

std::size_t bad_elements(const tets::Quality& quality) { return quality.orthocenters_outside; }

Option& add_requirements(Command& command, std::vector<std::string>& lists, bool tetrahedra) {
  return add_texts(
      command, "--require", "LIST", Values::repeated, lists,
      "Requirements key=value, key>=value or key<=value, separated by commas. If one is not met, exit with 3. For a "
      "count, key=value requires equality. For a minimum or a fraction it means at least, and for a maximum or an "
      "energy at most. A key alone stands for its usual value, see docs/reference/limits.md. Keys: " +
          requirement_keys(CellKinds::triangles) + ", energy.NAME.STAR, bad" +
          (tetrahedra ? ". Keys for tetrahedra: " + requirement_keys(CellKinds::tetrahedra) + ", bad" : "") +
          ". The key bad counts elements that are not well-centered");
}

std::vector<Requirement> parse_requirements(std::string_view verb, std::span<const std::string> lists, CellKinds kind) {
  const std::vector<Key> keys = keys_of(kind);
  std::vector<Requirement> requirements;
  try {
    for (const std::string& list : lists) {
      for (const std::string& word : separated(list)) requirements.push_back(parse_requirement(word, keys, kind));
    }
  } catch (const BadValue& bad) {
    refuse_usage(std::string(verb), fmt::format("--require: {}", bad.what()));
  }
  for (const Requirement& a : requirements) {
    const auto b = std::ranges::find_if(requirements, [&a](const Requirement& other) { return contradict(a, other); });
    if (b == requirements.end()) continue;
    refuse_usage(std::string(verb), fmt::format("--require: no mesh meets both {} and {}", a.text, b->text));
  }
  return requirements;
}

bool knows_keys(std::span<const std::string> lists, CellKinds kind) {
  const std::vector<Key> keys = keys_of(kind);
  const auto is_known = [&](std::string_view word) {
    const std::string_view key = word.substr(0, word.find_first_of("<>="));
    return find_row<Key>(keys, key) != nullptr || (kind == CellKinds::triangles && is_energy_key(key));
  };
  return std::ranges::all_of(lists,
                             [&](const std::string& list) { return std::ranges::all_of(separated(list), is_known); });
}

std::string_view sign(Preference better) {
  return better == Preference::equal ? "=" : better == Preference::larger ? ">=" : "<=";
}

std::vector<Outcome> judge(std::span<const Requirement> requirements, const Quality& quality) {
  return outcomes_of(requirements, quality);
}

std::vector<Outcome> judge(std::span<const Requirement> requirements, const tets::Quality& quality) {
  return outcomes_of(requirements, quality);
}

Exit report_unmet(std::span<const Outcome> outcomes, const std::string& path) {
  Exit exit = Exit::done;
  for (const auto& [requirement, found, met] : outcomes) {
    if (met) continue;
    print_error(fmt::format("{}: requirement not met: {} means {} {} {}, found {}", path, requirement.text,
                            requirement.key, sign(requirement.better), requirement.value, found));
    exit = Exit::requirement;
  }
  return exit;
}

}  // namespace temper::app
