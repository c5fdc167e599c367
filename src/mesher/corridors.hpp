// Corridors: what lines that become faces of power cells are in the outline that points are placed around.
//
//   a0-----a1-----a2     The line q0 q1 q2 … becomes faces. Around each node q there is a polygon of sites, such as
//    | q1 / | q2 / |     a0 a1 b1 b0, and all have one power at q. So q is the orthocenter of its triangles, and the
//    dual
//   -|-·-/--|-·-/--|-    of a1 b1 goes from q1 to q2. This holds whatever the mesh is outside the polygons.
//    |  /   |  /   |     Polygons are holes for the placement of points. Their sides are pieces of the outline.
//   b0-----b1-----b2
//
// Where lines meet, sites of all pieces make one polygon around the node. A tip has closing sites beyond it. A line
// that stays edges has a site on both sides of a node; the face crosses the edge between them, or ends there.
#pragma once

#include <optional>

#include "mesher/divided_outline.hpp"
#include "mesher/domain.hpp"

namespace temper::mesher {

/// Pieces at a node that are too long: sites of different nodes disturb each other.
struct LongPieces {
  std::size_t place = 0;  ///< the point of the node in the divided outline: a place of the outline, or a number above
  Vec3 at;
  double length = 0;  ///< of the shortest one
};

/// An outline with corridors: nodes are no points of it, and sites are.
struct Laid {
  DividedOutline divided;
  Domain domain;
  std::vector<LongPieces> too_long;  ///< if there are some, the rest is no outline
  /// Pieces with a site that is not in its own cell: faces of it do not cross the lines between centers. Shorter ones
  /// may be better.
  std::vector<LongPieces> outside_cells;
};

[[nodiscard]] bool has_faces(const Domain& domain);

/// The first line that cannot become faces, with place and reason: on a sphere or with few points, at named points, at
/// corners of the boundary, at bends of borders, at branches of other lines, at angles below 1 degree.
[[nodiscard]] std::optional<InputError> check_faces(const Problem& problem, const Domain& domain);

/// Warnings of lines that end on a face, and become shorter, or bend there, and cut the bend.
void warn_of_lines_at_faces(const Problem& problem, Domain& domain);

/// Precondition: check_faces() found nothing.
[[nodiscard]] Laid lay_corridors(const Problem& problem, const Domain& domain, const DividedOutline& divided);

/// The pieces stay too long at a place.
[[nodiscard]] InputError no_room_for_faces(const Problem& problem, const Domain& domain, Vec3 place);

}  // namespace temper::mesher
