// A packed tree of boxes that finds the triangle of a mesh that a point is in, or nearest to. Boxes are in space; for a
// mesh of the plane they are flat.
//
// Triangles are sorted along a Hilbert curve; each box holds kFan consecutive ones of them, each box above kFan
// consecutive boxes. The shape of the tree follows from the number of triangles, so nothing but the boxes is stored.
#pragma once

#include <cstddef>
#include <vector>

#include "temper/mesh.hpp"

namespace temper {

/// The triangles of a mesh along a Hilbert curve through their middles.
[[nodiscard]] std::vector<TriangleId> along_curve(const Mesh& mesh);

/// The point of a triangle that is nearest to a given point.
struct NearestPoint {
  TriangleId triangle;
  double distance2 = 0;  ///< 0: the point asked for is in the triangle or on its boundary, decided exactly
  HalfedgeId edge;       ///< else, the edge that the nearest point is on,
  double along = 0;      ///< and where: 0 at its origin, 1 at its target
};

class BoxTree {
 public:
  BoxTree() = default;
  explicit BoxTree(const Mesh& mesh);

  /// The triangle nearest to p; of equally near ones always the same. Precondition: `mesh` is the mesh that the tree
  /// was made from, with at least one triangle.
  [[nodiscard]] NearestPoint nearest(const Mesh& mesh, const WeightedPoint& p) const;

 private:
  struct Box {
    Vec3 low, high;
  };
  /// The given point, and its position.
  struct Asked {
    WeightedPoint point;
    Vec3 place;
  };
  [[nodiscard]] static Box box_of(const Mesh& mesh, TriangleId t);
  [[nodiscard]] static Box around(const Box& a, const Box& b);
  [[nodiscard]] static NearestPoint nearest_in(const Mesh& mesh, TriangleId t, const Asked& p);
  [[nodiscard]] static double distance2(const Box& box, Vec3 p);
  void search(const Mesh& mesh, const Asked& p, std::size_t level, std::size_t box, NearestPoint& best) const;

  std::vector<TriangleId> triangles_;
  std::vector<std::vector<Box>> levels_;  // boxes of triangles first, the root last
};

}  // namespace temper
