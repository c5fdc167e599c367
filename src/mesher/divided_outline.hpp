// The outline divided into pieces that are small enough to be edges of the mesh.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesher/arrangement.hpp"
#include "mesher/deadline.hpp"
#include "mesher/graded_size.hpp"
#include "temper/mesh.hpp"

namespace temper::mesher {

/// Cosine of 59°: two edges that meet at less leave room for one triangle only between pieces of equal length.
inline constexpr double kSharpCosine = 0.51;

/// A piece of an edge of the outline, small enough to be an edge of the mesh.
struct Piece {
  std::array<std::uint32_t, 2> ends = {};  ///< of DividedOutline::points
  std::uint32_t edge = 0;                  ///< of the arrangement
};

/// The outline after the division: its points and those of the division, and the pieces between them.
struct DividedOutline {
  std::vector<Vec3> points;  ///< those of the outline first, with their numbers
  std::vector<Piece> pieces;
};

/// The distance from each point of the outline at which its edges have their first division: positive at sharp corners
/// only, 0 elsewhere. All edges of one corner are cut at one distance, so that the triangle in the corner is isosceles.
using CornerRadii = std::vector<double>;

/// Divides every edge so that its pieces follow the size. What is left when it is time to stop is divided less.
[[nodiscard]] DividedOutline divide(const Ground& ground, const std::vector<Vec3>& points,
                                    const std::vector<OutlineEdge>& edges, const GradedSize& size,
                                    const CornerRadii& corners, Deadline& deadline);

/// About how many pieces that makes.
[[nodiscard]] double count_pieces(const Ground& ground, const std::vector<Vec3>& points,
                                  const std::vector<OutlineEdge>& edges, double size);

/// Corners of the outline sharper than kSharpCosine, and how far they reach: to a half of their shortest edge (a third
/// when that has a sharp corner at its other end too), and never near anything that does not belong to the corner.
[[nodiscard]] CornerRadii corner_radii(const Ground& ground, const std::vector<Vec3>& points,
                                       const std::vector<OutlineEdge>& edges, double largest);

}  // namespace temper::mesher
