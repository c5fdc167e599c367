// The boundary of a mesh from left to right: do its edges cross or touch, does a component lie on another one?
//
// A line sweeps over the boundary edges and keeps those that it crosses in their order on it. Two edges that meet are
// neighbors on the line just before (Shamos and Hoey), so it suffices to look at neighbors. And while none meet,
// each edge that has the mesh above it is followed by one that has it below. The leftmost point that is covered twice
// is a vertex where triangles begin, and just below it the line crosses an edge that has the mesh above it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "temper/mesh.hpp"

namespace temper {

/// Two boundary edges that say that the mesh is not embedded.
struct BoundaryClash {
  enum Kind {
    meeting,  ///< they cross, or touch away from a common vertex
    covered,  ///< triangles begin at the first one's lesser end, and those of the second are there already
  } kind;
  HalfedgeId first, second;
};

/// Finds a clash, in a periodic plane only of edges that meet, the leftmost or one before it; nothing where the
/// boundary is as it should be. Exact. Preconditions: the mesh lies in the plane; stars are whole and wind once, which
/// leaves two boundary edges at a vertex, in different directions. O(m log m) for m boundary edges, whatever their
/// shape.
[[nodiscard]] std::optional<BoundaryClash> find_boundary_clash(const Mesh& mesh);

// The boundary of a mesh of the sphere: do its arcs cross or touch, does a component lie on another one?
//
// A component whose stars wind once and whose boundary loops are simple and apart covers no spot twice. It is mapped to
// the sphere without folds; the b loops cut the sphere into b + 1 regions, and region r is covered d_r times, once more
// on the left of each loop than on its right. Counting Euler characteristics, Σ d_r (2 − loops of r) = 2 − 2g − b for
// genus g, which is Σ d_r (1 − i_r) = 1 − g with i_r the loops that have r on their right. Of regions that are on the
// right of none there is at least one, each covered, and one more than Σ (i_r − 1) over those with i_r ≥ 1; each of
// these is covered less often than those around it. So the sum is at least 1, and it is 1 only when d is 1 in one
// region and 0 in all others. Without boundary the component is a covering of the sphere, which has none but itself.

/// Finds a clash, as find_boundary_clash() does in the plane; of what is `covered`, `first` is any halfedge. Exact.
/// Preconditions: the mesh lies on the sphere; stars are whole and wind once. O(m k + n c) for m boundary edges with k
/// others at their latitude, and c components.
[[nodiscard]] std::optional<BoundaryClash> find_arc_clash(const Mesh& mesh);

/// The number of each triangle's component, and a halfedge of each.
struct MeshPieces {
  IdVector<TriangleId, std::uint32_t> of;
  std::vector<HalfedgeId> first;
};

[[nodiscard]] inline MeshPieces pieces_of(const Mesh& mesh) {
  constexpr std::uint32_t kNone = ~std::uint32_t{0};
  MeshPieces found{IdVector<TriangleId, std::uint32_t>(mesh.n_triangles(), kNone), {}};
  std::vector<TriangleId> waiting;
  for (const TriangleId start : mesh.triangles()) {
    if (found.of[start] != kNone) continue;
    const auto number = static_cast<std::uint32_t>(found.first.size());
    found.first.push_back(Mesh::halfedge(start, 0));
    found.of[start] = number;
    waiting.push_back(start);
    while (!waiting.empty()) {
      const TriangleId t = waiting.back();
      waiting.pop_back();
      for (int k = 0; k < 3; ++k) {
        const HalfedgeId other = mesh.twin(Mesh::halfedge(t, k));
        if (!other.valid() || found.of[Mesh::triangle(other)] != kNone) continue;
        found.of[Mesh::triangle(other)] = number;
        waiting.push_back(Mesh::triangle(other));
      }
    }
  }
  return found;
}

/// Two places where the mesh covers the same spot twice, for an error message.
struct Overlap {
  TriangleId triangle;  ///< one of the triangles involved
  std::string message;  ///< of what lies on what, in the user's names
};

/// Two boundary edges at v in the same direction, said in the user's names: what a hanging node at their ends makes of
/// v. Empty when there are none. O(n), for error messages.
[[nodiscard]] std::string edges_on_each_other(const Mesh& mesh, VertexId v, const InputNames& names);

/// Finds why the mesh is not embedded in its space; nothing when it is. Preconditions: all triangles counter-clockwise,
/// manifold.
///
/// In the plane a connected mesh whose stars wind once and whose boundary loops neither cross nor touch covers every
/// point at most once: the turning numbers of its loops sum to its Euler characteristic, which leaves
/// one outer loop. What then remains is a component inside another one's triangles. (On the sphere:
/// boundary_sweep.hpp.)
[[nodiscard]] std::optional<Overlap> find_overlap(const Mesh& mesh, const InputNames& names,
                                                  Executor* executor = nullptr);

}  // namespace temper
