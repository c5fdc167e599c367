// Components: triangles of the outline's hull that are connected without crossing an edge.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "mesher/arrangement.hpp"
#include "mesher/triangulated.hpp"

namespace temper::mesher {

struct Components {
  static constexpr std::uint32_t kNone = 0xffffffffu;
  using Crossed = std::pair<std::uint32_t, std::uint32_t>;  ///< a component, and the edge before it or kNoPiece

  Hull hull;
  IdVector<TriangleId, std::uint32_t> of;       ///< of each triangle
  std::vector<std::vector<Crossed>> neighbors;  ///< of each component, over an edge
  std::vector<Crossed> from_outside;            ///< those that are entered from beyond the hull

  [[nodiscard]] std::size_t size() const { return neighbors.size(); }
  [[nodiscard]] std::uint32_t at(HalfedgeId h) const { return of[Mesh::triangle(h)]; }
};

/// ErrorCode::stopped when it is time to stop.
[[nodiscard]] Expected<Components> find_components(const Surface& surface, const Arrangement& arrangement,
                                                   Deadline& deadline);

/// The depth of each component: the least number of edges between it and the outside of the hull.
[[nodiscard]] std::vector<std::uint32_t> depths(const Components& components);

/// The area of each component of the sphere, as a part of it.
[[nodiscard]] std::vector<double> parts_of_sphere(const Components& components);

/// Parts of each component, then rings, sorted.
using Parts = std::vector<std::vector<std::int32_t>>;

/// Each component's parts. They differ from the parts of the next component by the parts of the edge between them.
/// `first`: the first components, whose parts are the parts of the edge before them.
[[nodiscard]] Parts parts_from(const Components& components, const std::vector<Components::Crossed>& first,
                               const std::vector<OutlineEdge>& edges);

/// The elements in exactly one of two sorted lists.
[[nodiscard]] std::vector<std::int32_t> odd_ones(const std::vector<std::int32_t>& one,
                                                 const std::vector<std::int32_t>& other);

}  // namespace temper::mesher
