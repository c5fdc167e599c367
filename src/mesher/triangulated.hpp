// Constrained Delaunay triangulations of outlines.
#pragma once

#include <cstdint>
#include <vector>

#include "mesher/deadline.hpp"
#include "mesher/divided_outline.hpp"
#include "temper/mesh.hpp"

namespace temper::mesher {

inline constexpr std::int32_t kOutside = -1;
inline constexpr std::uint32_t kNoPiece = 0xffffffffu;

/// The triangulation of the convex hull, and for every halfedge on a piece that piece. If the points leave half of a
/// sphere empty, it has further vertices after all others.
struct Hull {
  Mesh mesh;
  IdVector<HalfedgeId, std::uint32_t> piece;  ///< or kNoPiece
};
/// ErrorCode::stopped when it is time to stop.
[[nodiscard]] Expected<Hull> triangulate_hull(const Surface& surface, const std::vector<Vec3>& points,
                                              const std::vector<Piece>& pieces, Deadline& deadline);

/// A hull with the area of each triangle.
struct Triangulated : Hull {
  IdVector<TriangleId, std::int32_t> area;  ///< or kOutside
};
/// Further points are numbered after the points of the divided outline. `sides`: the areas on the left and right of
/// each edge. ErrorCode::stopped when it is time to stop.
[[nodiscard]] Expected<Triangulated> triangulate(const Surface& surface, const DividedOutline& divided,
                                                 const std::vector<Vec3>& further,
                                                 const std::vector<std::array<std::int32_t, 2>>& sides,
                                                 Deadline& deadline);

/// Calls f(next) for each neighbor of a triangle that no piece separates from it.
template <class F>
void each_neighbor(const Hull& hull, TriangleId t, const F& f) {
  for (int k = 0; k < 3; ++k) {
    const HalfedgeId h = Mesh::halfedge(t, k);
    if (hull.piece[h] == kNoPiece && !hull.mesh.is_boundary(h)) f(Mesh::triangle(hull.mesh.twin(h)));
  }
}

}  // namespace temper::mesher
