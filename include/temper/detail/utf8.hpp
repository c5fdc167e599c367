// Bytes of unknown encoding as UTF-8. printable() (temper/detail/error.hpp) is for terminals.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace temper {

/// The text with the bytes that are not UTF-8 as characters of Latin-1. Nothing if all are UTF-8.
[[nodiscard]] std::optional<std::string> recoded(std::string_view text);

}  // namespace temper
