// Delaunay refinement of a place that has too few vertices.
//
// New vertices go to circumcenters of triangles that are too large, and to midpoints of lines that are too long. If a
// circumcenter is too near to a line, the midpoint of this line is taken instead (J. Ruppert, "A Delaunay refinement
// algorithm for quality 2-dimensional mesh generation", 1995). Lines shorter than their place requires are not split,
// so sharp corners end this, too.
//
// The target size at x is the least s_v + g |x − v| over the vertices v that stay. For a vertex of the boundary, a
// constrained edge or the rim, s_v is the mean length of these edges at v. For another fixed vertex, s_v is the
// distance to what is nearest and stays.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <set>
#include <vector>

#include "temper/mesh.hpp"

namespace temper {

class DelaunayRefinement {
 public:
  struct Sizes {
    double gradation = 1;  ///< g, the growth of the size with distance
    double factor = 1;     ///< of all s_v
  };
  /// `may_split`: says which halfedges of lines may be split.
  DelaunayRefinement(const Mesh& mesh, const Sizes& sizes, std::function<bool(HalfedgeId)> may_split);

  /// The place of a new vertex: in the middle of the line `edge`, or at `point` strictly inside `triangle`.
  struct Place {
    HalfedgeId edge = {};
    TriangleId triangle = {};
    WeightedPoint point = {};  ///< without a weight
  };

  /// Returns the place that needs a vertex most, or none if nothing is too large.
  [[nodiscard]] std::optional<Place> next();
  /// Refuses a place at which no vertex can be inserted.
  void refuse(const Place& place);
  /// Follows an insertion.
  void update() { find_lines(); }

 private:
  struct Source {
    Vec3 at;
    double size;
  };
  struct Line {
    HalfedgeId edge;
    Vec3 a, b;
  };

  void find_lines();
  [[nodiscard]] Vec3 place(VertexId v) const;
  [[nodiscard]] double distance_to_others(VertexId v, const std::vector<int>& n_lines) const;
  [[nodiscard]] double size(Vec3 x) const;
  [[nodiscard]] bool may_split(const Line& line) const;
  [[nodiscard]] HalfedgeId longest_line() const;
  [[nodiscard]] const Line* line_too_near(Vec3 x, double wanted) const;

  const Mesh& mesh_;
  double gradation_;
  std::function<bool(HalfedgeId)> may_split_;
  std::vector<Source> sources_;
  std::vector<Line> lines_;
  std::set<std::array<double, 3>> refused_;  // circumcenters, and midpoints of lines
};

}  // namespace temper
