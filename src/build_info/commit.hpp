// The commit of the sources. Each build writes commit.cpp again if the commit has changed (commit.cmake).
#pragma once

#include <string_view>

namespace temper {

/// The first 12 digits of its hash, plus "with changes" if files differ from it; "unknown" outside of a clone.
[[nodiscard]] std::string_view commit();

}  // namespace temper
