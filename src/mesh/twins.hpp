// Which halfedges are twins follows from the corners: found when a mesh is built, and again where a mesh was without.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "temper/mesh.hpp"

namespace temper {

class Executor;

/// The halfedges whose edges have their lesser vertex in a range, by that vertex (counting sort). O(n), whatever the
/// range.
class EdgeBuckets {
 public:
  /// A halfedge by its greater vertex.
  struct Side {
    VertexId greater;
    HalfedgeId halfedge;
    friend bool operator<(Side a, Side b) {
      return a.greater != b.greater ? a.greater < b.greater : a.halfedge < b.halfedge;
    }
  };

  EdgeBuckets(const Mesh& mesh, IdRange<VertexId> lesser);

  /// The sides of the edges of a lesser vertex, sorted: those of one edge come one after the other.
  void collect(VertexId lesser, std::vector<Side>& sides) const;

 private:
  const Mesh& mesh_;
  std::size_t first_;
  std::vector<std::uint32_t> end_;  // of each bucket
  std::vector<HalfedgeId> sorted_;
};

/// Twins of a mesh that has none stored, and whose edges have two sides at most. O(n), with 7 bytes a vertex besides
/// them for each thread that works, at most 28.
void find_twins(Mesh& mesh, Executor* executor);

}  // namespace temper
