// The mesh as JavaScript holds it: by an address, with the file that it came from.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "temper/io.hpp"
#include "temper/mesh.hpp"

namespace temper::wasm {

/// The file that a mesh came from: all that is not in the mesh.
struct Source {
  io::MeshFile file;
  io::LoadedMesh loaded;  ///< its mesh is taken
};

class HeldMesh {
 public:
  explicit HeldMesh(Mesh mesh) : mesh(std::move(mesh)) {}
  /// The mesh of a file, which stays behind it. `warnings`: what was repaired or dropped in reading is added.
  [[nodiscard]] static Expected<std::unique_ptr<HeldMesh>> of_file(io::MeshFile file,
                                                                   const std::vector<std::string>& fixed_tags,
                                                                   std::vector<std::string>& warnings);

  /// Puts another mesh in place. `vertices`: former number of each vertex, invalid for inserted ones; empty when they
  /// are the same.
  void replace(Mesh other, const IdVector<VertexId, VertexId>& vertices, std::vector<double> weights = {});
  /// The file it came from with the mesh as it is now, or a new one.
  [[nodiscard]] io::MeshFile file() const;

  Mesh mesh;
  /// Weight of each corner of each triangle, three each, where tensors differ; empty: the weights of the vertices.
  std::vector<double> corner_weights;

 private:
  std::shared_ptr<const Source> source_;
  IdVector<VertexId, VertexId> origin_;  // number in the source of each vertex; empty: the same
};

}  // namespace temper::wasm
