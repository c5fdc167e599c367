// The optimizer works on coordinates near the origin with size about 1, and gives back the user's coordinates.
//
// Scaling is exact, by a power of two. An axis is centered only if every coordinate on it is within a factor of two of
// the center c. Then x − c is exact (Sterbenz), and so is the inverse. Positions that move are rounded to the user's
// grid, (x + c) − c, so that exact decisions here hold there, too. The sphere stays around the origin. So does a
// periodic plane along its periods; there positions are rounded to the grid of images (space.hpp). Vertices may leave
// its domain; in the user's units they are back in it.
#pragma once

#include "temper/mesh.hpp"

namespace temper {

struct WorkingUnits {
  Vec2 center;       ///< in the user's units; 0 on the sphere
  Vec2 rounding;     ///< added to a moved position and subtracted again, in these units
  double scale = 1;  ///< user's length of one unit here; a power of two
  Space space;       ///< the mesh's space in the user's units

  /// The units of a mesh in the user's coordinates.
  [[nodiscard]] static WorkingUnits of(const Mesh& mesh);

  /// Convert into these units and back. Vertices that did not move come back bit for bit.
  void enter(Mesh& mesh) const;
  void leave(Mesh& mesh) const;

  /// Converts a point to the user's units, into the domain of periods, and back. This is exact on the user's grid. The
  /// sign of a zero is kept, while −0 + 0 would be +0.
  [[nodiscard]] WeightedPoint to_user(const WeightedPoint& p) const {
    const double x = p.x * scale, y = p.y * scale;
    return space.in_domain({center.x == 0 ? x : x + center.x, center.y == 0 ? y : y + center.y, p.w * unit_of_third()});
  }
  [[nodiscard]] WeightedPoint from_user(const WeightedPoint& p) const {
    const double inverse = 1 / scale;
    return {(p.x - center.x) * inverse, (p.y - center.y) * inverse, p.w / unit_of_third()};
  }
  /// Returns the unit, in the user's terms, of the third number of a vertex: a weight, or Z.
  [[nodiscard]] double unit_of_third() const { return space.is_plane() ? scale * scale : scale; }

  /// Returns the nearest position that the user's coordinates can hold, in the plane.
  [[nodiscard]] Vec2 snap(Vec2 p) const { return {(p.x + rounding.x) - rounding.x, (p.y + rounding.y) - rounding.y}; }
  /// Snaps a vertex; the sphere has no such grid.
  [[nodiscard]] WeightedPoint snap(const WeightedPoint& p) const {
    if (!space.is_plane()) return p;
    const auto [x, y] = snap(p.position());
    return {x, y, p.w};
  }
};

/// On the sphere, a new weight rounds the place of its vertex, and a move rounds the weight. If only rounding has
/// changed a place or weight, the vertex gets the input's value again. `vertices`: the input's number of each vertex,
/// invalid for new vertices; empty if all numbers are equal.
void take_back_rounding(const Mesh& input, const IdVector<VertexId, VertexId>& vertices, Mesh& mesh);

}  // namespace temper
