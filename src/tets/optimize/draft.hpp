// The mesh of a run, while its connectivity changes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tets/mesh/tables.hpp"
#include "tets/optimize/newton_step.hpp"
#include "tets/topology/cavity.hpp"

namespace temper::tets {

struct Draft {
  TetMesh mesh;
  Names names;
  IdVector<VertexId, Mobility> mobility;          ///< of the vertices by name
  std::size_t flips = 0;                          ///< changes without a new or removed vertex
  std::vector<std::array<VertexId, 3>> rim = {};  ///< of a patch: faces to other tetrahedra, by name, both sorted

  Draft() = default;
  Draft(TetMesh start, IdVector<VertexId, Mobility> mobility_of_start)
      : mesh(std::move(start)), names(mesh), mobility(std::move(mobility_of_start)) {}

  [[nodiscard]] const Mobility& mobility_of(VertexId v) const { return mobility[names.vertices[v]]; }
  [[nodiscard]] IdVector<VertexId, Mobility> mobilities() const;
  /// Fills cavities, which share no tetrahedron. False, and no change: the mesh cannot be built.
  bool fill(std::span<const Filling> fillings);
};

/// Some tetrahedra of a mesh, as a mesh of their own. All changes inside fit into the whole: vertices that it shares
/// with other tetrahedra do not change. Faces and lines between them stay.
struct Patch {
  Draft draft;
  std::vector<TetId> tetrahedra;            ///< of the whole mesh
  IdVector<VertexId, VertexId> vertices;    ///< in the whole mesh, by name
  std::vector<std::uint32_t> faces, lines;  ///< tagged ones in the whole mesh, by name
};

/// Makes patches of a mesh, which must not change meanwhile.
class PatchMaker {
 public:
  explicit PatchMaker(const Draft& whole);
  [[nodiscard]] const VertexStars& stars() const { return stars_; }
  /// The tetrahedra are different. O(size of the patch)
  [[nodiscard]] Patch make(std::vector<TetId> tetrahedra);

 private:
  struct Tag {
    VertexId least;  // of the face or line
    std::uint32_t number;
  };
  struct Parts;
  [[nodiscard]] std::vector<std::uint32_t> at(const Patch& patch, const std::vector<Tag>& tags) const;
  void add_tetrahedra(const std::vector<TetId>& tetrahedra, Patch& patch, Parts& parts);
  /// Adds the tagged faces and lines of the tetrahedra.
  void add_tags(Patch& patch, Parts& parts) const;
  [[nodiscard]] std::vector<std::array<VertexId, 3>> rim_of(const std::vector<TetId>& tetrahedra,
                                                            const Parts& parts) const;

  const Draft& whole_;
  VertexStars stars_;
  std::vector<Tag> faces_, lines_;           // by their least vertex
  IdVector<VertexId, std::int32_t> number_;  // of the present patch; −1: not in it
};

/// Puts patches back, which share no tetrahedron. False, and no change: the mesh cannot be built. O(n)
bool put_back(std::span<const Patch> patches, Draft& whole);

}  // namespace temper::tets
