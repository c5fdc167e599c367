// The version of the linked library.
#pragma once

#include <string_view>

namespace temper {

/// Returns "0.1.0".
[[nodiscard]] std::string_view version();

}  // namespace temper
