// An envelope around bytes, by which they are known again: "KIND, version 1.2.3\n", their number, they, a checksum.
#pragma once

#include <string>
#include <string_view>

#include "temper/error.hpp"

namespace temper {

[[nodiscard]] std::string in_envelope(std::string_view kind, std::string_view bytes);

/// The bytes of an envelope of that kind. Errors, without where: another kind of file; one of another version of
/// temper, whose bytes may mean something else; one that was cut off, or is longer than it was, or damaged.
[[nodiscard]] Expected<std::string_view> from_envelope(std::string_view kind, std::string_view envelope);

}  // namespace temper
