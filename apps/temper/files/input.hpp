// A mesh that was read: the file, the mesh made of it, and how to call its parts.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

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
  std::string projection = {};  ///< of points in degrees: see projection_option.hpp
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

}  // namespace temper::app
