#include "measures.hpp"

#include <array>

namespace temper::app {
namespace {

// Every member of Quality has the name of its key.
#define TEMPER_OF(member) [](const Quality& q) { return static_cast<double>(q.member); }

constexpr std::array<Measure, 16> kMeasures = {{
    {"vertices", "", "vertices", Better::equal, true, TEMPER_OF(vertices)},
    {"triangles", "", "triangles", Better::equal, true, TEMPER_OF(triangles)},
    {"edges", "", "edges", Better::equal, true, TEMPER_OF(edges)},
    {"boundary_edges", "", "boundary edges", Better::equal, true, TEMPER_OF(boundary_edges)},
    {"regions", "", "regions", Better::equal, true, TEMPER_OF(regions)},
    {"inverted_triangles", "inverted", "inverted triangles", Better::equal, true, TEMPER_OF(inverted_triangles)},
    {"non_regular_edges", "nonregular", "edges not regular", Better::equal, true, TEMPER_OF(non_regular_edges)},
    {"negative_boundary_duals", "", "negative boundary duals", Better::equal, true, TEMPER_OF(negative_boundary_duals)},
    {"orthocenters_outside", "outside", "orthocenters outside", Better::equal, true, TEMPER_OF(orthocenters_outside)},
    {"edges_not_crossed", "not_crossed", "edges not crossed", Better::equal, true, TEMPER_OF(edges_not_crossed)},
    {"well_centered_fraction", "well_centered", "well-centered fraction", Better::larger, false,
     TEMPER_OF(well_centered_fraction)},
    {"min_h_over_l", "min_h", "least h/l", Better::larger, false, TEMPER_OF(min_h_over_l)},
    {"min_d_over_l", "min_d", "least d/l", Better::larger, false, TEMPER_OF(min_d_over_l)},
    {"min_angle_deg", "min_angle", "least angle (degrees)", Better::larger, false, TEMPER_OF(min_angle_deg)},
    {"max_angle_deg", "max_angle", "largest angle (degrees)", Better::less, false, TEMPER_OF(max_angle_deg)},
    {"max_transmissibility_over_median", "transmissibility", "transmissibility, max/median", Better::less, false,
     TEMPER_OF(max_transmissibility_over_median)},
}};

#undef TEMPER_OF

}  // namespace

std::span<const Measure> measures() { return kMeasures; }

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
