// Which way a vertex may go: the directions in (x, y, w) that its optimisation works in.
#pragma once

#include <array>
#include <cstdint>

#include "temper/mesh.hpp"
#include "temper/optimize.hpp"

namespace temper {

struct Freedom {
  int n = 0;                                       ///< number of directions
  std::array<std::array<double, 3>, 3> axis = {};  ///< position directions are unit vectors; the weight's is (0, 0, 1)
  [[nodiscard]] bool moves() const { return n > 0 && axis[0][2] == 0; }
};

/// What the place of a vertex allows, whatever the sweep: decided once, since neither the boundary nor constrained
/// edges change in a run.
enum class Mobility : std::uint8_t {
  fixed,    ///< boundary and fixed vertices, and ends, bends and branches of constrained lines
  sliding,  ///< along a straight constrained line
  free,
};
[[nodiscard]] IdVector<VertexId, Mobility> mobilities(const Mesh& mesh, InterfaceVertices interfaces);

/// The directions that a vertex of that mobility is optimised in.
[[nodiscard]] Freedom freedom(const Mesh& mesh, VertexId v, Mobility mobility, Unknowns unknowns);

/// The weight alone.
[[nodiscard]] Freedom weight_only();
/// Without the weight.
[[nodiscard]] Freedom position_part(const Freedom& all);

}  // namespace temper
