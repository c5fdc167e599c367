// Cells around vertices with their connections, for programs of finite volumes: of columns under layers, or the power
// cells of tetrahedra.
#pragma once

#include <cstddef>
#include <vector>

#include "io/operators/dec_files.hpp"

namespace temper::io {

struct FiniteVolumes {
  struct Cell {
    std::size_t number;  ///< counts inactive cells of columns, too
    Vec3 center;
    double volume;
    std::size_t material;  ///< from 1: the layer or the region; 0: none
  };
  /// Two cells and the face between them.
  struct Connection {
    std::size_t first, second;  ///< cells
    double first_distance, second_distance, area;
    bool is_vertical;  ///< from the top of a column down
    Vec3 face;         ///< the point of the face between the centers
  };
  std::vector<Cell> cells;
  std::vector<Connection> connections;
  std::size_t n_numbers = 0;
};

/// The active cells of the columns of the job. Precondition: it has columns.
[[nodiscard]] FiniteVolumes volumes_of(const DecJob& job);
/// Cells of vertices, with connections along all edges whose dual face has an area. The material is the region that has
/// the most volume among the tetrahedra at the vertex.
[[nodiscard]] FiniteVolumes volumes_of(const TetDecJob& job);

void write_volumes_tough(const DecFolder& folder, const FiniteVolumes& volumes);
/// The name of a cell in TOUGH: five characters.
[[nodiscard]] std::string tough_name(std::size_t cell);
void write_volumes_pflotran(const DecFolder& folder, const FiniteVolumes& volumes);

}  // namespace temper::io
