// A mesh of the plane with layers below it. Its cells are the columns of power cells or triangles on which codes for
// groundwater and reservoirs compute (MODFLOW 6, TOUGH), in one value of flat arrays.
//
//       top ───────────────   surface 0        A column is below a power cell or a triangle (temper/detail/cells.hpp).
//       A
//             layer 0                          cell is the part of it between the surfaces of a layer. Next to it are
//    bottom ───────────────   surface 1        the cells of the same layer that it shares a face with; the line between
//             layer 1                          their centers crosses that face at a right angle. Above and below it are
//    bottom ───────────────   surface 2        cells of its own column.
//
// If a layer has no thickness in a column, it is pinched out there. It has no cell, and the cells above and below it
// are neighbors. If a layer is inactive, it has no cell either, and nothing flows through.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "temper/dec.hpp"
#include "temper/detail/cells.hpp"
#include "temper/detail/error.hpp"
#include "temper/mesh.hpp"

namespace temper {

/// Heights of the surfaces between layers, in each column.
struct Layers {
  std::size_t n_layers = 0;
  /// Heights in each column [length]: the top and then the bottom of each layer, going down. NaN means no surface; then
  /// the layers above and below it are inactive.
  std::vector<double> surfaces;
  std::vector<std::uint8_t> active;  ///< Activity of each layer in each column, 0: inactive; empty: all are active

  [[nodiscard]] std::size_t n_surfaces() const { return n_layers + 1; }
};

/// The layers below triangles from layers at vertices. A height is the mean of the three corners, so volumes are those
/// between surfaces that are linear on triangles. A layer is active if it is at all three.
[[nodiscard]] Layers layers_of_triangles(const Mesh& mesh, const Layers& at_vertices);

/// Returns the fault of the surfaces of a column, or nothing. A surface must not be above the surface before it, or
/// infinite.
[[nodiscard]] std::optional<std::string> fault_of_surfaces(std::span<const double> surfaces);

/// The state of a cell, with the numbers of MODFLOW's IDOMAIN.
enum class CellState : std::int8_t { pinched_out = -1, inactive = 0, active = 1 };

struct ColumnOptions {
  double pinch_out = 0;               ///< Layers no thicker than this are pinched out [length]
  const InputNames* names = nullptr;  ///< Numbers of vertices and triangles for the user, for errors
};

/// Two active cells and the face between them.
struct ColumnConnection {
  std::uint32_t first = 0, second = 0;  ///< Cells with first < second; in a vertical connection the first is above
  bool is_vertical = false;
  double first_distance = 0;   ///< Distance from the center of the first cell to the face, > 0 [length]
  double second_distance = 0;  ///< Distance from the center of the second cell
  double width = 0;            ///< Width of the face seen from above; 0 if vertical [length]
  /// Area of the face [length²]. For cells next to each other it is the width times the thickness there, which is
  /// linear between the two centers. For cells above each other it is the area of the power cell.
  double area = 0;
};

/// Cell l * n_columns() + i is the cell of column i in layer l, both from 0. Column i is below cell i of `plan`.
struct Columns {
  CellPolygons plan;  ///< The columns as seen from above
  std::size_t n_layers = 0;
  std::vector<CellState> states;
  /// Surfaces of the cells, always numbers [length]. A missing surface gets the height of the next existing one above
  /// it, or else below it.
  std::vector<double> tops, bottoms;
  std::vector<double> volumes;                ///< Volumes of active cells; 0 for others [length³]
  std::vector<ColumnConnection> connections;  ///< Each connection once, ascending

  [[nodiscard]] std::size_t n_cells() const { return states.size(); }
  [[nodiscard]] std::size_t n_columns() const { return plan.n_cells(); }
  [[nodiscard]] std::size_t cell(std::size_t column, std::size_t layer) const { return layer * n_columns() + column; }
  [[nodiscard]] std::size_t column(std::size_t cell) const { return cell % n_columns(); }
  [[nodiscard]] std::size_t layer(std::size_t cell) const { return cell / n_columns(); }
  [[nodiscard]] bool is_active(std::size_t cell) const { return states[cell] == CellState::active; }
  [[nodiscard]] double center(std::size_t cell) const { return 0.5 * (tops[cell] + bottoms[cell]); }
};

/// Makes the columns of a mesh. Preconditions: `complex` and `plan` belong to the mesh. O(n_columns n_layers).
/// Errors:
///   - a mesh of the sphere
///   - power cells: an edge that is not regular
///   - a face that is not between the centers of its two cells: two-point fluxes do not allow it (temper optimize makes
///     meshes without such edges and faces)
///   - surfaces that are not one above the other
///   - 2³¹ cells or more, or no active cell
[[nodiscard]] Expected<Columns> columns(const Mesh& mesh, const DecComplex& complex, CellPolygons plan,
                                        const Layers& layers, const ColumnOptions& options = {});

}  // namespace temper
