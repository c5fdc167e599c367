// A mesh of the plane with layers below it. Its cells are the columns of power cells on which codes for groundwater and
// reservoirs compute (MODFLOW 6, TOUGH), in one value of flat arrays.
//
//       top ───────────────   surface 0        A cell is the power cell of a vertex, between the surfaces of a layer.
//             layer 0                          Next to it are the cells of the same layer whose power cells it shares a
//    bottom ───────────────   surface 1        face with; the line between their vertices crosses that face at a right
//             layer 1                          angle. Above and below it are cells of its own vertex.
//    bottom ───────────────   surface 2
//
// If a layer has no thickness at a vertex, it is pinched out there. It has no cell, and the cells above and below it
// are neighbors. If a layer is inactive, it has no cell either, and nothing flows through.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "temper/dec.hpp"
#include "temper/detail/error.hpp"
#include "temper/mesh.hpp"

namespace temper {

/// Heights of the surfaces between layers, at each vertex.
struct Layers {
  std::size_t n_layers = 0;
  /// Heights at each vertex [length]: the top and then the bottom of each layer, going down. NaN means no surface; then
  /// the layers above and below it are inactive.
  std::vector<double> surfaces;
  std::vector<std::uint8_t> active;  ///< Activity of each layer at each vertex, 0: inactive; empty: all are active

  [[nodiscard]] std::size_t n_surfaces() const { return n_layers + 1; }
};

/// Returns the fault of the surfaces at a vertex, or nothing. A surface must not be above the surface before it, or
/// infinite.
[[nodiscard]] std::optional<std::string> fault_of_surfaces(std::span<const double> surfaces);

/// The state of a cell, with the numbers of MODFLOW's IDOMAIN.
enum class CellState : std::int8_t { pinched_out = -1, inactive = 0, active = 1 };

struct ColumnOptions {
  double pinch_out = 0;               ///< Layers no thicker than this are pinched out [length]
  const InputNames* names = nullptr;  ///< Numbers of vertices for the user, for errors
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

/// Cell l * n_vertices + v is the cell of vertex v in layer l, both from 0.
struct Columns {
  std::size_t n_vertices = 0, n_layers = 0;
  std::vector<CellState> states;
  /// Surfaces of the cells, always numbers [length]. A missing surface gets the height of the next existing one above
  /// it, or else below it.
  std::vector<double> tops, bottoms;
  std::vector<double> volumes;                ///< Volumes of active cells; 0 for others [length³]
  IdVector<VertexId, double> areas;           ///< Areas of the power cells [length²]
  std::vector<ColumnConnection> connections;  ///< Each connection once, ascending

  [[nodiscard]] std::size_t n_cells() const { return states.size(); }
  [[nodiscard]] std::size_t cell(VertexId v, std::size_t layer) const { return layer * n_vertices + v.index; }
  [[nodiscard]] VertexId vertex(std::size_t cell) const { return VertexId(cell % n_vertices); }
  [[nodiscard]] std::size_t layer(std::size_t cell) const { return cell / n_vertices; }
  [[nodiscard]] bool is_active(std::size_t cell) const { return states[cell] == CellState::active; }
  [[nodiscard]] double center(std::size_t cell) const { return 0.5 * (tops[cell] + bottoms[cell]); }
};

/// Makes the columns of a mesh. Preconditions: `complex` and `cells` belong to the mesh. O(n_vertices n_layers).
/// Errors:
///   - a mesh of the sphere
///   - an edge that is not regular, or a face that is not between its two vertices: two-point fluxes do not allow them
///     (temper optimize makes meshes without them)
///   - surfaces that are not one above the other
///   - 2³¹ cells or more, or no active cell
[[nodiscard]] Expected<Columns> columns(const Mesh& mesh, const DecComplex& complex, const PowerCells& cells,
                                        const Layers& layers, const ColumnOptions& options = {});

}  // namespace temper
