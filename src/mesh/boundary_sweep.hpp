// The boundary of a mesh from left to right: do its edges cross or touch, does a component lie on another one?
//
// A line sweeps over the boundary edges and keeps the edges that it crosses in their order on it. Two edges that meet
// are neighbors on the line just before (Shamos and Hoey), so it suffices to look at neighbors. While none meet, an
// edge with the mesh above it is followed by one with the mesh below it. The leftmost point that is covered twice is a
// vertex where triangles begin. Just below it the line crosses an edge that has the mesh above it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "temper/mesh.hpp"

namespace temper {

/// Two boundary edges that prove that the mesh is not embedded.
struct BoundaryClash {
  enum Kind {
    meeting,  ///< they cross, or touch away from a common vertex
    covered,  ///< triangles begin at the first edge's lesser end, inside triangles of the second edge
  } kind;
  HalfedgeId first, second;
};

/// Finds a clash, the leftmost or one before it; nothing if the boundary is right. In a periodic plane it finds only
/// edges that meet. Exact. Preconditions: the mesh lies in the plane. Stars are whole and wind once, so that a vertex
/// has at most two boundary edges, in different directions. O(m log m) for m boundary edges of any shape.
[[nodiscard]] std::optional<BoundaryClash> find_boundary_clash(const Mesh& mesh);

// The boundary of a mesh of the sphere: do its arcs cross or touch, does a component lie on another one?
//
// A component whose stars wind once and whose boundary loops are simple and apart covers no spot twice. It is mapped to
// the sphere without folds. The b loops cut the sphere into b + 1 regions, and region r is covered d_r times, once more
// on the left of each loop than on its right. Counting Euler characteristics, Σ d_r (2 − loops of r) = 2 − 2g − b for
// genus g. This is Σ d_r (1 − i_r) = 1 − g, with i_r the loops that have r on their right. At least one region has
// i_r = 0. Each of these is covered, and their number is one more than Σ (i_r − 1) over regions with i_r ≥ 1. Each
// region with i_r ≥ 1 is covered less often than those around it. So the sum is at least 1, and it is 1 only when d is
// 1 in one region and 0 in all others. Without boundary the component is a covering of the sphere, and only the trivial
// one exists.

/// Finds a clash, as find_boundary_clash() does in the plane; for `covered`, `first` is any halfedge. Exact.
/// Preconditions: the mesh lies on the sphere; stars are whole and wind once. O(m k + n c) for c components and m
/// boundary edges, each with k others at its latitude.
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

/// A message about two boundary edges at v in the same direction, in the user's names: the effect of a hanging node at
/// their ends. Empty when there are none. O(n).
[[nodiscard]] std::string edges_on_each_other(const Mesh& mesh, VertexId v, const InputNames& names);

/// Finds the reason why the mesh is not embedded in its space; nothing when it is. Preconditions: all triangles
/// counter-clockwise, manifold.
///
/// Consider a connected mesh in the plane whose stars wind once and whose boundary loops neither cross nor touch. It
/// covers every point at most once: the turning numbers of its loops sum to its Euler characteristic, so there is one
/// outer loop. Then only a component inside another one's triangles can be wrong. (boundary_sweep.hpp has the case of
/// the sphere.)
[[nodiscard]] std::optional<Overlap> find_overlap(const Mesh& mesh, const InputNames& names,
                                                  Executor* executor = nullptr);

}  // namespace temper
