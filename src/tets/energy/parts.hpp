// Edges and faces with their duals, in parts of one tetrahedron each, and the derivatives of all parts at once.
//
// |σ| |σ*| and |σ| ∫_{σ*} (x − centroid of σ) of an edge or face σ are sums over the tetrahedra around σ, each part
// with the signs of its heights. They are made of orthocenters, and so rational in positions and weights.
//
//       a ──── o      edge σ, seen along it: a and b are the orthocenters of its two faces in the tetrahedron, o is the
//      /       │      orthocenter of the tetrahedron, and x the crossing of σ with the plane of its dual face. The part
//     /        │      is a kite, the triangles x a o and x o b.
//    x ─────── b
//                     face σ: the part of its dual edge leads from the orthocenter of σ to o.
#pragma once

#include <array>
#include <cstddef>

#include "temper/tets/mesh.hpp"

namespace temper::tets {

/// |σ| |σ*|, and |σ| ∫_{σ*} (x − centroid of σ).
struct Offset {
  double volume = 0;
  Vec3 moment;
  friend Offset operator+(const Offset& a, const Offset& b) { return {a.volume + b.volume, a.moment + b.moment}; }
};

/// Quantities of a tetrahedron, or the derivatives of some function by each of them. The edges have
/// the sequence of kEdgeCorners. Face k is opposite corner k.
struct TetParts {
  std::array<Offset, 6> edges;
  std::array<double, 6> along = {};   ///< the crossing, as a part of the edge from its first corner
  std::array<double, 6> square = {};  ///< of the length
  std::array<Offset, 4> faces;
  std::array<double, 4> height = {};  ///< h/ℓ
};

/// A positive tetrahedron, with its orthocenters.
class TetDuals {
 public:
  TetDuals(const TetMesh& mesh, TetId t);

  [[nodiscard]] TetParts parts() const;
  /// The derivatives of a function by the corners, from those by the parts.
  [[nodiscard]] std::array<WeightedPoint, 4> pulled_back(const TetParts& by) const;

 private:
  struct Edge {
    std::size_t i, j, left, right;  // its ends, and the faces of a and b
    Vec3 vector, crossing, middle;
    double square, along;
  };
  [[nodiscard]] Edge edge(std::size_t e) const;

  std::array<Vec3, 4> at_;      // from the first corner
  std::array<Vec3, 4> normal_;  // twice the areas of the faces, inward
  std::array<Vec3, 4> center_;  // orthocenters of the faces
  Vec3 orthocenter_;
  double volume6_;
  std::array<double, 4> weight_;
};

using Gradient = IdVector<VertexId, WeightedPoint>;

/// Adds the derivatives by the corners of a tetrahedron.
inline void add_to(Gradient& gradient, const std::array<VertexId, 4>& corners,
                   const std::array<WeightedPoint, 4>& by_corners) {
  for (std::size_t k = 0; k < 4; ++k) {
    const auto& [x, y, z, w] = by_corners[k];
    WeightedPoint& to = gradient[corners[k]];
    to = {to.x + x, to.y + y, to.z + z, to.w + w};
  }
}

}  // namespace temper::tets
