// Files of tetrahedral meshes: the same formats, readers and rules as temper/io.hpp, with a dimension more.
//
// A file with tetrahedra gives a TetFile. Its triangles, lines and points are tags of faces, edges and vertices.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "temper/io.hpp"
#include "temper/tets/mesh.hpp"

namespace temper::io {

struct TetFile {
  std::vector<Vec3> points;
  std::vector<double> weights;                          ///< One weight per point, or empty
  std::vector<std::array<std::int32_t, 4>> tetrahedra;  ///< Corners of each tetrahedron, 0-based
  std::vector<std::int32_t> regions;                    ///< One region per tetrahedron, or empty
  std::vector<std::array<std::int32_t, 3>> faces;       ///< Tagged faces, on the boundary or inside
  std::vector<std::int32_t> face_tags;                  ///< One tag per face
  std::vector<std::array<std::int32_t, 2>> lines;       ///< Tagged lines
  std::vector<std::int32_t> line_tags;                  ///< One tag per line
  std::vector<std::int32_t> marked_points;              ///< Points that carry a tag
  std::vector<std::int32_t> point_tags;                 ///< One tag per marked point
  std::vector<PhysicalName> names;
  std::vector<DataArray> point_data;                  ///< Data with one tuple per point
  std::vector<DataArray> cell_data;                   ///< Data with one tuple per tetrahedron
  std::vector<DataArray> face_data;                   ///< Data with one tuple per face
  std::vector<DataArray> line_data;                   ///< Data with one tuple per line
  std::vector<DataArray> marked_point_data;           ///< Data with one tuple per marked point
  std::vector<DataArray> field_data;                  ///< Data of the file as a whole
  std::string path;                                   ///< Path of the file that was read, for messages
  std::string format;                                 ///< Name of the row of formats() that read the file
  std::vector<std::string> warnings;                  ///< Warnings about what was dropped or repaired in reading
  std::shared_ptr<const tets::InputNames> numbering;  ///< Numbers and lines of the file, for errors
};

/// Reads a mesh of triangles or of tetrahedra; the content decides.
[[nodiscard]] Expected<std::variant<MeshFile, TetFile>> read_any(const std::string& path,
                                                                 const ReadOptions& options = {});

/// Writes as write() of triangles does. Formats: those whose row says `holds_tetrahedra`.
[[nodiscard]] Expected<std::vector<std::string>> write(const std::string& path, const TetFile& file,
                                                       const WriteOptions& options = {});

/// The error that write() of tetrahedra would return for this name and format, before a long run.
[[nodiscard]] Expected<void> check_tetrahedra_to_write(const std::string& path, const std::string& format = {});

/// The mesh of a file. Points of no tetrahedron are dropped, and a warning names them. Negative tetrahedra are reversed
/// and counted in a warning. Warnings name faces and lines that are no face or edge of the mesh.
struct LoadedTetMesh {
  tets::TetMesh mesh;
  VertexOfPoint vertex_of_point;
  std::vector<std::string> warnings;
};
[[nodiscard]] Expected<LoadedTetMesh> make_mesh(const TetFile& file, Executor* executor = nullptr);

/// Puts points, weights, tetrahedra and regions of a mesh back into the file that it came from, by the rules of
/// update() of triangles. `loaded` is the mesh of the file, unchanged, and `origins` says where the parts of the mesh
/// are in it. Data are linear on the tetrahedra of the file. In the report, triangles are tetrahedra. O(n) if points
/// move little.
DataReport update(TetFile& file, const LoadedTetMesh& loaded, const tets::TetMesh& mesh,
                  const tets::Origins& origins = {}, const UpdateOptions& options = {});

/// Frees points, weights and tetrahedra of a file after make_mesh(); update() writes them again. It does nothing if
/// points were dropped. The memory goes back to the system.
void release_geometry(TetFile& file, const LoadedTetMesh& loaded);

}  // namespace temper::io
