// Narrow places, where pieces of the outline face each other across the inside, and how small edges must be there.
#pragma once

#include <vector>

#include "mesher/areas.hpp"
#include "mesher/deadline.hpp"

namespace temper::mesher {

/// Sizes that leave room for a row of vertices between facing pieces; only those that are less than `size` by more
/// than a tenth. Isolated points count as pieces of no length.
[[nodiscard]] std::vector<SizeSource> narrow_places(const DividedOutline& divided, const Triangulated& triangulated,
                                                    const GradedSize& size, Deadline& deadline);

}  // namespace temper::mesher
