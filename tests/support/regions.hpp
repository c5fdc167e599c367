// Meshes with several regions.
#pragma once

#include <cstdint>

#include "temper/generate.hpp"
#include "temper/mesh.hpp"

namespace temper::test {

/// Random points in two regions, and so a line of constrained edges between them, some of them in line.
inline Mesh mesh_with_regions(std::size_t vertices, std::uint64_t seed) {
  Mesh mesh = *random_points({.vertices = vertices, .seed = seed});
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    mesh.set_region(t, mesh.position(a).x + mesh.position(b).x + mesh.position(c).x > 1.2 ? 1 : 0);
  }
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_boundary(h) && mesh.region(Mesh::triangle(h)) != mesh.region(Mesh::triangle(mesh.twin(h)))) {
      mesh.set_constrained(h, true);
    }
  }
  return mesh;
}

}  // namespace temper::test
