// The cells of finite volumes on a mesh, as polygons with centers: power cells or triangles.
//
//     cells of     center           line between the centers of two neighbors
//     vertices     the vertex       the edge, at a right angle to the face, which is a dual edge
//     triangles    the orthocenter  the dual edge, at a right angle to the face, which is an edge
//
// So a flux between two cells needs nothing but the two values at their centers, if each center is on its own side of
// the face.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "temper/dec.hpp"
#include "temper/detail/vec.hpp"
#include "temper/mesh.hpp"

namespace temper {

/// The elements of a mesh that have a cell each.
enum class CellsOf : std::uint8_t {
  vertices,   ///< Power cells
  triangles,  ///< Triangles, with their orthocenters
};

/// The common face of two cells.
struct CellFace {
  std::uint32_t first = 0, second = 0;  ///< Cells, first < second
  double width = 0;                     ///< Width of the face, > 0 [length]
  /// Distances from the two centers to the line of the face, each > 0 if the center is on the side of its cell
  /// [length].
  double first_distance = 0, second_distance = 0;
};

/// Cells as polygons whose corners are shared points. Cell i is the cell of vertex i or of triangle i. It has one
/// polygon, or several, or none, as in PowerCells. On a sphere the arrays `sphere_…` take the place of the others.
struct CellPolygons {
  CellsOf of = CellsOf::vertices;
  std::vector<Vec2> centers;
  std::vector<Vec3> sphere_centers;  ///< Centers, at the radius
  std::vector<double> areas;         ///< Area of all polygons of each cell. Sum: the area of the domain [length²]
  /// Region of each cell. A power cell may reach into several regions: then it is the region with the largest part of
  /// its area, the lowest number of equal ones.
  std::vector<std::int32_t> regions;
  std::vector<double> region_shares;  ///< Part of the cell's area that lies in its region, 0 to 1
  std::vector<CellFace> faces;        ///< Each face once, ascending; empty on a sphere

  std::vector<std::uint32_t> cells;    ///< Cell of each polygon, ascending
  std::vector<std::size_t> starts;     ///< Starts: polygon p has corners[starts[p]] … corners[starts[p + 1] − 1]
  std::vector<std::uint32_t> corners;  ///< Points of the corners, counter-clockwise
  std::vector<double> polygon_areas;   ///< Area of each polygon, > 0 [length²]
  /// Points, each once. Corners of several cells that differ by rounding alone are one point.
  std::vector<Vec2> points;
  std::vector<Vec3> sphere_points;  ///< Points, at the radius; sides are arcs

  [[nodiscard]] std::size_t n_cells() const { return areas.size(); }
  [[nodiscard]] std::size_t n_polygons() const { return cells.size(); }
  [[nodiscard]] std::span<const std::uint32_t> polygon(std::size_t p) const {
    return std::span(corners).subspan(starts[p], starts[p + 1] - starts[p]);
  }
};

/// The power cells of a mesh as polygons. Precondition: `cells` belong to the mesh. O(n).
[[nodiscard]] CellPolygons cell_polygons(const Mesh& mesh, const PowerCells& cells);
/// The cells of a mesh as polygons. Preconditions: no erased triangles; `complex` is dec_operators(mesh). O(n).
[[nodiscard]] CellPolygons cell_polygons(const Mesh& mesh, const DecComplex& complex, CellsOf of = CellsOf::vertices);

}  // namespace temper
