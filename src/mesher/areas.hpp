// The areas inside the outline, enclosed by its edges, and the sides of each edge on which they lie.
//
// Found once, on the triangulation of the outline itself. A triangulation of the divided outline, with any points
// inside, then gets its areas from its pieces.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mesher/arrangement.hpp"
#include "mesher/deadline.hpp"

namespace temper::mesher {

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

/// The areas that the outline encloses, or on the sphere the areas of its parts; without any, the whole sphere. Errors:
/// nothing enclosed, hole and region points on an edge or outside, parts that overlap, holes outside their shells or in
/// each other. On the sphere also parts that enclose half of it, and holes.
[[nodiscard]] Expected<Areas> find_areas(const Problem& problem, const Arrangement& arrangement, Deadline& deadline);

}  // namespace temper::mesher
