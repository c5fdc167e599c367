// The MPAS mesh of a triangulation, planar or spherical. Its cells are the power cells of the vertices, and its
// vertices the orthocenters.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "temper/dec.hpp"
#include "temper/mesh.hpp"

namespace temper::io {

/// Arrays in MPAS's order, one row after the other. Numbers count from 1; 0: none.
struct MpasArrays {
  std::size_t max_edges = 0;
  std::vector<std::int32_t> cells_on_edge, vertices_on_edge;                                  // 2 an edge
  std::vector<std::int32_t> cells_on_vertex, edges_on_vertex;                                 // 3 a vertex
  std::vector<std::int32_t> n_edges_on_cell, edges_on_cell, cells_on_cell, vertices_on_cell;  // max_edges a cell
  std::vector<std::int32_t> n_edges_on_edge, edges_on_edge;                                   // 2 max_edges an edge
  std::vector<double> weights_on_edge;                                                        // 2 max_edges an edge
  std::vector<double> dc_edge, dv_edge, angle_edge;
  std::vector<double> kite_areas_on_vertex;  // 3 a vertex
  std::vector<std::int32_t> boundary_cell;   // 1 where a cell is cut off by the boundary
};
[[nodiscard]] MpasArrays mpas_arrays(const Mesh& mesh, const DecComplex& complex);

}  // namespace temper::io
