// A mesh that was read: the file, the mesh made of it, how to call its parts, and what a user names in it.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "exit.hpp"
#include "temper/io.hpp"
#include "temper/mesh.hpp"

namespace temper::app {

struct Input {
  std::string path;
  io::MeshFile file;
  io::LoadedMesh loaded;
  std::size_t n_vertices = 0;               ///< of the mesh as it was read
  std::vector<std::size_t> points;          ///< mesh vertex → point of the file, both from 0; empty: the same
  std::shared_ptr<const InputNames> names;  ///< the file's own numbers of the mesh's vertices and triangles

  [[nodiscard]] const Mesh& mesh() const { return loaded.mesh; }
  /// The file's own number of a vertex, as text.
  [[nodiscard]] std::string vertex_number(VertexId v) const;
  [[nodiscard]] std::string triangle_number(TriangleId t) const;
  /// Warnings of reading and of building.
  [[nodiscard]] std::vector<std::string> warnings() const;
};

/// How a file is read.
struct ReadingOptions {
  std::string projection = {};  ///< of points in degrees: as --projection has it
  std::vector<std::string> fixed_tags = {};
  Executor* executor = nullptr;
  bool spheres = false;  ///< meshes of the sphere are taken too
  /// Where the file comes from; none: from the disk.
  std::function<io::MeshFile(const std::string& path)> read = {};
};
/// Reads a file and builds its mesh; Failure when anything is wrong with it.
[[nodiscard]] Input read_input(const std::string& path, const ReadingOptions& options = {});

/// Failure when the mesh is one of the sphere, which `what` is not for.
void expect_plane(const Mesh& mesh, const std::string& path, std::string_view what);

/// The projection of another file that is to be on the same map: with the center that was chosen for this one.
[[nodiscard]] std::string same_projection(const Input& input, const std::string& projection);

/// The text with each vertex number in it ("vertex 3", "edge 3-9") called by another name.
[[nodiscard]] std::string renumber(const std::string& text, const std::function<std::string(VertexId)>& name);

/// The file's own numbers for the vertices of a mesh, when points of the file that no triangle uses were dropped, and
/// names for vertices that the file does not have.
class VertexNames final : public InputNames {
 public:
  /// points: mesh vertex → point of the file; empty: the same. n_vertices: of the file's mesh; those after are new.
  VertexNames(std::shared_ptr<const InputNames> file, std::vector<std::size_t> points, std::size_t n_vertices);
  [[nodiscard]] std::string point(std::size_t index) const override;
  [[nodiscard]] std::string triangle(std::size_t index) const override;
  [[nodiscard]] std::string point_where(std::size_t index) const override;
  [[nodiscard]] std::string triangle_where(std::size_t index) const override;

 private:
  [[nodiscard]] std::size_t in_file(std::size_t index) const;
  std::shared_ptr<const InputNames> file_;
  std::vector<std::size_t> points_;
  std::size_t n_vertices_;
};

/// The library's sentence with the option as it is called here.
[[nodiscard]] std::string spell_projection(std::string message);

/// Failure, with the cure, where the points of an outline are in degrees and no projection is chosen.
void expect_projection_of_outline(const std::string& path, bool geographic, const std::string& projection);

/// The points of a mesh on the map that is chosen, or the sphere; as they are where none is needed. Failure, with the
/// cure, where they are in degrees and none is chosen.
void take_to_map(io::MeshFile& file, const std::string& path, const std::string& projection);

/// Edges that a user names. "all": all inside the mesh; "lines": those on tagged lines and between regions; else a path
/// of a file with two vertices a line, as the mesh file counts them. Failure when the file cannot be read or names
/// something else than edges of the mesh, with its line; or when no edge is inside the mesh.
[[nodiscard]] std::vector<HalfedgeId> prescribed_edges(const std::string& which, const Input& input);

/// JSON from anywhere is nested deeper than whatever temper writes. Looked at before it is parsed: what prints or drops
/// a value goes down into it, and a file must not decide how much of the stack that takes.
inline constexpr int kDeepestJson = 16;
[[nodiscard]] bool is_too_deep(std::string_view json);

/// io::read(), of a file of HDF5 (NetCDF-4, VTKHDF) first in a child process: on a damaged one libhdf5 may loop for
/// ever or crash, and then only the child does. Failure when the file cannot be used, or does not get through the child
/// under its budget of time and memory. What comes through a pipe can be read once only: it is read at once.
[[nodiscard]] io::MeshFile read_tried(const std::string& path, Executor* executor);

}  // namespace temper::app
