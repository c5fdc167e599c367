// VTU files of one piece.
#pragma once

#include <vector>

#include "io/formats/vtk/vtk_arrays.hpp"

namespace temper::io {

struct VtuPiece {
  VtkArray points;
  std::vector<VtkArray> cells;  ///< connectivity, offsets, types, and what polyhedra have
  std::vector<VtkArray> point_data = {}, cell_data = {}, field_data = {};
};
/// Every array is made block by block, and only the compressed blocks of one array are kept until its header is known.
/// The executor's threads compress, if there is one.
void write_piece(Output& out, const VtuPiece& piece, Encoding encoding, Executor* executor);

}  // namespace temper::io
