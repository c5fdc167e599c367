// The measures of the guard (guard.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace temper {

/// Values of which the least counts: larger is better. None depends on weights.
struct GuardValues {
  enum Measure {
    sine,           ///< sin² of the least angle
    cosine,         ///< 1 + cosine of the largest angle
    edge,           ///< (edge over size)² of an inner edge
    areas,          ///< Smaller over larger area of a pair
    shortest,       ///< Length² of an edge
    crossing,       ///< Time² of a wave across a triangle [s²]
    edge_crossing,  ///< Time² of a wave along an edge [s²]
    orthogonality,  ///< −|cosine| of the angle between an inner edge and its flow link
    link,           ///< Length of the flow link over the mean size of its cells
    edges_alike,    ///< (Shortest over longest edge of a triangle)²
    angles_alike,   ///< Least over largest angle of a triangle
    spacing,        ///< Mean distance of a vertex from its neighbors
    wide_spacing,   ///< −the same
    duals_alike,    ///< Shortest over longest dual of a cell
    centroid,       ///< −distance of a vertex from the centroid of its cell, over local size
  };
  static constexpr std::size_t kMeasures = 15;
  /// Indexed by Measure. The last value fills a register of lanes and stays infinite.
  alignas(64) std::array<double, kMeasures + 1> value;

  GuardValues() { value.fill(std::numeric_limits<double>::infinity()); }
  void take(Measure m, double x) { value[m] = x < value[m] ? x : value[m]; }
  /// Takes the worse of the two, measure by measure.
  void take(const GuardValues& other) {
    for (std::size_t i = 0; i < value.size(); ++i) value[i] = other.value[i] < value[i] ? other.value[i] : value[i];
  }
  /// Says whether no measure is worse than before and beyond the limit. Values that are infinite before hold only
  /// within the limits.
  [[nodiscard]] bool hold(const GuardValues& before, const GuardValues& limits) const {
    bool all = true;
    for (std::size_t i = 0; i < value.size(); ++i) all &= value[i] >= before.value[i] || value[i] >= limits.value[i];
    return all;
  }
  /// Says whether no measure is beyond the limit.
  [[nodiscard]] bool are_within(const GuardValues& limits) const { return hold(GuardValues(), limits); }
};

/// The values after lengths, angles and ratios change by a factor. Negative measures change by its inverse.
[[nodiscard]] GuardValues scaled(GuardValues v, double factor);

}  // namespace temper
