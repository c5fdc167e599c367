// The areas inside the outline: those that its edges enclose, and the sides of each edge on which they lie.
//
// Found once, on the triangulation of the outline itself; a triangulation of the divided outline, with whatever points
// inside, then gets its areas from its pieces.
#pragma once

#include <cstdint>
#include <vector>

#include "mesher/deadline.hpp"
#include "mesher/divided_outline.hpp"
#include "temper/mesher.hpp"

namespace temper::mesher {

inline constexpr std::int32_t kOutside = -1;

/// An area: a part of the inside that is connected without crossing an edge.
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
                                         const MesherOptions& options, Deadline& deadline);

/// The triangulation of points and pieces over their convex hull, and what belongs to each triangle and halfedge.
struct Triangulated {
  static constexpr std::uint32_t kNoPiece = 0xffffffffu;
  Mesh mesh;
  IdVector<TriangleId, std::int32_t> area;    ///< or kOutside
  IdVector<HalfedgeId, std::uint32_t> piece;  ///< or kNoPiece
};
/// Further points come after those of the divided outline. ErrorCode::stopped when it is time to stop.
[[nodiscard]] Expected<Triangulated> triangulate(const DividedOutline& divided, const std::vector<Vec2>& further,
                                                 const Areas& areas, Deadline& deadline);

}  // namespace temper::mesher
