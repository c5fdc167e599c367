// The numbers of a report, once: their JSON keys, their words for people, and which way is better. The table,
// the JSON and --require are all made from this one list.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "temper/quality.hpp"

namespace temper::app {

/// The comparison that a requirement key=value stands for.
enum class Better {
  equal,   ///< counts
  larger,  ///< minima and fractions: at least
  less,    ///< maxima and energies: at most
};

struct Measure {
  std::string_view key;    ///< of the JSON report
  std::string_view alias;  ///< short name for --require, or empty
  std::string_view label;  ///< in the table
  Better better;
  bool count;  ///< a whole number
  double (*of)(const Quality&);
};
[[nodiscard]] std::span<const Measure> measures();

/// "energy.BP.1", for --require.
struct EnergyKey {
  std::string key;
  std::size_t row;
  std::size_t star;
};
[[nodiscard]] std::vector<EnergyKey> energy_keys();

}  // namespace temper::app
