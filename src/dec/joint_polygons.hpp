// Polygons of triangles with one orthocenter, at the ends of faces (temper/detail/faces.hpp).
//
// Edges inside such a polygon have no dual. In floating point their duals are rounding of either sign, large in the
// coordinates of maps. So operators and power cells take the polygon whole, as one element with one orthocenter.
#pragma once

#include <span>
#include <vector>

#include "temper/mesh.hpp"

namespace temper {

class JointPolygons {
 public:
  explicit JointPolygons(const Mesh& mesh);

  /// Says whether t is part of a polygon of two triangles or more, or has a side on which its orthocenter lies.
  [[nodiscard]] bool has(TriangleId t) const { return !number_.empty() && number_[t] >= 0; }
  /// The largest triangle of the polygon of t, whose orthocenter is that of all; t itself if it is in none.
  [[nodiscard]] TriangleId whole(TriangleId t) const { return has(t) ? at(t).largest : t; }
  /// Says whether both triangles are in one polygon; one of them may be invalid.
  [[nodiscard]] bool are_one(TriangleId a, TriangleId b) const {
    return a.valid() && b.valid() && has(a) && whole(a) == whole(b);
  }
  /// Says whether an edge is inside a polygon.
  [[nodiscard]] bool is_inside(HalfedgeId h) const { return mesh_.is_joint(h) && !mesh_.is_boundary(h); }
  /// Precondition of all others: has(t).
  [[nodiscard]] std::span<const TriangleId> triangles(TriangleId t) const { return at(t).triangles; }
  /// Counter-clockwise.
  [[nodiscard]] std::span<const HalfedgeId> sides(TriangleId t) const { return at(t).sides; }
  [[nodiscard]] bool has_one_region(TriangleId t) const;

 private:
  struct Polygon {
    TriangleId largest;
    std::vector<TriangleId> triangles;
    std::vector<HalfedgeId> sides;
  };
  [[nodiscard]] const Polygon& at(TriangleId t) const { return polygons_[static_cast<std::size_t>(number_[t])]; }
  void add(TriangleId t);
  [[nodiscard]] std::vector<HalfedgeId> sides_of(std::span<const TriangleId> triangles) const;

  const Mesh& mesh_;
  IdVector<TriangleId, std::int32_t> number_;  // of the polygon, or -1; empty without polygons
  std::vector<Polygon> polygons_;
};

}  // namespace temper
