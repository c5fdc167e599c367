// Random valid meshes for property tests, made with topology operations alone: no code under test of generate.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <utility>
#include <vector>

#include "base/rng.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/mesh.hpp"
#include "temper/topology.hpp"
#include "topology/outgoing.hpp"

namespace temper::test {

inline Mesh build_or_die(const std::vector<Vec2>& points, const std::vector<std::array<std::int32_t, 3>>& triangles,
                         const std::vector<std::array<std::int32_t, 2>>& constrained = {}) {
  MeshInput input;
  input.points = points;
  input.triangles = triangles;
  input.constrained_edges = constrained;
  auto built = Mesh::build(input);
  if (!built) {
    std::fprintf(stderr, "build_or_die: %s\n", built.error().what().c_str());
    std::abort();
  }
  return std::move(built->mesh);
}

/// The square [−1, 1]² cut in two.
inline Mesh square() { return build_or_die({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, {{0, 1, 2}, {0, 2, 3}}); }

/// Puts p where it belongs: into a triangle, or on an edge. False when a vertex is there already.
inline bool insert_anywhere(Mesh& mesh, WeightedPoint p) {
  for (const TriangleId t : mesh.triangles()) {
    if (mesh.is_erased(t)) continue;
    std::array<Sign, 3> side;
    for (int k = 0; k < 3; ++k) {
      const HalfedgeId h = Mesh::halfedge(t, k);
      side[k] = orient2d(mesh.position(mesh.origin(h)), mesh.position(mesh.target(h)), p.position());
    }
    if (std::count(side.begin(), side.end(), Sign::negative) > 0) continue;
    const auto zeros = std::count(side.begin(), side.end(), Sign::zero);
    if (zeros == 2) return false;
    if (zeros == 0) {
      insert_in_triangle(mesh, t, p);
    } else {
      const auto k = std::find(side.begin(), side.end(), Sign::zero) - side.begin();
      split_edge(mesh, Mesh::halfedge(t, static_cast<int>(k)), p);
    }
    return true;
  }
  return false;
}

/// Flips `n` random edges among those that can be flipped, whether it is good for the mesh or not.
inline std::size_t shuffle_flips(Mesh& mesh, Rng& rng, int n) {
  std::size_t flips = 0;
  for (int i = 0; i < n; ++i) {
    const HalfedgeId h(std::size_t{rng.below(static_cast<std::uint32_t>(mesh.n_halfedges()))});
    if (can_flip(mesh, h) != FlipStatus::possible) continue;
    flip(mesh, h);
    ++flips;
  }
  return flips;
}

/// A triangulation of the square with `n` more vertices, on a lattice of 2/denominator when that is given: ties,
/// points on edges and on the boundary then come up often. Nothing regular about it.
inline Mesh mesh_of_random_points(Rng& rng, int n, int denominator = 0) {
  Mesh mesh = square();
  const auto coordinate = [&] {
    if (denominator == 0) return rng.uniform(-1, 1);
    return -1 + 2.0 * rng.below(static_cast<std::uint32_t>(denominator) + 1) / denominator;
  };
  for (int i = 0; i < n; ++i) insert_anywhere(mesh, {coordinate(), coordinate(), 0});
  shuffle_flips(mesh, rng, 4 * n);
  return mesh;
}

/// outgoing() of every vertex is the one that the rest of the mesh determines: what undoing bit for bit rests on.
inline bool has_canonical_outgoing(const Mesh& mesh) {
  for (const VertexId v : mesh.vertices()) {
    if (mesh.is_isolated(v)) continue;
    if (mesh.outgoing(v) != canonical_outgoing(mesh, mesh.outgoing(v))) return false;
  }
  return true;
}

/// The edges as sorted pairs of vertices: equal for equal triangulations, whatever the slots.
inline std::vector<std::pair<std::uint32_t, std::uint32_t>> edge_set(const Mesh& mesh) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_edge_representative(h) || mesh.is_erased(Mesh::triangle(h))) continue;
    edges.push_back(std::minmax(mesh.origin(h).index, mesh.target(h).index));
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

}  // namespace temper::test
