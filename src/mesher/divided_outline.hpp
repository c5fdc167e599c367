// The outline divided into pieces that are small enough to be edges of the mesh.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/bounding_boxes.hpp"
#include "geometry/surface.hpp"
#include "mesher/arrangement.hpp"
#include "mesher/deadline.hpp"
#include "temper/detail/size.hpp"
#include "temper/mesh.hpp"

namespace temper::mesher {

// The target edge length at each place: size(x) = min(wanted(x), min over sources of s + grade · |x − p|).
//
// Sources are the ends of short edges, places where two pieces of the outline face each other, and corners. The minimum
// over all of them is the largest function that is at most s at each and grows no faster than `grade`. If a given size
// field grows faster, its vertices are sources.

struct SizeSource {
  Vec3 at;
  double size = 0;
};

/// The size before grading: the size of a field, with an upper bound.
struct WantedSize {
  double most = 0;
  const SizeField* field = nullptr;  ///< or none

  [[nodiscard]] double at(Vec3 x, const Surface& surface) const {
    return field == nullptr ? most : std::min(most, field->at(surface.vertex(x)).size);
  }
};

class GradedSize {
 public:
  GradedSize(const Surface& surface, std::span<const SizeSource> sources, const WantedSize& wanted, double grade);
  /// O(log n) if sources are spread evenly.
  [[nodiscard]] double operator()(Vec3 x) const;
  [[nodiscard]] bool has_field() const { return wanted_.field != nullptr; }

 private:
  struct Node {
    BoundingBox box;   // of the sources below
    double least = 0;  // size among them
    std::uint32_t begin = 0, end = 0;
    std::uint32_t right = 0;  // the left child follows its parent; 0 for a leaf
  };
  std::uint32_t build(std::size_t begin, std::size_t end);
  [[nodiscard]] double bound(const Node& node, Vec3 x) const;
  void lower(std::uint32_t at, Vec3 x, double& best) const;

  std::vector<SizeSource> sources_;
  std::vector<Node> nodes_;
  const Surface& surface_;
  WantedSize wanted_;
  double grade_;
};

/// Cosine of 59°: between two edges that meet at less, pieces of equal length leave room for one triangle only.
inline constexpr double kSharpCosine = 0.51;

/// A piece of an edge of the outline, small enough to be an edge of the mesh.
struct Piece {
  std::array<std::uint32_t, 2> ends = {};  ///< of DividedOutline::points
  std::uint32_t edge = 0;                  ///< of the arrangement
};

/// The outline after the division: the points of the outline and of the division, and the pieces between them.
struct DividedOutline {
  std::vector<Vec3> points;  ///< the points of the outline first, with their numbers
  std::vector<Piece> pieces;
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

/// Divides every edge so that its pieces follow the size. Ends early when there are more than `most` pieces, or when it
/// is time to stop.
[[nodiscard]] DividedOutline divide(const Surface& surface, const std::vector<Vec3>& points,
                                    const std::vector<OutlineEdge>& edges, const GradedSize& size,
                                    const CornerRadii& corners, std::size_t most, Deadline& deadline);

/// An estimate of the number of pieces.
[[nodiscard]] double count_pieces(const Surface& surface, const std::vector<Vec3>& points,
                                  const std::vector<OutlineEdge>& edges, double size);

/// Corners of the outline sharper than kSharpCosine, and their radii: half of their shortest edge, or a third when that
/// has a sharp corner at its other end, too. They never come near anything that does not belong to the corner. Places
/// that were split from one place do not face each other.
[[nodiscard]] CornerRadii corner_radii(const Surface& surface, const Arrangement& arrangement, double largest);

}  // namespace temper::mesher
