#include "options/requirement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "console.hpp"
#include "options/options.hpp"
#include "temper/detail/suggest.hpp"

namespace temper::app {
namespace {

/// Violations of the criterion of the target.
constexpr std::string_view kBad = "bad";

/// "energy.BP.1", and the place of that energy.
struct EnergyKey {
  std::string key;
  std::size_t row, star;
};

const std::vector<EnergyKey>& energy_keys() {
  static const std::vector<EnergyKey> all = [] {
    std::vector<EnergyKey> keys;
    for (std::size_t row = 0; row < energies().size(); ++row) {
      for (std::size_t star = 0; star < 3; ++star)
        keys.push_back({fmt::format("energy.{}.{}", energies()[row].name, star), row, star});
    }
    return keys;
  }();
  return all;
}

template <class Row>
const Row* find_row(std::span<const Row> rows, std::string_view key) {
  for (const Row& row : rows) {
    if (key == row.key || (!row.alias.empty() && key == row.alias)) return &row;
  }
  return nullptr;
}

/// A measure without its function, for meshes of any kind.
struct Key {
  std::string_view key, alias;
  Preference better;
  bool count;
  std::optional<double> wanted;
  bool energy = false;  ///< one of many, which lists do not show

  /// Says whether a plain = stands for a comparison. No value equals a length or a volume, which are rounded.
  [[nodiscard]] bool has_equal_sign() const { return count || better != Preference::equal; }
};

std::vector<Key> keys_of(CellKinds kind) {
  std::vector<Key> keys;
  with_subject(kind, [&]<class Subject>(Subject) {
    for (const auto& row : Subject::measures()) keys.push_back({row.key, row.alias, row.better, row.count, row.wanted});
    if constexpr (std::is_same_v<Subject, Triangles>) {
      for (const EnergyKey& energy : energy_keys())
        keys.push_back({energy.key, {}, Preference::less, false, std::nullopt, true});
    }
  });
  keys.push_back({kBad, {}, Preference::equal, true, 0});
  return keys;
}

[[noreturn]] void refuse(const std::string& message) { throw BadValue(message); }

/// Names that are near, and those that begin with the same word: "min_angle" has "min_h".
[[noreturn]] void refuse_key(std::string_view key, std::span<const Key> keys, CellKinds kind) {
  const std::string_view word = key.substr(0, key.find_first_of("_."));
  std::vector<std::string_view> names, alike;
  for (const Key& each : keys) {
    if (each.energy) continue;
    if (!each.alias.empty()) names.push_back(each.alias);
    names.push_back(each.key);
    if (each.key.starts_with(word)) alike.push_back(each.alias.empty() ? each.key : each.alias);
  }
  const std::string_view guess = nearest(key, names);
  if (word == "energy" && std::ranges::any_of(keys, &Key::energy))
    alike.emplace_back("energy.NAME.STAR, such as energy.BP.1");
  const std::string near = !guess.empty()   ? fmt::format(", did you mean '{}'?", guess)
                           : !alike.empty() ? fmt::format("; there are {}.", join(alike))
                                            : ".";
  refuse(fmt::format("unknown key '{}'{}{} Next: temper check --help lists all keys", key,
                     kind == kEachKind[0] ? "" : fmt::format(" for {}", name(kind)), near));
}

const Key& find_key(std::string_view key, std::span<const Key> keys, CellKinds kind) {
  if (const Key* const found = find_row(keys, key)) return *found;
  refuse_key(key, keys, kind);
}

/// A key alone stands for the usual requirement.
Requirement usual_requirement(std::string_view key, std::span<const Key> keys, CellKinds kind) {
  if (key.empty()) refuse("'' is not key=value");
  const Key& measure = find_key(key, keys, kind);
  if (!measure.wanted) {
    refuse(measure.has_equal_sign()
               ? fmt::format("'{0}' has no usual value: write {0}{1}VALUE", key, sign(measure.better))
               : fmt::format("'{0}' has no usual value: write {0}>=VALUE or {0}<=VALUE", key));
  }
  return {std::string(key), std::string(measure.key), measure.better, *measure.wanted};
}

Requirement parse_requirement(std::string_view text, std::span<const Key> keys, CellKinds kind) {
  const std::size_t at = text.find_first_of("<>=");
  if (at == std::string_view::npos) return usual_requirement(text, keys, kind);
  const std::string_view key = text.substr(0, at);
  const bool two = text.substr(at).size() > 1 && text[at + 1] == '=';
  if (!two && text[at] != '=') refuse(fmt::format("'{}': write <= or >=, both include the value", text));

  const Key& measure = find_key(key, keys, kind);
  Requirement requirement = {std::string(text), std::string(measure.key), measure.better, 0};
  if (!two && !measure.has_equal_sign())
    refuse(fmt::format("'{0}': {1} is rounded, so that = decides nothing: write {1}>=VALUE or {1}<=VALUE", text, key));
  if (two)
    requirement.better = text[at] == '<' ? Preference::less : text[at] == '>' ? Preference::larger : Preference::equal;
  const std::string_view value = text.substr(at + (two ? 2 : 1));
  const std::optional<double> number = parse_number(value);
  if (!number) refuse(fmt::format("'{}': '{}' is not a number", text, value));
  requirement.value = *number;
  return requirement;
}

template <class AnyQuality>
double value_of(const std::string& key, const AnyQuality& quality, Criterion criterion) {
  if (key == kBad) return static_cast<double>(violations(quality, criterion));
  if (const auto* measure = find_row(SubjectOf<AnyQuality>::measures(), key)) return measure->of(quality);
  if constexpr (std::is_same_v<AnyQuality, Quality>) {
    for (const EnergyKey& energy : energy_keys()) {
      if (energy.key == key) return quality.energy[energy.row][energy.star];
    }
  }
  return std::nan("");
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

/// The keys and short names of fields of reports, as a sentence of the help.
std::string requirement_keys(CellKinds kind) {
  std::string text = kind == kEachKind[0] ? "Keys: " : fmt::format("Keys for {}: ", name(kind));
  const std::vector<Key> keys = keys_of(kind), first = keys_of(kEachKind[0]);
  const bool is_known = std::ranges::all_of(
      keys, [&](const Key& each) { return std::ranges::find(first, each.key, &Key::key) != first.end(); });
  if (kind != kEachKind[0] && is_known)
    return text + fmt::format("those of {} from {} to {}, and bad. ", name(kEachKind[0]), keys.front().key,
                              keys[keys.size() - 2].key);
  for (const Key& each : keys) {
    if (each.energy || each.key == kBad) continue;
    text += each.key;
    text += each.alias.empty() ? ", " : fmt::format(" ({}), ", each.alias);
  }
  return text + (std::ranges::any_of(keys, &Key::energy) ? "energy.NAME.STAR, bad. " : "bad. ");
}

/// The requirements of the lists; Failure (bad usage of the verb) for a key or a value that makes no sense.
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

/// Says whether all keys of the lists are of this kind of meshes.
bool knows_keys(std::span<const std::string> lists, CellKinds kind) {
  const std::vector<Key> keys = keys_of(kind);
  const auto is_known = [&](std::string_view word) {
    const std::string_view key = word.substr(0, word.find_first_of("<>="));
    return find_row<Key>(keys, key) != nullptr;
  };
  return std::ranges::all_of(lists,
                             [&](const std::string& list) { return std::ranges::all_of(separated(list), is_known); });
}

}  // namespace

Option& add_requirements(Command& command, std::vector<std::string>& lists) {
  std::string sentence =
      "Requirements key=value, key>=value or key<=value, separated by commas. If one is not met, exit with 3. For a "
      "count, key=value requires equality. For a minimum or a fraction it means at least, and for a maximum or an "
      "energy at most. A key alone stands for its usual value, see docs/reference/limits.md. ";
  for (const CellKinds kind : kEachKind) sentence += requirement_keys(kind);
  return add_texts(command, "--require", "LIST", Values::repeated, lists,
                   sentence +
                       "The key bad counts what the target of --for cannot use: elements that are not well-centered, "
                       "negative coefficients of target vertex, or distances of target cell that are not positive");
}

RequirementLists::RequirementLists(std::string_view verb, std::span<const std::string> lists) {
  bool makes_sense = false;
  std::string lacking;
  const OfKind* knowing = nullptr;
  for (std::size_t i = 0; i < of_kinds_.size(); ++i) {
    OfKind& kind = of_kinds_[i];
    try {
      kind.list = parse_requirements(verb, lists, kEachKind[i]);
      makes_sense = true;
    } catch (const Failure& failure) {
      kind.refusal = failure;
    }
    if (!knows_keys(lists, kEachKind[i]))
      lacking += fmt::format("{}{}", lacking.empty() ? "" : " or ", name(kEachKind[i]));
    else if (knowing == nullptr)
      knowing = &kind;
  }
  if (makes_sense) return;
  const Failure& refusal = *(knowing == nullptr ? of_kinds_.front() : *knowing).refusal;
  std::string text = refusal.what();
  if (knowing != nullptr && !lacking.empty())
    text.insert(std::min(text.find('\n'), text.size()), ". Not all of these keys exist for " + lacking);
  throw Failure(refusal.exit, text);
}

const std::vector<Requirement>& RequirementLists::of(CellKinds kind) const {
  const OfKind& found = of_kinds_[static_cast<std::size_t>(std::ranges::find(kEachKind, kind) - kEachKind)];
  if (found.refusal) throw Failure(*found.refusal);
  return found.list;
}

std::string_view sign(Preference better) {
  return better == Preference::equal ? "=" : better == Preference::larger ? ">=" : "<=";
}

template <class AnyQuality>
std::vector<Outcome> judge(std::span<const Requirement> requirements, const AnyQuality& quality, Criterion criterion) {
  std::vector<Outcome> outcomes;
  for (const Requirement& requirement : requirements) {
    const double found = value_of(requirement.key, quality, criterion);
    outcomes.push_back({requirement, found, holds(requirement.better, found, requirement.value)});
  }
  return outcomes;
}
#define TEMPER_MAKE(S) template std::vector<Outcome> judge(std::span<const Requirement>, const S::Quality&, Criterion);
TEMPER_EACH_SUBJECT(TEMPER_MAKE)
#undef TEMPER_MAKE

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
