// The outline divided into pieces that are small enough to be edges of the mesh.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/bounding_boxes.hpp"
#include "geometry/surface.hpp"
#include "mesher/arrangement.hpp"
#include "mesher/deadline.hpp"
#include "mesher/graded_size.hpp"

namespace temper::mesher {

/// Cosine of 59°: between two edges that meet at less, pieces of equal length leave room for one triangle only.
inline constexpr double kSharpCosine = 0.51;
/// Cosine of 115°: between two faces that meet at less, one site serves both.
inline constexpr double kSharedCosine = -0.4226;

/// A piece of an edge of the outline, small enough to be an edge of the mesh.
struct Piece {
  std::array<std::uint32_t, 2> ends = {};  ///< of DividedOutline::points
  std::uint32_t edge = 0;                  ///< of the arrangement
  bool is_face = false;                    ///< it becomes a face of two power cells
};

/// An edge of the mesh whose dual is a piece of a line, or that a face crosses.
struct SitePair {
  std::array<std::uint32_t, 2> ends = {};
  std::uint32_t edge = 0;  ///< of the arrangement
};

/// A circle that no vertex is placed in.
struct Circle {
  Vec3 center;
  double radius = 0;
};

/// The sites around lines that become faces: vertices with weights (corridors.hpp).
struct Corridors {
  /// Sites around each point of a face, counter-clockwise. All have one power there.
  std::vector<std::vector<std::uint32_t>> polygons;
  std::vector<SitePair> faces;      ///< their duals are the pieces of the lines
  std::vector<SitePair> chords;     ///< edges on a line that a face crosses, and on the boundary at its end
  std::vector<double> weights;      ///< of all points
  std::vector<std::int32_t> areas;  ///< of the site at each point; kOutside if it is on a line, or no site
  std::vector<Vec3> points;         ///< of the faces: no vertex is near
  /// Circles of the points of faces; and around sites of positive weight, since the dual of an edge from there to a
  /// vertex without weight would not cross that edge.
  std::vector<Circle> circles;
};

/// The outline after the division: the points of the outline and of the division, and the pieces between them.
struct DividedOutline {
  std::vector<Vec3> points;  ///< the points of the outline first, with their numbers
  std::vector<Piece> pieces;
  Corridors corridors = {};
};

/// The distance from each point of the outline to the first division of its edges: positive only at sharp corners. All
/// edges of one corner are cut at one distance, so that the triangle in the corner is isosceles.
using CornerRadii = std::vector<double>;

/// The nearest edge to a place that does not end there.
struct NearEdge {
  static constexpr std::uint32_t kNone = 0xffffffffu;
  double distance = 0;
  std::uint32_t edge = kNone;
};
/// If it is nearer than `within`; else none, and that distance.
[[nodiscard]] NearEdge nearest_edge(const Surface& surface, const Arrangement& arrangement, const BoundingBoxTree& tree,
                                    std::size_t place, double within);
[[nodiscard]] BoundingBoxTree tree_of_edges(const Surface& surface, const Arrangement& arrangement);

/// The outline with its edges as pieces.
[[nodiscard]] DividedOutline undivided(const Arrangement& arrangement);

/// Divides every edge so that its pieces follow the size. Ends early when there are more than `most` pieces, or when it
/// is time to stop.
[[nodiscard]] DividedOutline divide(const Arrangement& arrangement, const GradedSize& size, const CornerRadii& corners,
                                    std::size_t most, Deadline& deadline);

/// An estimate of the number of pieces.
[[nodiscard]] double count_pieces(const Surface& surface, const Arrangement& arrangement, double size);

/// Radii that are no larger than the size at places of faces.
[[nodiscard]] CornerRadii within_size(const Arrangement& arrangement, CornerRadii corners, const GradedSize& size);

/// Corners of the outline sharper than kSharpCosine, and places where faces meet lines, with their radii: half of their
/// shortest edge, or a third when that has a sharp corner at its other end, too. They never come near anything that
/// does not belong to the corner. Places that were split from one place do not face each other.
[[nodiscard]] CornerRadii corner_radii(const Surface& surface, const Arrangement& arrangement, double largest);

}  // namespace temper::mesher
