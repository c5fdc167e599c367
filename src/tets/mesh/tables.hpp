// Faces and edges of a mesh by their least vertex, and tetrahedra by each vertex (counting sort): twins, tags and
// counts come from them. O(n).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "temper/tets/mesh.hpp"

namespace temper::tets {

/// The halffaces of each least vertex.
class FaceBuckets {
 public:
  /// A halfface by its other vertices, middle < greatest.
  struct Side {
    VertexId middle, greatest;
    HalffaceId halfface;
    friend auto operator<=>(const Side&, const Side&) = default;
    [[nodiscard]] bool same_face(const Side& other) const {
      return middle == other.middle && greatest == other.greatest;
    }
  };

  explicit FaceBuckets(const TetMesh& mesh);
  /// The sides of the faces of a least vertex, sorted: the sides of one face are next to each other.
  void collect(VertexId least, std::vector<Side>& sides) const;

 private:
  const TetMesh& mesh_;
  std::vector<std::uint32_t> end_;  // of each bucket
  std::vector<HalffaceId> sorted_;
};

/// The tetrahedra around each vertex, as the faces opposite it.
class VertexStars {
 public:
  VertexStars() = default;
  explicit VertexStars(const TetMesh& mesh);
  /// Copies the stars of some vertices. The i-th vertex of the sequence gets the number i.
  VertexStars(const VertexStars& stars, std::span<const VertexId> sequence);
  /// The halffaces opposite v, ascending.
  [[nodiscard]] std::span<const HalffaceId> link(VertexId v) const {
    const std::size_t first = v.index == 0 ? 0 : end_[v.index - 1];
    return {sorted_.data() + first, end_[v.index] - first};
  }
  /// Calls use(t) for the tetrahedra around an edge, ascending.
  template <class Use>
  void for_each_around(const TetMesh& mesh, const std::array<VertexId, 2>& edge, const Use& use) const {
    for (const HalffaceId across : link(edge[0])) {
      const TetId t = TetMesh::tetrahedron(across);
      const auto& corners = mesh.corners(t);
      if (std::find(corners.begin(), corners.end(), edge[1]) != corners.end()) use(t);
    }
  }

 private:
  std::vector<std::uint32_t> end_;
  std::vector<HalffaceId> sorted_;
};

/// All edges, each once, by their lesser vertex.
class EdgeTable {
 public:
  EdgeTable(const TetMesh& mesh, Executor* executor);

  [[nodiscard]] std::size_t n_edges() const { return n_edges_; }
  /// The greater vertices of the edges of a lesser vertex, ascending.
  [[nodiscard]] std::span<const VertexId> greater(VertexId lesser) const {
    const std::size_t first = lesser.index == 0 ? 0 : end_[lesser.index - 1];
    return {greater_.data() + first, n_[lesser]};
  }
  /// A number of the edge, less than 6 times the number of tetrahedra; nothing if there is none.
  [[nodiscard]] std::optional<std::uint32_t> find(VertexId a, VertexId b) const {
    const auto all = greater(std::min(a, b));
    const auto found = std::lower_bound(all.begin(), all.end(), std::max(a, b));
    if (found == all.end() || *found != std::max(a, b)) return std::nullopt;
    return static_cast<std::uint32_t>(&*found - greater_.data());
  }

 private:
  std::vector<std::uint32_t> end_;
  std::vector<VertexId> greater_;
  IdVector<VertexId, std::uint32_t> n_;  // of each lesser vertex, without repetitions
  std::size_t n_edges_ = 0;
};

/// The corners of the six edges of a tetrahedron, then the two other corners, so that all four in this order are
/// positive.
inline constexpr std::array<std::array<int, 4>, 6> kEdgeCorners = {
    {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}}};

}  // namespace temper::tets
