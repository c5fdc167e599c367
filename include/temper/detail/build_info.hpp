// The build of this temper: the text of `temper --version` and the dictionary of `temper.build_info()`.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace temper {

/// One row, such as "compiler" with "GNU 12.2.0, Release".
struct BuildFact {
  std::string_view name;
  std::string value;
};

/// Returns version, commit ("unknown" if the sources are no clone), compiler, processor, instruction sets, threads, and
/// the libraries with their versions. These are the versions linked now, not those at build time.
[[nodiscard]] std::vector<BuildFact> build_info();

}  // namespace temper
