// The degrees of freedom of a vertex: the directions in (x, y, w) in which it may move; on the sphere in its chart.
#pragma once

#include <array>
#include <cstdint>

#include "temper/mesh.hpp"
#include "temper/optimize.hpp"

namespace temper {

/// Two edges are one straight line when they turn by less than this (radians). Coordinates from a file, or rounded by
/// earlier slides, are not exactly collinear.
inline constexpr double kStraight = 1e-9;

struct Dofs {
  int n = 0;                                       ///< number of directions
  std::array<std::array<double, 3>, 3> axis = {};  ///< position directions are unit vectors; the weight's is (0, 0, 1)
  [[nodiscard]] bool moves() const { return n > 0 && axis[0][2] == 0; }
  [[nodiscard]] bool weighs() const { return n > 0 && axis[static_cast<std::size_t>(n - 1)][2] != 0; }
};

/// The mobility that its place gives a vertex in all sweeps. It is decided once, since moves keep the lines of the
/// boundary and of constrained edges.
enum class Mobility : std::uint8_t {
  frozen,   ///< neither position nor weight: the rim of a neighborhood, and vertices around faces that must stay
  fixed,    ///< fixed by the user; a corner of the boundary; an end, bend or branch of a constrained line; or on a line
            ///< on which the options forbid sliding
  sliding,  ///< along a straight piece of the boundary, or of a constrained line
  free,
};
[[nodiscard]] Mobility mobility(const Mesh& mesh, VertexId v, const OptimizeOptions& options);
[[nodiscard]] IdVector<VertexId, Mobility> mobilities(const Mesh& mesh, const OptimizeOptions& options,
                                                      Executor* executor = nullptr);

/// Returns the directions in which a vertex with this mobility is optimized.
[[nodiscard]] Dofs dofs(const Mesh& mesh, VertexId v, Mobility mobility, Unknowns unknowns);
/// Returns the directions of a vertex that slides along this unit vector.
[[nodiscard]] Dofs dofs(Vec2 direction, Unknowns unknowns);

}  // namespace temper
