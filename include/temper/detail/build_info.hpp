// What this temper is made of: the text of `temper --version` and the dictionary of `temper.build_info()`.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace temper {

/// One row: "compiler" is "GNU 12.2.0, Release".
struct BuildFact {
  std::string_view name;
  std::string value;
};

/// Version, commit ("unknown" where the sources are no clone), compiler, processor, instruction sets, threads, and the
/// libraries with their versions: those that are linked as they are now, not as they were when temper was built.
[[nodiscard]] std::vector<BuildFact> build_info();

}  // namespace temper
