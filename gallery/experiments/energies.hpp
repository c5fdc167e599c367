// The energies that the paper compares, by name, their symbols, and the parameters with which all runs have them.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "temper/energy.hpp"
#include "temper/mesh.hpp"

namespace temper::gallery {

/// Those of §6.4, without a barrier first.
inline constexpr std::array<std::string_view, 3> kHotEnergies = {"F", "dT", "T"};
inline constexpr std::array<std::string_view, 2> kBarriers = {"BP", "BHs"};
inline constexpr std::array<std::string_view, 5> kFiveEnergies = {"F", "dT", "T", "BP", "BHs"};
/// The index of an energy among the five.
[[nodiscard]] std::size_t position_of(std::string_view energy);

/// "E_∂T" of "dT", for prose.
[[nodiscard]] std::string symbol(std::string_view energy);
/// "E_{∂T}" of "dT", for labels of plots.
[[nodiscard]] std::string plot_symbol(std::string_view energy);

/// γ of E_BP, the paper's.
inline constexpr double kPaperGamma = 1;
/// −h° of E_BHs: a quarter more than the least h of the input, so that the energy is finite at the start.
[[nodiscard]] LengthParameter shift_beyond(const Mesh& input);

/// The energy of that name, ★1, as a run from the input has it.
[[nodiscard]] EnergyModel model_of(std::string_view energy, const Mesh& input);

}  // namespace temper::gallery
