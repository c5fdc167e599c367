// The points of the divided outline on lines that become faces, with the pieces that meet there.
#pragma once

#include <cstdint>
#include <vector>

#include "mesher/divided_outline.hpp"

namespace temper::mesher {

/// A piece, as seen from a node that it ends at.
struct Branch {
  std::uint32_t piece = 0;
  std::uint32_t far = 0;     ///< the point at its other end
  bool is_outwards = false;  ///< the piece begins at the node
  bool is_face = false;
  Vec2 direction;  ///< of length 1
  double length = 0;
  double reach = 0;  ///< its sites are at this distance, measured along the piece
};

/// All sites around a node have the power R² there, with the radius R.
struct FaceNode {
  std::uint32_t point = 0;
  Vec2 at;
  std::vector<Branch> branches;  ///< counter-clockwise
  double radius = 0;             ///< R
  double size = 0;               ///< length of the shortest branch that is a face

  /// The branch after i, counter-clockwise.
  [[nodiscard]] std::size_t after(std::size_t i) const { return (i + 1) % branches.size(); }
  /// The angle from branch i to the next one, in (0, 2π].
  [[nodiscard]] double angle_after(std::size_t i) const;
  [[nodiscard]] std::size_t count_lines() const;  ///< branches that are no faces
};

/// The angle from u to v, counter-clockwise, in (0, 2π].
[[nodiscard]] double angle_between(Vec2 u, Vec2 v);

struct FaceNodes {
  std::vector<FaceNode> nodes;
  std::vector<std::int32_t> of_point;  ///< of each point of the divided outline, or -1

  [[nodiscard]] const FaceNode* at(std::uint32_t point) const {
    return of_point[point] < 0 ? nullptr : &nodes[static_cast<std::size_t>(of_point[point])];
  }
};

/// Finds the nodes, and chooses their radii and reaches. Sites on a piece of length L between radii R and R′ are at
/// (L² + R² − R′²)/(2 L) from its beginning. The radii are 0.6 of the shortest piece, so this is between 0.32 and 0.68
/// of L. At a joint all pieces that are faces have one reach, and then any angles may be between them.
[[nodiscard]] FaceNodes face_nodes(const DividedOutline& divided);

}  // namespace temper::mesher
