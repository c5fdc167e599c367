// Sentences of the gallery as HTML: characters escaped, the paper's symbols set as it sets them.
#pragma once

#include <string>
#include <string_view>

namespace temper::gallery {

/// "E_BP of d_ij < 1" → E<sub>BP</sub> of d<sub>ij</sub> &lt; 1. One letter before the underscore, letters and digits
/// after it; "E_F1" and "E_F^1" are energies of ★1: E<sub>F</sub><sup>1</sup>.
[[nodiscard]] std::string prose(std::string_view text);

/// The text alone, escaped for elements and attributes.
[[nodiscard]] std::string escaped(std::string_view text);

}  // namespace temper::gallery
