// Figure 32's matrix for ★0 and ★2, which the paper has "not studied to the extent of ★1" (§7).
#pragma once

#include <vector>

#include "gallery.hpp"

namespace temper::gallery {

/// How the runs end, by star.
[[nodiscard]] Table star_table(Effort effort);
/// What figure 32 says of ★1, asked of the other two.
[[nodiscard]] std::vector<Claim> star_claims(Effort effort);

}  // namespace temper::gallery
