// Data of cells over a change of the mesh, with their integrals kept.
//
// A cell is a triangle, a tetrahedron, or the power cell of a vertex within the domain. Data are constant on each cell,
// as in finite volumes. The integral of u over a region is Σ u_c |c ∩ region|. After a change, a cell gets the mean of
// the former cells that it overlaps, by the sizes of the overlaps:
//
//     u_n = Σ |n ∩ o| u_o / |n|            n a new cell, o the former cells
//
//      +-------+-------+     The new cell n (dashed) overlaps the former cells a and b. Each part of b goes to exactly
//      |   a - | - b   |     one new cell, so the integral stays. A mean is between the least and the largest of its
//      |  :  n |   :   |     values. A cell that has not changed keeps its value, bit for bit.
//      |   - - | - -   |
//      +-------+-------+
//
// Two things are left over. A power cell on an interface has parts in two regions, but one value. And if vertices have
// slid along a curved boundary, the size of a region has changed. conserve() then closes the sum of each region.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "temper/detail/cells.hpp"
#include "temper/mesh.hpp"

namespace temper {

class Executor;

/// The part of a cell in a region.
struct CellPart {
  std::uint32_t cell = 0;
  std::int32_t region = 0;
  double size = 0;  ///< Area or volume; 0: the cell is of no size, and only takes a value
};

/// The part of a former cell in a cell of the new mesh.
struct CellShare {
  std::uint32_t former = 0;
  double size = 0;
};

/// The overlaps of the cells of two meshes of one domain.
struct CellOverlaps {
  std::size_t n_cells = 0;          ///< Cells of the new mesh; each has at least one part
  std::vector<CellPart> parts;      ///< Parts of the new cells, ascending by cell and region
  std::vector<std::size_t> starts;  ///< Part p has shares[starts[p]] … shares[starts[p + 1] − 1], at least one
  std::vector<CellShare> shares;    ///< Overlaps with former cells in the same region, ascending for each part
  std::vector<CellPart> former;     ///< Parts of the former cells, ascending by cell and region
};

/// Returns the overlaps of the cells of two meshes of the same space. Areas on the sphere are of polygons of great
/// circles. Precondition: no erased triangles. About O(n), with a few microseconds for each triangle.
[[nodiscard]] CellOverlaps overlaps(const Mesh& before, const Mesh& after, CellsOf of, Executor* executor = nullptr);

/// Values of the new cells, and how far the two promises hold.
struct Conserved {
  std::vector<double> values;
  /// Largest change of the integral over a region or over the domain, over the integral of |u| there. Some roundings,
  /// unless a region has no cell of its own that could take what is missing.
  double change = 0;
  /// Farthest that a value is outside the range of the former values, over the largest |u|. 0, unless the size of a
  /// region or of the domain has changed.
  double beyond = 0;
};

/// Returns the values of the new cells for finite values of the former ones.
///
/// The integral of a region may then lack an amount. It goes to cells that lie in this region alone. Each cell gets a
/// share in proportion to the distance of its value from a bound. The bounds are first the least and the largest value
/// that the cell has taken. Next they are those of the region. If this is not enough, and the size of the region has
/// changed, each value changes in proportion to its magnitude. Then the domain gets the same treatment. O(n).
[[nodiscard]] Conserved conserve(const CellOverlaps& overlaps, std::span<const double> former);

}  // namespace temper
