// What the reader and the writer of Triangle's files share.
#pragma once

#include <string>
#include <string_view>

namespace temper::io {

// Comments that declare what the format has no place for.
inline constexpr std::string_view kDeclaration = "# temper attribute ", kDeclaredZ = "# temper z ",
                                  kDeclaredName = "# temper name ";

/// The path of the files without their suffix.
[[nodiscard]] std::string base_of_triangle(const std::string& path);

}  // namespace temper::io
