// All triangulations of a small mesh: the oracle of searches over connectivities.
#pragma once

#include <array>
#include <set>
#include <vector>

#include "temper/topology.hpp"
#include "unit/feasibility/support.hpp"

namespace temper::test {

using Edges = std::set<std::array<VertexId, 2>>;
template <class Which>
Edges edges_of(const Mesh& mesh, const Which& which) {
  Edges edges;
  for (const HalfedgeId h : mesh.halfedges()) {
    const auto [a, b] = std::minmax({mesh.origin(h), mesh.target(h)});  // by value
    if (which(h)) edges.insert({a, b});
  }
  return edges;
}

/// Calls use(mesh) for each triangulation of the vertices with this boundary and these constrained edges: flips reach
/// all of them, in the plane. Returns their number.
template <class Use>
std::size_t for_each_triangulation(const Mesh& mesh, const Use& use) {
  const auto key = [](const Mesh& m) { return edges_of(m, [](HalfedgeId) { return true; }); };
  std::set<Edges> seen = {key(mesh)};
  std::vector<Mesh> queue = {mesh};
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const Mesh current = queue[i];
    use(current);
    for (const HalfedgeId h : current.halfedges()) {
      if (!current.is_edge_representative(h) || can_flip(current, h) != FlipStatus::possible) continue;
      Mesh other = current;
      flip(other, h);
      if (seen.insert(key(other)).second) queue.push_back(other);
    }
  }
  return queue.size();
}

/// The greatest best margin.
inline double best_of_all(const Mesh& mesh, Constraints constraints, std::size_t& triangulations) {
  double best = -kUnbounded;
  triangulations +=
      for_each_triangulation(mesh, [&](const Mesh& m) { best = std::max(best, margin_of(m, constraints).margin); });
  return best;
}

/// The Delaunay triangulation of random points in a square: its domain is their convex hull.
inline Mesh hull_of_random_points(std::uint64_t seed, std::size_t n) {
  Rng rng(seed);
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = rng.uniform();
    points.push_back({x, rng.uniform()});
  }
  return *constrained_delaunay({.points = points});
}

/// A small mesh of random points. Triangles at the boundary were cut off in turn, if no vertex was lost, and some edges
/// inside are constrained.
inline Mesh small_domain(std::uint64_t seed, std::size_t vertices, int cuts, int lines) {
  Rng rng(seed + 1000);
  Mesh mesh = hull_of_random_points(seed, vertices);
  const auto one_of = [&](std::size_t n) { return static_cast<std::size_t>(rng.uniform() * static_cast<double>(n)); };
  for (int k = 0; k < cuts; ++k) {
    const TriangleId cut(one_of(mesh.n_triangles()));
    std::vector<Vec2> points;
    std::vector<std::array<std::int32_t, 3>> triangles;
    for (const VertexId v : mesh.vertices()) points.push_back(mesh.position(v));
    bool on_boundary = false;
    for (int i = 0; i < 3; ++i) on_boundary |= mesh.is_boundary(Mesh::halfedge(cut, i));
    for (const TriangleId t : mesh.triangles()) {
      const auto [a, b, c] = mesh.corners(t);
      if (t != cut) triangles.push_back({std::int32_t(a.index), std::int32_t(b.index), std::int32_t(c.index)});
    }
    MeshInput input;
    input.points = points;
    input.triangles = triangles;
    if (auto built = Mesh::build(input); on_boundary && built) mesh = std::move(built->mesh);
  }
  for (int k = 0; k < lines; ++k) {
    const HalfedgeId h(one_of(mesh.n_halfedges()));
    if (!mesh.is_boundary(h)) mesh.set_constrained(h, true);
  }
  return mesh;
}

}  // namespace temper::test
