// Convex polyhedra with three edges at each corner, cut by planes (Powell and Abel, An exact general remeshing scheme
// applied to physically conservative voxelization, J. Comput. Phys. 297, 2015).
//
//          | next[1]         Each corner knows the three corners at its edges, counter-clockwise as seen from
//          o                 outside. A cut puts a new corner on each edge that crosses the plane. Along each face
//        /   \               that is cut, two new corners become neighbors. Corners may coincide: an edge of no
//   next[2]   next[0]        length has no area, and nothing need be decided exactly.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "temper/detail/vec.hpp"

namespace temper::tets {

/// The points x with normal · (x − at) ≥ 0.
struct HalfSpace {
  Vec3 at, normal;
  [[nodiscard]] double side(Vec3 x) const { return dot(normal, x - at); }
  [[nodiscard]] HalfSpace moved(Vec3 step) const { return {at + step, normal}; }
};

class Polyhedron {
 public:
  struct Corner {
    Vec3 at;
    std::array<std::uint32_t, 3> next;
  };

  Polyhedron() = default;
  /// A positive tetrahedron.
  explicit Polyhedron(const std::array<Vec3, 4>& p)
      : corners_{{p[0], {1, 3, 2}}, {p[1], {2, 3, 0}}, {p[2], {0, 3, 1}}, {p[3], {1, 2, 0}}} {}

  [[nodiscard]] const std::vector<Corner>& corners() const { return corners_; }
  [[nodiscard]] bool empty() const { return corners_.empty(); }
  /// Keeps the part in a half-space. Returns whether any was outside.
  bool cut(const HalfSpace& space);
  [[nodiscard]] double volume() const;

 private:
  /// The edge of a corner after the one that comes from another corner, around a face.
  [[nodiscard]] std::size_t turn(std::uint32_t corner, std::uint32_t from) const;
  void join_new_corners(std::uint32_t first);
  void drop_outside(std::uint32_t first);

  std::vector<Corner> corners_;
  std::vector<double> sides_;
  std::vector<std::uint32_t> numbers_;
};

}  // namespace temper::tets
