// A mesh of the plane with layers below it: the columns of power cells that codes for groundwater and reservoirs
// compute on (MODFLOW 6, TOUGH), in one value of flat arrays.
//
//       top ───────────────   surface 0        A cell is the power cell of a vertex, between the surfaces of a layer.
//             layer 0                          Beside it are the cells of the same layer whose power cells it shares a
//    bottom ───────────────   surface 1        face with; the line between their vertices crosses that face at a right
//             layer 1                          angle. Above and below it are those of its own vertex.
//    bottom ───────────────   surface 2
//
// A layer that has no thickness at a vertex is pinched out there: it has no cell, and what is above and what is below
// it are neighbors. Where a layer is inactive there is no cell either, and nothing goes through.
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
  /// Of each vertex the top and then the bottom of each layer, going down [length]. NaN: a surface that is not there;
  /// the layers above and below it are inactive.
  std::vector<double> surfaces;
  std::vector<std::uint8_t> active;  ///< of each vertex each layer, 0: inactive; empty: all are active

  [[nodiscard]] std::size_t n_surfaces() const { return n_layers + 1; }
};

/// What is wrong with the surfaces at a vertex, or nothing: one that is above the one before it, or infinite.
[[nodiscard]] std::optional<std::string> fault_of_surfaces(std::span<const double> surfaces);

/// With the numbers of MODFLOW's IDOMAIN.
enum class CellState : std::int8_t { pinched_out = -1, inactive = 0, active = 1 };

struct ColumnOptions {
  double pinch_out = 0;               ///< layers are pinched out where they are not thicker than this [length]
  const InputNames* names = nullptr;  ///< the user's numbers of vertices, for errors
};

/// Two active cells and the face between them.
struct ColumnConnection {
  std::uint32_t first = 0, second = 0;  ///< cells; first < second, and above it when the connection is vertical
  bool is_vertical = false;
  double first_distance = 0;   ///< from the center of the first cell to the face, > 0 [length]
  double second_distance = 0;  ///< from that of the second
  double width = 0;            ///< of the face seen from above; 0 of vertical ones [length]
  /// Of the face [length²]. Beside each other: the width times the thickness there, which is linear between the two
  /// centers. One below the other: the area of the power cell.
  double area = 0;
};

/// Cell l * n_vertices + v is that of vertex v in layer l, both from 0.
struct Columns {
  std::size_t n_vertices = 0, n_layers = 0;
  std::vector<CellState> states;
  /// Surfaces of the cells, all of them numbers: one that is not there is at the height of the next above it that is,
  /// or else below it. [length]
  std::vector<double> tops, bottoms;
  std::vector<double> volumes;                ///< of active cells; 0 of others [length³]
  IdVector<VertexId, double> areas;           ///< of the power cells [length²]
  std::vector<ColumnConnection> connections;  ///< each once, ascending

  [[nodiscard]] std::size_t n_cells() const { return states.size(); }
  [[nodiscard]] std::size_t cell(VertexId v, std::size_t layer) const { return layer * n_vertices + v.index; }
  [[nodiscard]] VertexId vertex(std::size_t cell) const { return VertexId(cell % n_vertices); }
  [[nodiscard]] std::size_t layer(std::size_t cell) const { return cell / n_vertices; }
  [[nodiscard]] bool is_active(std::size_t cell) const { return states[cell] == CellState::active; }
  [[nodiscard]] double center(std::size_t cell) const { return 0.5 * (tops[cell] + bottoms[cell]); }
};

/// The columns of a mesh. Errors: a mesh of the sphere; an edge that is not regular, or a face that is not between its
/// two vertices, which two-point fluxes have no place for (temper optimize makes meshes without); surfaces that are not
/// one above the other; 2³¹ cells or more; none that is active. Preconditions: `complex` and `cells` are those of the
/// mesh. O(n_vertices n_layers).
[[nodiscard]] Expected<Columns> columns(const Mesh& mesh, const DecComplex& complex, const PowerCells& cells,
                                        const Layers& layers, const ColumnOptions& options = {});

}  // namespace temper
