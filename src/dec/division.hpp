// A triangle, divided among the vertices whose power cells meet it: the lower envelope of their power distances.
//
// Candidates are the corners of the triangle, then all neighbours of candidates that own some of it, until none is new.
// In a regular triangulation of a convex domain that is enough: a vertex that no neighbour beats at a point is beaten
// there by nobody. A neighbour that one gets to only around a reflex corner of the domain (more than half a turn in the
// fan of that corner) is left out: it lies behind a crack or a notch.
#pragma once

#include <vector>

#include "dec/chart.hpp"

namespace temper {

/// A corner of a piece, and what lies along the side from it to the next corner: one of the two.
struct PieceCorner {
  Vec2 at;           ///< in the plane of the triangle, from its corner 0
  VertexId against;  ///< the side is where the power distances to this vertex and to the owner are equal
  HalfedgeId along;  ///< the side is on this side of the triangle
};

/// The piece of a triangle that a vertex owns: convex, counter-clockwise.
struct CellPiece {
  VertexId owner;
  TriangleId triangle;
  std::vector<PieceCorner> corners;
};

/// Signed area.
/// The area of a polygon; `at` gives the place of a corner.
template <class Corner, class At>
[[nodiscard]] double area_of(const std::vector<Corner>& polygon, At&& at) {
  double doubled = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    doubled += cross(at(polygon[i - 1]) - at(polygon[0]), at(polygon[i]) - at(polygon[0]));
  }
  return 0.5 * doubled;
}
[[nodiscard]] inline double area_of(const std::vector<PieceCorner>& polygon) {
  return area_of(polygon, [](const PieceCorner& corner) { return corner.at; });
}

class TriangleDivider {
 public:
  explicit TriangleDivider(const Mesh& mesh) : mesh_(mesh) {}
  /// The pieces of t, in the order in which their owners were found: its corners first.
  [[nodiscard]] std::vector<CellPiece> divide(TriangleId t);

 private:
  struct Candidate {
    VertexId vertex;
    Vec2 at;  // in the plane of the triangle
    double weight = 0;
    std::vector<PieceCorner> piece;
  };
  void add(VertexId v);
  [[nodiscard]] bool wins_anywhere(const Candidate& added, std::size_t others) const;
  void expand(std::size_t i);
  void clip(std::vector<PieceCorner>& piece, const Candidate& owner, const Candidate& other);

  const Mesh& mesh_;
  std::vector<Candidate> candidates_;  // of the triangle at hand; storage is kept for the next
  std::size_t n_candidates_ = 0;
  std::vector<PieceCorner> whole_;  // the triangle
  std::vector<PieceCorner> scratch_;
  std::vector<double> sides_;  // of the corners of the polygon being clipped
  Chart chart_;
};

}  // namespace temper
