// Pieces of one power cell, joined across the sides of triangles into simple polygons.
#pragma once

#include <span>
#include <vector>

#include "dec/division.hpp"

namespace temper {

/// A simple polygon, counter-clockwise, in some chart.
using LocalPolygon = std::vector<Vec2>;
[[nodiscard]] inline double area_of(const LocalPolygon& polygon) {
  return area_of(polygon, [](Vec2 corner) { return corner; });
}

/// The union of pieces of one owner, in a chart that has them all. Pieces that meet along a side of a triangle become
/// one polygon; where that does not come out as simple polygons of the same area (a cell with a hole in it), the pieces
/// as they are.
[[nodiscard]] std::vector<LocalPolygon> join_pieces(const Mesh& mesh, const Chart& chart,
                                                    std::span<const CellPiece> pieces);

}  // namespace temper
