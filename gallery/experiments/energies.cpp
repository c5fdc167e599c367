#include "experiments/energies.hpp"

#include <algorithm>

#include "temper/detail/geometry.hpp"

namespace temper::gallery {
namespace {

std::string subscript(std::string_view energy) { return energy == "dT" ? "∂T" : std::string(energy); }

}  // namespace

std::size_t position_of(std::string_view energy) {
  return static_cast<std::size_t>(std::ranges::find(kFiveEnergies, energy) - kFiveEnergies.begin());
}

std::string symbol(std::string_view energy) { return "E_" + subscript(energy); }

std::string plot_symbol(std::string_view energy) { return "E_{" + subscript(energy) + "}"; }

LengthParameter shift_beyond(const Mesh& input) {
  constexpr double kBeyond = 1.25;
  double least = 0;
  for (const HalfedgeId h : input.halfedges()) {
    const VertexId p = input.origin(h), q = input.target(h), r = input.opposite(h);
    least = std::min(least, signed_height(input.point(p), input.point(q), input.point(r)));
  }
  return {-kBeyond * least, LengthScale::absolute};
}

EnergyModel model_of(std::string_view energy, const Mesh& input) {
  EnergyModel model;
  if (const auto info = find_energy(energy))
    model.kind = info->kind, model.boundary_treatment = info->boundary_treatment;
  model.gamma = {kPaperGamma, LengthScale::absolute};
  model.h0 = shift_beyond(input);
  return model;
}

}  // namespace temper::gallery
