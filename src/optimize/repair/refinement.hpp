// Delaunay refinement of a place that has too few vertices: they come to circumcenters of triangles that are large for
// where they are.
//
// But the boundary is never touched: what would come too near to it is not inserted. The
// size wanted at x is the least of s_v + g |x − v| over the vertices v of boundary, constrained edges and rim, s_v
// being the mean length of these edges at v.
#pragma once

#include <array>
#include <optional>
#include <set>
#include <vector>

#include "temper/mesh.hpp"

namespace temper {

class DelaunayRefinement {
 public:
  /// `gradation`: g, the growth of the size with distance.
  DelaunayRefinement(const Mesh& mesh, double gradation);

  /// The place for the next vertex, and the triangle strictly around it; nothing when all are small enough.
  struct Place {
    TriangleId triangle;
    WeightedPoint point;  ///< without a weight
  };
  std::optional<Place> next();
  /// That place cannot be had.
  void refuse(const WeightedPoint& p) { refused_.insert({p.x, p.y, p.w}); }

 private:
  struct Source {
    Vec3 at;
    double size;
  };
  struct Segment {
    Vec3 a, b;
  };
  [[nodiscard]] Vec3 place(VertexId v) const;
  [[nodiscard]] double size(Vec3 x) const;
  [[nodiscard]] bool too_near_to_edges(Vec3 x) const;

  const Mesh& mesh_;
  double gradation_;
  std::vector<Source> sources_;
  std::vector<Segment> segments_;
  std::set<std::array<double, 3>> refused_;
};

}  // namespace temper
