// What is inside: the areas that the edges of the outline enclose, and on which sides of each edge they lie.
//
// Found once, on the triangulation of the outline itself; a triangulation of the divided outline, with whatever points
// inside, then gets its areas from its pieces.
#pragma once

#include <cstdint>
#include <vector>

#include "mesher/border.hpp"
#include "temper/mesher.hpp"

namespace temper::mesher {

inline constexpr std::int32_t kOutside = -1;

/// What is connected without crossing an edge, and inside.
struct Area {
  std::int32_t region = 0;
  double size = 0;  ///< edge length wanted
};

struct Areas {
  std::vector<Area> areas;
  std::vector<std::array<std::int32_t, 2>> sides;  ///< of each edge: the area on its left and right, or kOutside
};

/// Errors: nothing enclosed, hole and region points on an edge or outside, parts that overlap.
[[nodiscard]] Expected<Areas> find_areas(const Outline& outline, const std::vector<OutlineEdge>& edges,
                                         const MesherOptions& options);

/// The triangulation of points and pieces over their convex hull, and what belongs to each triangle and halfedge.
struct Triangulated {
  static constexpr std::uint32_t kNoPiece = 0xffffffffu;
  Mesh mesh;
  IdVector<TriangleId, std::int32_t> area;    ///< or kOutside
  IdVector<HalfedgeId, std::uint32_t> piece;  ///< or kNoPiece
};
/// Further points come after those of the border.
[[nodiscard]] Expected<Triangulated> triangulate(const Border& border, const std::vector<Vec2>& further,
                                                 const Areas& areas);

}  // namespace temper::mesher
