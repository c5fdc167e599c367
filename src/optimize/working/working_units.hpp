// The optimizer works on coordinates near the origin and of size about 1, and gives back the user's.
//
// Scaling is by a power of two, so exact. An axis is centered only when every coordinate on it is within a factor
// of two of the center c: then x − c is exact (Sterbenz), and so is the way back. Positions that move are
// rounded to the user's grid, (x + c) − c, so that what was decided exactly here holds there. The sphere stays around
// the origin. So does a periodic plane along its periods, where positions are rounded to the grid of images
// (space.hpp); vertices that leave the domain go on as they are, and are back in it in the user's units.
#pragma once

#include "temper/mesh.hpp"

namespace temper {

struct WorkingUnits {
  Vec2 center;       ///< in the user's units; of the sphere 0
  Vec2 rounding;     ///< what is added to a moved position and taken away again, in units of the units
  double scale = 1;  ///< user's length of one unit here; a power of two
  Space space;       ///< of the mesh, in the user's units

  /// The units of a mesh in the user's coordinates.
  [[nodiscard]] static WorkingUnits of(const Mesh& mesh);

  /// Into the units and back. Unmoved vertices come back bit for bit.
  void enter(Mesh& mesh) const;
  void leave(Mesh& mesh) const;

  /// A point of the units in the user's units, in the domain of periods, and back. Exact where the units keeps to the
  /// user's grid, and the sign of a zero is kept: −0 + 0 would be +0.
  [[nodiscard]] WeightedPoint to_user(const WeightedPoint& p) const {
    const double x = p.x * scale, y = p.y * scale;
    return space.in_domain({center.x == 0 ? x : x + center.x, center.y == 0 ? y : y + center.y, p.w * unit_of_third()});
  }
  [[nodiscard]] WeightedPoint from_user(const WeightedPoint& p) const {
    const double inverse = 1 / scale;
    return {(p.x - center.x) * inverse, (p.y - center.y) * inverse, p.w / unit_of_third()};
  }
  /// The user's unit of the third number of a vertex: a weight, or Z.
  [[nodiscard]] double unit_of_third() const { return space.is_plane() ? scale * scale : scale; }

  /// The nearest position that the user's coordinates can hold, in the plane.
  [[nodiscard]] Vec2 snap(Vec2 p) const { return {(p.x + rounding.x) - rounding.x, (p.y + rounding.y) - rounding.y}; }
  /// The same of a vertex; the sphere has no such grid.
  [[nodiscard]] WeightedPoint snap(const WeightedPoint& p) const {
    if (!space.is_plane()) return p;
    const auto [x, y] = snap(p.position());
    return {x, y, p.w};
  }
};

/// On the sphere each change of a weight rounds a vertex's place, and each move its weight: of what has not changed but
/// for that, vertices get the input's again. `vertices`: the input's number of
/// each vertex, no vertex's where it is new; empty: the same.
void take_back_rounding(const Mesh& input, const IdVector<VertexId, VertexId>& vertices, Mesh& mesh);

}  // namespace temper
