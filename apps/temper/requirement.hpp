// check --require outside=0,min_h=0.05: the grammar, and the judgement.
//
//   list         requirement , requirement , …
//   requirement  key = value | key <= value | key >= value | key == value
//   key          a number of the JSON report, its short name, or energy.NAME.STAR
//
// A plain = asks what one wants of that number: counts equal, minima and fractions at least, maxima and
// energies at most.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "measures.hpp"

namespace temper::app {

struct Requirement {
  std::string text;  ///< as the user wrote it
  std::string key;   ///< of the JSON report
  Better better = Better::equal;
  double value = 0;
};

/// The requirements of a list; Failure (bad usage) for a key or a value that makes no sense.
[[nodiscard]] std::vector<Requirement> parse_requirements(std::string_view list);

/// "min_h=0.05 wants min_h_over_l >= 0.05, found 0.013", or nothing when it holds.
[[nodiscard]] std::optional<std::string> unmet(const Requirement& requirement, const Quality& quality);

/// The keys and short names, for --help.
[[nodiscard]] std::string requirement_keys();

}  // namespace temper::app
