// The commit of the sources: commit.cpp is written anew with each build where it has changed (commit.cmake).
#pragma once

#include <string_view>

namespace temper {

/// The first 12 digits of its hash, and "with changes" where files differ from it; "unknown" outside of a clone.
[[nodiscard]] std::string_view commit();

}  // namespace temper
