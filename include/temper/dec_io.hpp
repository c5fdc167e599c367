// Operators as files: NumPy, Matrix Market, VTU (docs/operators.md names every file and array).
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "temper/dec.hpp"
#include "temper/error.hpp"
#include "temper/mesh.hpp"

namespace temper {

class Executor;

namespace io {

enum class DecFormat {
  npz,  ///< operators.npz, all arrays; d0.npz, d1.npz, star0.npz, star1.npz, star2.npz for scipy.sparse.load_npz
  mtx,  ///< d0.mtx, d1.mtx, star0.mtx, star1.mtx, star2.mtx, flux.mtx, orthocenters.mtx, edge_midpoints.mtx
  vtu,  ///< dual.vtu, the power cells as polygons; dual_edges.vtu, the dual edges as lines
};

struct DecWriteOptions {
  std::vector<DecFormat> formats = {DecFormat::npz, DecFormat::mtx, DecFormat::vtu};
  std::span<const std::size_t> points = {};  ///< point of the file of each vertex, from 0; empty: the same numbers
  double z = 0;                              ///< common height of all points, in VTU
  Executor* executor = nullptr;              ///< threads that compress; the bytes written do not depend on them
};

/// The names of the files that a format makes in its folder.
[[nodiscard]] std::span<const std::string_view> dec_file_names(DecFormat format);

/// Writes the operators into a folder, which is made when it is not there. Every file goes to a temporary one first,
/// and they are renamed when all are complete: on an error nothing that was there has changed. Returns the files'
/// paths. Precondition: `complex` and `cells` are those of the mesh.
[[nodiscard]] Expected<std::vector<std::string>> write_dec(const std::string& folder, const Mesh& mesh,
                                                           const DecComplex& complex, const PowerCells& cells,
                                                           const DecWriteOptions& options = {});

}  // namespace io
}  // namespace temper
