// --require outside=0,min_h=0.05, of check and optimize: the grammar and the test.
//
//   list         requirement , requirement , …
//   requirement  key | key = value | key <= value | key >= value | key == value
//   key          a number of the JSON report, its short name, or energy.NAME.STAR (of triangles)
//
// A plain = stands for the useful comparison: counts are equal, minima and fractions at least, maxima and energies at
// most. Other numbers, such as the volume, have none. A key alone stands for the usual value of its row.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "help/command.hpp"
#include "temper/quality.hpp"
#include "temper/tets/quality.hpp"

namespace temper::app {

struct Requirement {
  std::string text;  ///< as the user wrote it
  std::string key;   ///< of the JSON report
  Preference better = Preference::equal;
  double value = 0;
};

/// A requirement, and the value found.
struct Outcome {
  Requirement requirement;
  double found = 0;
  bool met = false;
};
[[nodiscard]] const ReportTable& table_of(const Outcome*);

/// Triangles that are not well-centered: the key `bad`, and the number of all reports.
[[nodiscard]] std::size_t bad_elements(const Quality& quality);
[[nodiscard]] std::size_t bad_elements(const tets::Quality& quality);

/// --require, with all keys in its help. `tetrahedra`: the verb takes both kinds of meshes.
Option& add_requirements(Command& command, std::vector<std::string>& lists, bool tetrahedra = false);
/// The requirements of the lists; Failure (bad usage of the verb) for a key or a value that makes no sense.
[[nodiscard]] std::vector<Requirement> parse_requirements(std::string_view verb, std::span<const std::string> lists,
                                                          CellKinds kind = CellKinds::triangles);

/// Says whether all keys of the lists are of this kind of meshes.
[[nodiscard]] bool knows_keys(std::span<const std::string> lists, CellKinds kind);

/// The requirements on meshes of both kinds, for verbs that see the kind when they have read the file.
class RequirementLists {
 public:
  RequirementLists() = default;
  /// Lists may make sense for one kind alone. Failure if they make sense for none; it is about the kind that knows
  /// their keys, and says that the other kind does not.
  RequirementLists(std::string_view verb, std::span<const std::string> lists)
      : triangles_(verb, lists, CellKinds::triangles), tetrahedra_(verb, lists, CellKinds::tetrahedra) {
    if (!triangles_.refusal || !tetrahedra_.refusal) return;
    const bool of_triangles = knows_keys(lists, CellKinds::triangles),
               of_tets = knows_keys(lists, CellKinds::tetrahedra);
    const Failure& refusal = of_triangles || !of_tets ? *triangles_.refusal : *tetrahedra_.refusal;
    std::string text = refusal.what();
    if (of_triangles != of_tets) {
      const std::string other = of_triangles ? "tetrahedra" : "triangles";
      text.insert(std::min(text.find('\n'), text.size()), ". Not all of these keys exist for " + other);
    }
    throw Failure(refusal.exit, text);
  }
  /// Failure when the lists make no sense for this kind.
  [[nodiscard]] const std::vector<Requirement>& of(CellKinds kind) const {
    const Parsed& parsed = kind == CellKinds::triangles ? triangles_ : tetrahedra_;
    if (parsed.refusal) throw Failure(*parsed.refusal);
    return parsed.list;
  }

 private:
  struct Parsed {
    Parsed() = default;
    Parsed(std::string_view verb, std::span<const std::string> lists, CellKinds kind) {
      try {
        list = parse_requirements(verb, lists, kind);
      } catch (const Failure& failure) {
        refusal = failure;
      }
    }
    std::vector<Requirement> list;
    std::optional<Failure> refusal;
  };
  Parsed triangles_, tetrahedra_;
};

/// "=", ">=" or "<=".
[[nodiscard]] std::string_view sign(Preference better);
[[nodiscard]] std::vector<Outcome> judge(std::span<const Requirement> requirements, const Quality& quality);
[[nodiscard]] std::vector<Outcome> judge(std::span<const Requirement> requirements, const tets::Quality& quality);
/// Lists on standard error the requirements that are not met; Exit::requirement when there are some.
[[nodiscard]] Exit report_unmet(std::span<const Outcome> outcomes, const std::string& path);

}  // namespace temper::app
