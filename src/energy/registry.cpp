// The registry for users, whose table is in edge_kernels.hpp next to the formulas; and the kernels in use.
#include "base/instruction_set_choice.hpp"
#include "energy/edge_kernels.hpp"
#include "energy/star_kernels.hpp"
#include "temper/detail/suggest.hpp"

namespace temper {

std::span<const EnergyInfo> energies() { return kEnergies; }

const EnergyInfo& energy_info(EnergyKind kind) { return kEnergies[static_cast<std::size_t>(kind)]; }

Expected<EnergyInfo> find_energy(std::string_view name) {
  std::vector<std::string_view> names;
  for (const EnergyInfo& info : kEnergies) {
    if (info.name == name) return info;
    names.push_back(info.name);
  }
  return InputError{
      ErrorCode::invalid_option,
      {},
      "there is no energy \"" + std::string(name) + "\"; expected one of " + join(names) + did_you_mean(name, names)};
}

const StarKernels& star_kernels(const Space& space) {
  return space.is_plane() ? *TEMPER_IN_USE(kPlaneKernels) : *TEMPER_IN_USE(kSphereKernels);
}

}  // namespace temper
