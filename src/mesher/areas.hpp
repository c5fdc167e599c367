// The areas inside the outline, enclosed by its edges, and the sides of each edge on which they lie.
//
// Found once, on the triangulation of the outline itself. A triangulation of the divided outline, with any points
// inside, then gets its areas from its pieces.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mesher/deadline.hpp"
#include "mesher/divided_outline.hpp"
#include "temper/mesher.hpp"

namespace temper::mesher {

inline constexpr std::int32_t kOutside = -1;

/// An area: a part of the inside that is connected without crossing an edge.
struct Area {
  std::int32_t region = 0;
  double size = 0;    ///< edge length wanted
  double extent = 0;  ///< of the sphere, the part that it is; of the plane nothing
};

struct Areas {
  std::vector<Area> areas;
  std::vector<std::array<std::int32_t, 2>> sides;  ///< of each edge: the area on its left and right, or kOutside
  std::optional<std::string> warning;              ///< enclosed areas became holes, but no option asked for it
};

/// The areas that the outline encloses, or on the sphere the areas of its parts; without any, the whole sphere.
/// `largest`: size of areas that have none of their own. Errors: nothing enclosed, hole and region points on an edge or
/// outside, parts that overlap, holes outside their shells or in each other, a domain that touches itself at a point.
/// On the sphere also parts that enclose half of it, and holes.
[[nodiscard]] Expected<Areas> find_areas(const Surface& surface, const Outline& outline, const Arrangement& arrangement,
                                         const MesherOptions& options, double largest, Deadline& deadline);

/// If the inside touches itself at a place, it is divided there: each further fan gets a place of its own, half the
/// tolerance inwards. A note says so. An error without a tolerance.
[[nodiscard]] std::optional<InputError> split_touching(const Surface& surface, Arrangement& arrangement,
                                                       const Areas& areas, double within, const OutlineNames& names);

/// The triangulation of points and pieces over their convex hull, with the area and piece of each triangle and
/// halfedge. If the points leave half of a sphere empty, it has further vertices after all others.
struct Triangulated {
  static constexpr std::uint32_t kNoPiece = 0xffffffffu;
  Mesh mesh;
  IdVector<TriangleId, std::int32_t> area;    ///< or kOutside
  IdVector<HalfedgeId, std::uint32_t> piece;  ///< or kNoPiece
};
/// Further points are numbered after the points of the divided outline. ErrorCode::stopped when it is time to stop.
[[nodiscard]] Expected<Triangulated> triangulate(const Surface& surface, const DividedOutline& divided,
                                                 const std::vector<Vec3>& further, const Areas& areas,
                                                 Deadline& deadline);

}  // namespace temper::mesher
