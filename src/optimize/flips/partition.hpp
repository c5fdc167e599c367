// Parts of a mesh that sweeps improve at the same time. Ranges of vertex numbers are parts, since along a Hilbert curve
// they are compact pieces of the plane. Other cuts give more parts.
//
// A vertex is confined to a part if the part has all that its step reads: its star, its link, and the corners across
// the link. sweeper.hpp proves that confined steps of different parts may run at once.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "temper/detail/executor.hpp"
#include "temper/mesh.hpp"

namespace temper {

using PartNumber = std::uint8_t;

/// The vertices first … last − 1, by default all of any mesh; or all v with part_of[v] = number.
struct Part {
  VertexId first = VertexId(0), last = {};
  const PartNumber* part_of = nullptr;
  PartNumber number = 0;

  [[nodiscard]] bool contains(VertexId v) const {
    return part_of != nullptr ? part_of[v.index] == number : v.index - first.index < last.index - first.index;
  }
  [[nodiscard]] bool is_whole() const { return part_of == nullptr && first.index == 0 && !last.valid(); }
  friend bool operator==(const Part&, const Part&) = default;
};

/// A mesh cut into `count` parts of equal size.
struct Partition {
  std::size_t n_vertices = 0, count = 1;

  [[nodiscard]] Part operator[](std::size_t i) const { return {bound(i), bound(i + 1)}; }

 private:
  [[nodiscard]] VertexId bound(std::size_t i) const { return VertexId(i * n_vertices / count); }
};

/// Says whether v, which is in the part and not isolated, is confined to the part. O(degree). Reads no coordinates.
[[nodiscard]] inline bool is_confined(const Mesh& mesh, VertexId v, const Part& part) {
  if (part.is_whole()) return true;
  for (const HalfedgeId h : mesh.star(v)) {
    // The order matters: the corner across a link edge may be read only if both ends of the edge are in the part.
    if (!part.contains(mesh.target(h)) || !part.contains(mesh.opposite(h))) return false;
    const HalfedgeId across = mesh.twin(Mesh::next(h));
    if (across.valid() && !part.contains(mesh.opposite(across))) return false;
  }
  return true;
}

/// Cuts of a mesh into compact parts, other than ranges of numbers.
///
///     ┌────┬────┬────┐      The numbers follow a Hilbert curve, and a part is a run of numbers. Vertices at its border
///     │  ┌─┼──┬─┼──┐ │      are confined to no part. So more curves run through the mesh, on grids that are shifted by
///     ├──┼─┼──┼─┼──┤ │      1/5, 2/5 and 3/5 of its extent. At any level, a place is near a grid line of one direction
///     │  ├─┼──┼─┼──┤ │      in at most one of the four shifts (T. M. Chan, "Approximate nearest neighbor queries
///     └──┴─┴──┴─┴──┘ ┘      revisited", 1998). It is near a line of either direction in at most two shifts, and
///                           inside a part in the others.
///
/// So little or nothing is left after three of the four. On a sphere the curves are turned instead, around three axes.
/// In a periodic plane they begin elsewhere.
class ShiftedPartitions {
 public:
  static constexpr std::size_t kPartitions = 3;

  /// Makes all cuts, each into about `count` parts of similar size, by the vertices' present places. O(n log count).
  void cut(const Mesh& mesh, std::size_t count, Executor& executor);
  /// Says whether the cuts are of a mesh with this number of vertices. After a renumbering, call clear().
  [[nodiscard]] bool are_of(const Mesh& mesh) const { return part_of_[0].size() == mesh.n_vertices(); }
  void clear() { part_of_ = {}; }

  [[nodiscard]] std::size_t n_parts() const { return n_parts_; }
  /// Part i of cut k.
  [[nodiscard]] Part part(std::size_t k, std::size_t i) const {
    return {.part_of = part_of_[k].data(), .number = static_cast<PartNumber>(i)};
  }
  [[nodiscard]] std::size_t part_of(std::size_t k, VertexId v) const { return part_of_[k][v.index]; }

 private:
  std::size_t n_parts_ = 0;
  std::array<std::vector<PartNumber>, kPartitions> part_of_;  // per cut, by vertex
};

}  // namespace temper
