#include "energy_keys.hpp"

namespace temper::app {

std::vector<EnergyKey> energy_keys() {
  std::vector<EnergyKey> keys;
  for (std::size_t row = 0; row < energies().size(); ++row) {
    for (std::size_t star = 0; star < 3; ++star) {
      keys.push_back({"energy." + std::string(energies()[row].name) + "." + std::to_string(star), row, star});
    }
  }
  return keys;
}

}  // namespace temper::app
