// The version of the library that is linked.
#pragma once

#include <string_view>

namespace temper {

/// "0.1.0"
[[nodiscard]] std::string_view version();

}  // namespace temper
