// The mesh of a run, while its connectivity changes.
#pragma once

#include <span>
#include <vector>

#include "tets/optimize/newton_step.hpp"
#include "tets/topology/cavity.hpp"

namespace temper::tets {

struct Draft {
  TetMesh mesh;
  Names names;
  IdVector<VertexId, Mobility> mobility;  ///< of the vertices by name
  std::size_t flips = 0;                  ///< changes without a new or removed vertex

  Draft() = default;
  Draft(TetMesh start, IdVector<VertexId, Mobility> mobility_of_start)
      : mesh(std::move(start)), names(mesh), mobility(std::move(mobility_of_start)) {}

  [[nodiscard]] Mobility mobility_of(VertexId v) const { return mobility[names.vertices[v]]; }
  [[nodiscard]] IdVector<VertexId, Mobility> mobilities() const;
  /// Fills cavities, which share no tetrahedron. False, and no change: the mesh cannot be built.
  bool fill(std::span<const Filling> fillings);
};

/// Some tetrahedra of a mesh, as a mesh of their own. All changes inside it fit into the whole: the vertices that other
/// tetrahedra have, too, do not change, nor do faces and lines among them.
struct Patch {
  Draft draft;
  std::vector<TetId> tetrahedra;            ///< of the whole mesh
  IdVector<VertexId, VertexId> vertices;    ///< in the whole mesh, by name
  std::vector<std::uint32_t> faces, lines;  ///< tagged ones in the whole mesh, by name
};

/// The tetrahedra are different, and connected across faces. O(n)
[[nodiscard]] Patch patch_of(const Draft& whole, std::vector<TetId> tetrahedra);

/// Puts patches back, which share no tetrahedron. False, and no change: the mesh cannot be built. O(n)
bool put_back(std::span<const Patch> patches, Draft& whole);

}  // namespace temper::tets
