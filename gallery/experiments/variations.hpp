// The variations of Algorithm 1 that §5.2 names with a verdict, and those that §7 proposes without one, on the dense
// horseshoe.
#pragma once

#include <vector>

#include "gallery.hpp"

namespace temper::gallery {

[[nodiscard]] std::vector<Claim> claims_on_variations(Effort effort);

}  // namespace temper::gallery
