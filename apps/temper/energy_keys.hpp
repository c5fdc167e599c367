// The energies of a report as keys of --require.
#pragma once

#include <string>
#include <vector>

#include "temper/quality.hpp"

namespace temper::app {

/// "energy.BP.1", for --require.
struct EnergyKey {
  std::string key;
  std::size_t row;
  std::size_t star;
};
[[nodiscard]] std::vector<EnergyKey> energy_keys();

}  // namespace temper::app
