// Operators as files: NumPy, Matrix Market, VTU (docs/operators.md names every file and array); and columns of cells
// under layers, as MODFLOW 6 and TOUGH read them (docs/layers.md).
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "temper/dec.hpp"
#include "temper/detail/columns.hpp"
#include "temper/detail/error.hpp"
#include "temper/io.hpp"
#include "temper/mesh.hpp"

namespace temper {

class Executor;

namespace io {

enum class DecFormat {
  npz,  ///< operators.npz, all arrays; d0.npz, d1.npz, star0.npz, star1.npz, star2.npz for scipy.sparse.load_npz
  mtx,  ///< d0.mtx, d1.mtx, star0.mtx, star1.mtx, star2.mtx, transmissibility.mtx, orthocenters.mtx, edge_midpoints.mtx
  vtu,  ///< dual.vtu, the power cells as polygons; dual_edges.vtu, the dual edges as lines; columns.vtu, prisms
  // Of columns alone:
  disv,   ///< mesh.disv: MODFLOW 6's discretization by vertices
  disu,   ///< mesh.disu: MODFLOW 6's discretization by connections
  tough,  ///< MESH: elements and connections of TOUGH2, TOUGH3 and iTOUGH2
};
[[nodiscard]] bool needs_columns(DecFormat format);

struct DecWriteOptions {
  std::vector<DecFormat> formats = {DecFormat::npz, DecFormat::mtx, DecFormat::vtu};
  std::span<const std::size_t> points = {};  ///< point of the file of each vertex, from 0; empty: the same numbers
  double z = 0;                              ///< common height of all points, in VTU
  const Columns* columns = nullptr;          ///< what is written of layers; null: nothing
  const InputNames* names = nullptr;         ///< the user's numbers of vertices, for errors
  Executor* executor = nullptr;              ///< threads that compress; the bytes written do not depend on them
};

/// The names of the files that a format makes in its folder, with columns or without.
[[nodiscard]] std::span<const std::string_view> dec_file_names(DecFormat format, bool has_columns = false);

/// Writes the operators into a folder, which is made when it is not there. Every file goes to a temporary one first,
/// and they are renamed when all are complete: on an error nothing that was there has changed. Returns the files'
/// paths. Errors: formats of columns without these; cells of several polygons or none, which DISV has no place for;
/// more cells than TOUGH has names for. Precondition: `complex`, `cells` and columns are those of the mesh.
[[nodiscard]] Expected<std::vector<std::string>> write_dec(const std::string& folder, const Mesh& mesh,
                                                           const DecComplex& complex, const PowerCells& cells,
                                                           const DecWriteOptions& options = {});

/// Reads layers: a CSV file with a title line and a row for each vertex, by its number in the file of the mesh.
///
///     vertex,top,bottom 1,bottom 2,active 1,active 2        lines that begin with # are comments
///     *,10,5,0,1,1                                          what holds where nothing else is said
///     17,12,,nan,1,1                                        empty: as of *; nan: a surface that is not there
///
/// Columns `active` may be left out, and so may the row * or all others. Errors name line, column and vertex.
[[nodiscard]] Expected<Layers> read_layers(const std::string& path, const MeshFile& file, const LoadedMesh& loaded);

}  // namespace io
}  // namespace temper
