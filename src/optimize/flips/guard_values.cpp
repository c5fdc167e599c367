#include "optimize/flips/guard_values.hpp"

namespace temper {
namespace {

struct MeasureRow {
  GuardValues::Measure measure;
  int power;  ///< of the factor by which the measure changes if lengths, angles and ratios change by it
};
constexpr std::array<MeasureRow, GuardValues::kMeasures> kRows = {{{GuardValues::sine, 2},
                                                                   {GuardValues::cosine, 1},
                                                                   {GuardValues::edge, 2},
                                                                   {GuardValues::areas, 1},
                                                                   {GuardValues::shortest, 2},
                                                                   {GuardValues::crossing, 2},
                                                                   {GuardValues::edge_crossing, 2},
                                                                   {GuardValues::orthogonality, -1},
                                                                   {GuardValues::link, 1},
                                                                   {GuardValues::edges_alike, 2},
                                                                   {GuardValues::angles_alike, 1},
                                                                   {GuardValues::spacing, 1},
                                                                   {GuardValues::wide_spacing, -1},
                                                                   {GuardValues::duals_alike, 1},
                                                                   {GuardValues::centroid, -1}}};

}  // namespace

GuardValues scaled(GuardValues v, double factor) {
  for (const auto& [measure, power] : kRows) {
    v.value[measure] *= power == 2 ? factor * factor : power == 1 ? factor : 1 / factor;
  }
  return v;
}

}  // namespace temper
