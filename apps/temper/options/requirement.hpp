// --require outside=0,min_h=0.05, of check and optimize: the grammar and the test.
//
//   list         requirement , requirement , …
//   requirement  key | key = value | key <= value | key >= value | key == value
//   key          a number of the JSON report, its short name, or energy.NAME.STAR (of triangles)
//
// A plain = stands for the useful comparison: counts are equal, minima and fractions at least, maxima and energies at
// most. Other numbers, such as the volume, have none. A key alone stands for the usual value of its row.
#pragma once

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

/// The meshes that a verb takes: their reports have different keys.
enum class MeshKind { triangles, tetrahedra };

/// --require, with all keys in its help. `tetrahedra`: the verb takes both kinds of meshes.
Option& add_requirements(Command& command, std::vector<std::string>& lists, bool tetrahedra = false);
/// The requirements of the lists; Failure (bad usage of the verb) for a key or a value that makes no sense.
[[nodiscard]] std::vector<Requirement> parse_requirements(std::string_view verb, std::span<const std::string> lists,
                                                          MeshKind kind = MeshKind::triangles);

/// Says whether all keys of the lists are of this kind of meshes.
[[nodiscard]] bool knows_keys(std::span<const std::string> lists, MeshKind kind);

/// "=", ">=" or "<=".
[[nodiscard]] std::string_view sign(Preference better);
[[nodiscard]] std::vector<Outcome> judge(std::span<const Requirement> requirements, const Quality& quality);
[[nodiscard]] std::vector<Outcome> judge(std::span<const Requirement> requirements, const tets::Quality& quality);
/// Lists on standard error the requirements that are not met; Exit::requirement when there are some.
[[nodiscard]] Exit report_unmet(std::span<const Outcome> outcomes, const std::string& path);

}  // namespace temper::app
