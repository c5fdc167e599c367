#include "optimize/flips/guard_values.hpp"

#include <algorithm>

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

void GuardValues::take(const GuardValues& other) {
  for (std::size_t i = 0; i < kMeasures; ++i) value[i] = std::min(value[i], other.value[i]);
}

/// Values that are infinite before hold only within the limits.
bool GuardValues::hold(const GuardValues& before, const GuardValues& limits) const {
  for (std::size_t i = 0; i < kMeasures; ++i) {
    if (value[i] < before.value[i] && value[i] < limits.value[i]) return false;
  }
  return true;
}

}  // namespace temper
