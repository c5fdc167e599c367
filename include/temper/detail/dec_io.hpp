// Operators as files: NumPy, Matrix Market and VTU (docs/reference/operators.md names every file and array). Also
// columns of cells under layers, for MODFLOW 6 and TOUGH (docs/reference/formats/layers.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "temper/dec.hpp"
#include "temper/detail/cells.hpp"
#include "temper/detail/columns.hpp"
#include "temper/detail/error.hpp"
#include "temper/io.hpp"
#include "temper/mesh.hpp"
#include "temper/tets/operators.hpp"

namespace temper {

class Executor;

namespace io {

enum class DecFormat {
  // Files of tetrahedra also have d2 and star3.
  npz,  ///< Files operators.npz, all arrays; d0.npz, d1.npz, star0.npz, star1.npz, star2.npz for scipy.sparse.load_npz
  mtx,  ///< Files d0.mtx, d1.mtx, star0.mtx, star1.mtx, star2.mtx, transmissibility.mtx, orthocenters.mtx,
        ///< edge_midpoints.mtx
  vtu,  ///< Files dual.vtu, the power cells as polygons; dual_edges.vtu, the dual edges as lines; columns.vtu, prisms
  // These need columns:
  disv,  ///< Files mesh.disv, MODFLOW 6's discretization by vertices; mesh.disv.csv, the cells of groups;
         ///< mesh.disv.hfb,
         ///< the barriers
  disu,  ///< Files mesh.disu, MODFLOW 6's discretization by connections; mesh.disu.csv; mesh.disu.hfb
  // These need columns, or tetrahedra, whose cells are the power cells of vertices:
  tough,  ///< Files MESH, elements and connections of TOUGH2, TOUGH3 and iTOUGH2; of columns MESH.csv, too
  uge,    ///< File mesh.uge, PFLOTRAN's explicit unstructured grid
};

enum class GroupKind {
  point,     ///< Marked points, such as wells
  line,      ///< Lines inside the domain, such as rivers
  boundary,  ///< Lines on its boundary
};

/// A cell that a named group touches.
struct GroupCell {
  std::string name;  ///< Physical name, or the number of a tag without a name
  GroupKind kind = GroupKind::point;
  std::uint32_t cell = 0;  ///< Cell as seen from above: the number of its vertex or triangle
  double length = 0;       ///< Length of the lines of the group in the cell [length]; 0 for points
};

/// The cells of all marked points and lines, by kind, tag and cell. A cell is once for each name and kind, so lengths
/// of a group add up to the length of its lines. A point lies in one power cell, but in all triangles around it. A line
/// between two triangles lies half in each. Lines that only list the edges of the mesh are left out. Precondition for
/// power cells: all edges of the mesh are regular, as in columns().
[[nodiscard]] std::vector<GroupCell> cells_of_groups(const MeshFile& file, const LoadedMesh& loaded, const Mesh& mesh,
                                                     CellsOf of = CellsOf::vertices);

/// A barrier to flow on the common face of two cells, such as a piece of a fault.
struct Barrier {
  std::string name;                     ///< Name for comments, such as of the fault; may be empty
  std::uint32_t first = 0, second = 0;  ///< Cells as seen from above: the numbers of vertices or triangles
  /// Hydraulic characteristic: the conductivity of the barrier over its width [1/time]. If it is negative, its absolute
  /// value is a factor on the conductance between the two cells.
  double characteristic = 0;
};

/// The barriers on tagged lines, in the order of the names. For triangles each edge of the line is one, between the
/// triangles on its two sides. For power cells the line must be faces (temper/detail/faces.hpp), and each is one.
/// `characteristics` has the value of each line, by name or tag. Edges on the boundary of the domain have no barrier.
/// Errors: no inner line has the name or tag; it is not faces of these cells; a value that is not finite.
[[nodiscard]] Expected<std::vector<Barrier>> barriers_of_lines(
    const MeshFile& file, const LoadedMesh& loaded, const Mesh& mesh,
    std::span<const std::pair<std::string, double>> characteristics, CellsOf of);

/// A piece of a line that is a face of two power cells.
struct LineFace {
  VertexId first, second;  ///< Vertices of the two cells. The first is on the left of the way between the ends
  Vec2 from, to;           ///< Ends of the face
  double length = 0;
};

/// The faces on a tagged line, by its name or tag, in the order of the lines of the file. Errors: no inner line has the
/// name or tag; it is not faces of power cells (temper/detail/faces.hpp). Precondition: the mesh is in the plane.
[[nodiscard]] Expected<std::vector<LineFace>> faces_of_line(const MeshFile& file, const LoadedMesh& loaded,
                                                            const Mesh& mesh, const std::string& name);

struct DecWriteOptions {
  std::vector<DecFormat> formats = {DecFormat::npz, DecFormat::mtx, DecFormat::vtu};
  std::span<const std::size_t> points = {};  ///< Point of the file for each vertex, from 0; empty: the same numbers
  double z = 0;                              ///< Common height of all points, in VTU
  const Columns* columns = nullptr;          ///< Columns to write; null: none
  /// Cells of groups, for the tables beside the columns; absent: no tables
  std::optional<std::span<const GroupCell>> groups = {};
  /// Barriers, for MODFLOW's HFB package beside the columns; each is in all layers in which both cells are active.
  /// Absent: no file
  std::optional<std::span<const Barrier>> barriers = {};
  const InputNames* names = nullptr;  ///< Numbers of vertices for the user, for errors
  Executor* executor = nullptr;       ///< Threads that compress; the bytes written do not depend on them
};

/// A format writes one of these kinds into a folder.
enum class DecKind { triangles, columns, tetrahedra };

/// Says whether a format writes columns only.
[[nodiscard]] bool needs_columns(DecFormat format, DecKind kind = DecKind::triangles);

/// The names of the files that a format writes into its folder.
[[nodiscard]] std::span<const std::string_view> dec_file_names(DecFormat format, DecKind kind = DecKind::triangles);

/// Writes the operators into a folder, which is created if it does not exist. Every file is first a temporary file.
/// When all are complete, they are renamed: an error leaves everything unchanged. Returns the paths of the files.
/// Errors: formats that need columns, without columns; cells with several polygons or none, which DISV does not allow;
/// a barrier between cells without a common face; more cells than TOUGH has names for. Precondition: `complex`, `cells`
/// and columns belong to the mesh.
[[nodiscard]] Expected<std::vector<std::string>> write_dec(const std::string& folder, const Mesh& mesh,
                                                           const DecComplex& complex, const PowerCells& cells,
                                                           const DecWriteOptions& options = {});

/// Writes the operators of tetrahedra in the same way. Error: formats that need columns.
[[nodiscard]] Expected<std::vector<std::string>> write_dec(const std::string& folder, const tets::TetMesh& mesh,
                                                           const tets::DecComplex& complex,
                                                           const DecWriteOptions& options = {});

/// Writes the operators of a curved surface in the same way; `cells` are its dual cells. Error: formats that need
/// columns.
[[nodiscard]] Expected<std::vector<std::string>> write_dec(const std::string& folder, const surfaces::SurfaceMesh& mesh,
                                                           const DecComplex& complex, const PowerCells& cells,
                                                           const DecWriteOptions& options = {});

/// Writes the operators of an intrinsic triangulation as NPZ alone. Its edges have lengths, and nothing has a place.
[[nodiscard]] Expected<std::vector<std::string>> write_dec(const std::string& folder,
                                                           const surfaces::IntrinsicMesh& mesh,
                                                           const DecComplex& complex,
                                                           std::span<const std::size_t> points = {});

/// Reads layers: a CSV file with a title line and a row for each vertex, by its number in the file of the mesh.
///
///     vertex,top,bottom 1,bottom 2,active 1,active 2        lines that begin with # are comments
///     *,10,5,0,1,1                                          values for all other vertices
///     17,12,,nan,1,1                                        empty: as of *; nan: a surface that is not there
///
/// The columns `active` may be left out. The row * or all others may be left out. Errors name line, column and vertex.
[[nodiscard]] Expected<Layers> read_layers(const std::string& path, const MeshFile& file, const LoadedMesh& loaded);

}  // namespace io
}  // namespace temper
