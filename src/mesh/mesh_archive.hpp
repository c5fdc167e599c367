// A mesh in an archive: its arrays as they are in memory, so that all ids mean what they meant.
#pragma once

#include "temper/archive.hpp"
#include "temper/mesh.hpp"

namespace temper {

/// A radius that none can have fails.
void visit(Archive& archive, Space& space);

/// MeshArchive knows what a mesh consists of.
class MeshArchive {
 public:
  static void visit(Archive& archive, Mesh& mesh);
  /// Whether the arrays make a mesh.
  [[nodiscard]] static bool is_whole(const Mesh& mesh);
};

/// When the bytes are not those of a mesh, the archive fails and the mesh is empty. Triangles may be inverted.
inline void visit(Archive& archive, Mesh& mesh) { MeshArchive::visit(archive, mesh); }

inline void visit(Archive& archive, MeshOrder& order) {
  auto& [vertices, triangles] = order;
  archive(vertices, triangles);
}

}  // namespace temper
