// Stars wind once, and the sweep over the boundary meets nothing that it should not. All exact.
#include "mesh/embedding.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "geometry/between.hpp"
#include "mesh/blocks.hpp"
#include "mesh/boundary_sweep.hpp"
#include "temper/geometry.hpp"

namespace temper {
namespace {

bool left_of(Vec2 a, Vec2 b, Vec2 p) { return orient2d(a, b, p) == Sign::positive; }

/// Says whether the direction from v to p is in the upper half-plane, the positive x-axis included.
bool is_upper(Vec2 v, Vec2 p) { return p.y > v.y || (p.y == v.y && p.x > v.x); }

/// Counts for each vertex how often its spokes, going round, enter the upper half-plane: once when an interior star
/// winds once. Counted triangle by triangle, which asks for each position once and not through chains of twins.
IdVector<VertexId, std::uint32_t> entries_to_upper_half(const Mesh& mesh, Executor* executor) {
  IdVector<VertexId, std::uint32_t> entries(mesh.n_vertices(), 0);
  const auto count = [&](std::size_t t, auto&& add) {
    const auto [a, b, c] = mesh.corners(TriangleId(t));
    const Vec2 p = mesh.position(a), q = mesh.position(b), r = mesh.position(c);
    // Of two distinct points one is upper to the other: what ends in the upper half at one end starts below the other.
    const bool ab = is_upper(p, q), bc = is_upper(q, r), ca = is_upper(r, p);
    if (!ab && !ca) add(entries[a]);
    if (!bc && !ab) add(entries[b]);
    if (!ca && !bc) add(entries[c]);
  };
  if (executor == nullptr) {
    for (const TriangleId t : mesh.triangles()) count(t.index, [](std::uint32_t& n) { ++n; });
  } else {
    for_each_index(mesh.n_triangles(), executor, [&](std::size_t t) {
      count(t, [](std::uint32_t& n) { __atomic_fetch_add(&n, 1U, __ATOMIC_RELAXED); });
    });
  }
  return entries;
}

/// A boundary star overlaps itself when a later triangle contains the direction of its first edge.
bool boundary_star_overlaps(const Mesh& mesh, VertexId v) {
  const Vec2 center = mesh.position(v);
  const Vec2 first = mesh.position(mesh.target(mesh.outgoing(v)));
  for (const HalfedgeId h : mesh.star(v)) {
    const Vec2 from = mesh.position(mesh.target(h));
    const Vec2 to = mesh.position(mesh.opposite(h));
    if (left_of(center, from, first) && orient2d(center, first, to) != Sign::negative) return true;
  }
  return false;
}

}  // namespace

std::string edges_on_each_other(const Mesh& mesh, VertexId v, const InputNames& names) {
  std::vector<VertexId> ends;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_boundary(h)) continue;
    if (mesh.origin(h) == v) ends.push_back(mesh.target(h));
    if (mesh.target(h) == v) ends.push_back(mesh.origin(h));
  }
  std::sort(ends.begin(), ends.end());
  const Vec2 p = mesh.position(v);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    for (std::size_t j = i + 1; j < ends.size(); ++j) {
      const Vec2 a = mesh.position(ends[i]), b = mesh.position(ends[j]);
      if (orient2d(p, a, b) != Sign::zero || !(is_between(p, a, b) || is_between(p, b, a))) continue;
      return "the mesh touches itself at " + names.point(v.index) + ": its edges to " + names.point(ends[i].index) +
             " and " + names.point(ends[j].index) +
             " lie on each other (a hanging node, or an edge whose two sides are not joined)";
    }
  }
  return {};
}

std::optional<Overlap> find_overlap(const Mesh& mesh, const InputNames& names, Executor* executor) {
  const auto entries = entries_to_upper_half(mesh, executor);
  const auto overlaps = [&](std::size_t i) {
    const VertexId v(i);
    return mesh.is_boundary(v) ? boundary_star_overlaps(mesh, v) : entries[v] != 1;
  };
  if (const auto first = first_index(mesh.n_vertices(), executor, overlaps)) {
    const VertexId v(*first);
    std::string message = mesh.is_boundary(v) ? edges_on_each_other(mesh, v, names) : std::string();
    if (message.empty()) message = "the triangles around " + names.point(v.index) + " overlap";
    return Overlap{Mesh::triangle(mesh.outgoing(v)), std::move(message)};
  }
  if (const auto clash = find_boundary_clash(mesh)) {
    const TriangleId s = Mesh::triangle(clash->first), t = Mesh::triangle(clash->second);
    if (clash->kind == BoundaryClash::covered) {
      return Overlap{s, names.triangle(s.index) + " lies on top of another component of the mesh"};
    }
    return Overlap{s, names.triangle(s.index) + " and " + names.triangle(t.index) +
                          " have boundary edges that cross or touch away from a common vertex"};
  }
  return std::nullopt;
}

}  // namespace temper
