// Vertices for a place that has too few: circumcenters of triangles that are large for where they are.
//
// As in Delaunay refinement, but the boundary is never touched: what would come too near to it is not inserted. The
// size wanted at x is the least of s_v + g |x − v| over the vertices v of boundary, constrained edges and rim, s_v
// being the mean length of these edges at v.
#pragma once

#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "temper/mesh.hpp"

namespace temper {

class Fill {
 public:
  /// `gradation`: g, the growth of the size with distance.
  Fill(const Mesh& mesh, double gradation);

  /// Where the next vertex should come to be, and the triangle strictly around that; nothing when all are small enough.
  struct Place {
    TriangleId triangle;
    Vec2 position;
  };
  std::optional<Place> next();
  /// That place cannot be had.
  void refuse(Vec2 position) { refused_.insert({position.x, position.y}); }

 private:
  struct Source {
    Vec2 at;
    double size;
  };
  struct Segment {
    Vec2 a, b;
  };
  [[nodiscard]] double size(Vec2 x) const;
  [[nodiscard]] bool too_near_to_edges(Vec2 x) const;

  const Mesh& mesh_;
  double gradation_;
  std::vector<Source> sources_;
  std::vector<Segment> segments_;
  std::set<std::pair<double, double>> refused_;
};

}  // namespace temper
