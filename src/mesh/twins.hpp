// The corners of triangles determine the twins. They are found when a mesh is built, and after they were released.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "temper/mesh.hpp"

namespace temper {

class Executor;

/// The halfedges whose edges have their lesser vertex in a range, sorted by that vertex (counting sort). O(n) for any
/// range.
class EdgeBuckets {
 public:
  /// Number of slices of the lesser vertices. Each slice walks over all halfedges, and sorts a part of them.
  static constexpr std::size_t kSlices = 8;
  [[nodiscard]] static IdRange<VertexId> slice(const Mesh& mesh, std::size_t i) {
    const std::size_t n = mesh.n_vertices();
    return {VertexId(n * i / kSlices), VertexId(n * (i + 1) / kSlices)};
  }

  /// A halfedge by its greater vertex.
  struct Side {
    VertexId greater;
    HalfedgeId halfedge;
    friend bool operator<(Side a, Side b) {
      return a.greater != b.greater ? a.greater < b.greater : a.halfedge < b.halfedge;
    }
  };

  EdgeBuckets(const Mesh& mesh, IdRange<VertexId> lesser);

  /// The sides of the edges of a lesser vertex, sorted: the sides of one edge are next to each other.
  void collect(VertexId lesser, std::vector<Side>& sides) const;

 private:
  const Mesh& mesh_;
  std::size_t first_;
  std::vector<std::uint32_t> end_;  // of each bucket
  std::vector<HalfedgeId> sorted_;
};

/// Twins of a mesh that has none stored, and whose edges have two sides at most. O(n). Besides the twins each thread
/// takes 7 bytes per vertex, all together at most 28.
void find_twins(Mesh& mesh, Executor* executor);

}  // namespace temper
