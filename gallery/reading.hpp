// How a reader takes what the paper leaves open. Each figure has its own way, which its claims state; a reading puts
// one way in the place of all of these, so that it can be seen which claims depend on it.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "gallery.hpp"
#include "temper/detail/optimize_table.hpp"

namespace temper::gallery {

/// The options that the paper leaves open: the order of line 9 of Algorithm 1, "for each point"; §5.2's "the maximum
/// search distance is the patch radius", for positions and for weights; whether a step may turn a triangle over; γ.
inline constexpr std::array<std::string_view, kOpenOptions> kOpen = {"order", "search_radius", "weight_search_radius",
                                                                     "inversion", "gamma"};

struct ReadOption {
  const OptionRow* option;  ///< of one of kOpen
  OptionValue value;
};
/// What is not among them is as each figure has it.
using Reading = std::vector<ReadOption>;

/// Before the first figure is made: some keep their runs.
void set_reading(Reading reading);

/// The options as the reading has them, for a run that is counted. Inversions are allowed where flips are deferred.
[[nodiscard]] OptimizeOptions as_read(OptimizeOptions options);

/// How the runs were read that as_read() has counted since the last call.
[[nodiscard]] RunSettings take_run_settings();

}  // namespace temper::gallery
