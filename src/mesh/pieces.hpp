// The pieces that a mesh consists of.
#pragma once

#include <cstdint>
#include <vector>

#include "temper/mesh.hpp"

namespace temper {

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

}  // namespace temper
