// The kinds of cells that a mesh has, or that an option, a word or a value is for.
#pragma once

#include <string_view>

namespace temper {

enum class CellKinds { triangles, tetrahedra, both };

/// "triangles", "tetrahedra", "both".
[[nodiscard]] constexpr std::string_view name(CellKinds kinds) {
  constexpr std::string_view kNames[] = {"triangles", "tetrahedra", "both"};
  return kNames[static_cast<std::size_t>(kinds)];
}

/// Says whether something for `kinds` is also for a mesh of `mesh`, which is not `both`.
[[nodiscard]] constexpr bool fits(CellKinds kinds, CellKinds mesh) { return kinds == CellKinds::both || kinds == mesh; }

}  // namespace temper
