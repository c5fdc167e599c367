// The kinds of cells that a mesh has, or that an option, a word or a value is for.
#pragma once

#include <cstddef>
#include <string_view>

namespace temper {

/// One kind, or a set of them: a bit for each.
enum class CellKinds : unsigned {
  triangles = 1,  ///< Triangles of the plane or the sphere
  tetrahedra = 2,
  both = 3,      ///< Triangles and tetrahedra
  surfaces = 4,  ///< Triangles of a curved surface
  all_triangles = 5,
  all = 7,
};

[[nodiscard]] constexpr CellKinds operator|(CellKinds a, CellKinds b) {
  return static_cast<CellKinds>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}

/// "triangles", "curved surfaces", "triangles and tetrahedra", …
[[nodiscard]] constexpr std::string_view name(CellKinds kinds) {
  constexpr std::string_view kNames[] = {"nothing",
                                         "triangles",
                                         "tetrahedra",
                                         "triangles and tetrahedra",
                                         "curved surfaces",
                                         "triangles and curved surfaces",
                                         "tetrahedra and curved surfaces",
                                         "all"};
  return kNames[static_cast<std::size_t>(kinds)];
}

/// The content of a mesh of one kind, for messages: "triangles", "tetrahedra", "a curved surface".
[[nodiscard]] constexpr std::string_view name_of_mesh(CellKinds kind) {
  return kind == CellKinds::surfaces ? "a curved surface" : name(kind);
}

/// Says whether something for `kinds` is also for a mesh of `mesh`, which is one kind.
[[nodiscard]] constexpr bool fits(CellKinds kinds, CellKinds mesh) {
  return (static_cast<unsigned>(kinds) & static_cast<unsigned>(mesh)) != 0;
}

}  // namespace temper
