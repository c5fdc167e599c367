// Sites on both sides of the pieces that become faces.
//
//      a         The pair a, b of a piece is on one perpendicular, at distances t from the piece that may differ. Their
//      |         weights are |a − q|² − R² with the radius R of a node q at an end of the piece. Both ends give the
//      same
//  q---+----q′   weight, by the choice of the perpendicular. So the bisector of a and b is on the piece, and the powers
//      |         of all sites around q are equal there.
//      b
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesher/domain.hpp"
#include "mesher/face_nodes.hpp"
#include "mesher/triangulated.hpp"

namespace temper::mesher {

struct FaceSite {
  Vec2 at;
  double weight = 0;
  std::int32_t area = kOutside;  ///< that it lies in; kOutside on a line
};

struct FaceSites {
  std::vector<FaceSite> sites;
  std::vector<std::array<std::int32_t, 2>> of_piece;  ///< the sites on the left and right of each piece, or -1
  std::vector<std::uint32_t> crowded;                 ///< nodes with pieces that are too long for sites of their own

  /// The site of a branch on its left or right, as seen from its node.
  [[nodiscard]] std::uint32_t beside(const Branch& b, bool left) const {
    return static_cast<std::uint32_t>(of_piece[b.piece][b.is_outwards == left ? 0 : 1]);
  }
};

/// Distances of things from the pieces of the divided outline.
class PieceDistances {
 public:
  PieceDistances(const Surface& surface, const DividedOutline& divided);
  /// The largest distance t <= most such that from + t · direction is at least 2 t from all pieces that end neither at
  /// `one` nor at `other`.
  [[nodiscard]] double free_way(Vec2 from, Vec2 direction, double most, std::uint32_t one, std::uint32_t other) const;

 private:
  [[nodiscard]] bool is_free(Vec2 p, double radius, std::uint32_t one, std::uint32_t other) const;

  const Surface& surface_;
  const DividedOutline& divided_;
  BoundingBoxTree tree_;
};

/// Two faces that meet at less than 115° share a site between them. Elsewhere each piece has sites of its own: at half
/// of its length, or nearer where another line is near.
[[nodiscard]] FaceSites face_sites(const Domain& domain, const DividedOutline& divided, const FaceNodes& nodes,
                                   const PieceDistances& distances);

/// The weight of a site with the power R² at a node.
[[nodiscard]] inline double weight_at(const FaceNode& node, Vec2 site) {
  return squared_length(site - node.at) - node.radius * node.radius;
}
/// The area on the left of a branch, as seen from its node; or on its right.
[[nodiscard]] inline std::int32_t area_beside(const Domain& domain, const DividedOutline& divided, const Branch& b,
                                              bool left) {
  return domain.areas.sides[divided.pieces[b.piece].edge][b.is_outwards == left ? 0 : 1];
}

}  // namespace temper::mesher
