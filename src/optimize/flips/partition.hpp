// Parts of a mesh that sweeps improve at the same time: ranges of vertex numbers, which along a Hilbert curve are
// compact pieces of the plane, and pieces of other cuts (shifted_cuts.hpp).
//
// A vertex is confined to a part when all that its step looks at is in there: its star, its link, and the corners
// across the link. Why confined steps of different parts may run at once is shown in sweeper.hpp.
#pragma once

#include <cstddef>
#include <cstdint>

#include "temper/mesh.hpp"

namespace temper {

using PartNumber = std::uint16_t;

/// The vertices first … last − 1, by default all of any mesh; or those v with part_of[v] = number.
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
struct Cut {
  std::size_t n_vertices = 0, count = 1;

  [[nodiscard]] Part operator[](std::size_t i) const { return {bound(i), bound(i + 1)}; }

 private:
  [[nodiscard]] VertexId bound(std::size_t i) const { return VertexId(i * n_vertices / count); }
};

/// Says whether v, which is in the part and not isolated, is confined to it. O(degree). Reads no coordinates.
[[nodiscard]] inline bool is_confined(const Mesh& mesh, VertexId v, const Part& part) {
  if (part.is_whole()) return true;
  for (const HalfedgeId h : mesh.star(v)) {
    // The order matters: who is across a link edge may be read only when both its ends are in the part.
    if (!part.contains(mesh.target(h)) || !part.contains(mesh.opposite(h))) return false;
    const HalfedgeId across = mesh.twin(Mesh::next(h));
    if (across.valid() && !part.contains(mesh.opposite(across))) return false;
  }
  return true;
}

}  // namespace temper
