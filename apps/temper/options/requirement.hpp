// --require outside=0,min_h=0.05, of check and optimize: the grammar and the test.
//
//   list         requirement , requirement , …
//   requirement  key | key = value | key <= value | key >= value | key == value
//   key          a number of the JSON report, its short name, or energy.NAME.STAR (of triangles)
//
// A plain = stands for the useful comparison: counts are equal, minima and fractions at least, maxima and energies at
// most. Other numbers, such as the volume, have none. A key alone stands for the usual value of its row.
#pragma once

#include <array>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "help/command.hpp"
#include "subject.hpp"

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

/// Elements that are not well-centered: the number of all reports.
template <class AnyQuality>
[[nodiscard]] std::size_t bad_elements(const AnyQuality& quality) {
  return violations(quality, Criterion::well_centered);
}

/// --require, with the keys of each kind of cells in its help.
Option& add_requirements(Command& command, std::vector<std::string>& lists);

/// The requirements on meshes of each kind, for verbs that see the kind when they have read the file.
class RequirementLists {
 public:
  RequirementLists() = default;
  /// Lists may make sense for one kind alone. Failure (bad usage of the verb) if they make sense for none; it is about
  /// a kind that knows their keys, and says that the others do not.
  RequirementLists(std::string_view verb, std::span<const std::string> lists);
  /// Failure when the lists make no sense for this kind.
  [[nodiscard]] const std::vector<Requirement>& of(CellKinds kind) const;

 private:
  struct OfKind {
    std::vector<Requirement> list;
    std::optional<Failure> refusal;
  };
  std::array<OfKind, std::size(kEachKind)> of_kinds_;  // in the order of the kinds
};

/// "=", ">=" or "<=".
[[nodiscard]] std::string_view sign(Preference better);
/// The key `bad` counts violations of the criterion.
template <class AnyQuality>
[[nodiscard]] std::vector<Outcome> judge(std::span<const Requirement> requirements, const AnyQuality& quality,
                                         Criterion criterion);
/// Lists on standard error the requirements that are not met; Exit::requirement when there are some.
[[nodiscard]] Exit report_unmet(std::span<const Outcome> outcomes, const std::string& path);

}  // namespace temper::app
