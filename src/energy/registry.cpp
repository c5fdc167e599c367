// The table of energies. Tests, command line, Python and docs iterate over it.
#include <array>

#include "temper/energy.hpp"

namespace temper {
namespace {

constexpr std::array<EnergyInfo, kEnergyKinds> kEnergies = [] {
  using enum EnergyKind;
  using enum BoundaryTreatment;
  return std::array<EnergyInfo, kEnergyKinds>{{
      // kind, name, formula of a half-edge, boundary, barrier, γ, h°, length exponent
      {F, "F", "α d³h + β d h³", as_is, false, false, false, 4},
      {T, "T", "sgn(h_k + h_l) (α d³h + β d h³)", absolute, false, false, false, 4},
      {dT, "dT", "α d³h + β d h³, |h| on the boundary", absolute, false, false, false, 4},
      {BH, "BH", "(α d² + β h²) / (√(d_ij d_ji) h)", as_is, true, false, false, 0},
      {BHs, "BHs", "(α d² + β h²) / (√(d_ij d_ji) (h − h°))", as_is, true, false, true, 0},
      {BP, "BP", "(α d² + β h²) / (√(d_ij d_ji) φ), φ = (h + √(h² + γ²))/2", as_is, true, true, false, 0},
  }};
}();
static_assert(
    [] {
      for (std::size_t i = 0; i < kEnergyKinds; ++i) {
        if (kEnergies[i].kind != static_cast<EnergyKind>(i)) return false;
      }
      return true;
    }(),
    "each row is at the place of its kind");

}  // namespace

std::span<const EnergyInfo> energies() { return kEnergies; }

const EnergyInfo& energy_info(EnergyKind kind) { return kEnergies[static_cast<std::size_t>(kind)]; }

Expected<EnergyInfo> find_energy(std::string_view name) {
  std::string names;
  for (const EnergyInfo& info : kEnergies) {
    if (info.name == name) return info;
    names += (names.empty() ? "" : ", ") + std::string(info.name);
  }
  return InputError{
      ErrorCode::invalid_option, {}, "there is no energy \"" + std::string(name) + "\"; expected one of " + names};
}

}  // namespace temper
