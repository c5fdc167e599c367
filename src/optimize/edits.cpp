#include "optimize/edits.hpp"

#include <algorithm>

#include "geometry/predicates_inline.hpp"
#include "temper/geometry.hpp"

namespace temper {
namespace {

constexpr int kKicks = 3;
// A neighbourhood with more bad triangles has more than one place to begin at.
constexpr std::size_t kMostBad = 6;
constexpr std::size_t kMostRemovals = 12;

std::vector<TriangleId> some_bad_triangles(const Mesh& mesh) {
  std::vector<TriangleId> bad;
  for (const TriangleId t : mesh.triangles()) {
    const auto [p, q, r] = mesh.corners(t);
    const bool is_bad = !inlined::is_well_centered(mesh.point(p), mesh.point(q), mesh.point(r));
    if (is_bad && bad.size() < kMostBad) bad.push_back(t);
  }
  return bad;
}

/// The triangle that p is strictly inside of; invalid when there is none.
TriangleId locate(const Mesh& mesh, Vec2 p) {
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    const Vec2 pa = mesh.position(a), pb = mesh.position(b), pc = mesh.position(c);
    if (inlined::orient2d(pa, pb, p) == Sign::positive && inlined::orient2d(pb, pc, p) == Sign::positive &&
        inlined::orient2d(pc, pa, p) == Sign::positive) {
      return t;
    }
  }
  return {};
}

void add_insertions(const Mesh& mesh, TriangleId t, std::vector<Edit>& edits) {
  const auto [a, b, c] = mesh.corners(t);
  const Vec2 middle = (1.0 / 3) * (mesh.position(a) + mesh.position(b) + mesh.position(c));
  edits.push_back({.kind = Edit::insert, .triangle = t, .place = middle});
  const Vec2 o = orthocenter(mesh.point(a), mesh.point(b), mesh.point(c));
  const TriangleId at = locate(mesh, o);
  if (at.valid()) edits.push_back({.kind = Edit::insert, .triangle = at, .place = o});
  for (int k = 0; k < 3; ++k) {
    const HalfedgeId h = Mesh::halfedge(t, k);
    if (!mesh.is_boundary(h) && !mesh.is_constrained(h)) edits.push_back({.kind = Edit::split, .edge = h});
  }
}

/// The corners of these triangles and their neighbours, each once.
std::vector<VertexId> vertices_near(const Mesh& mesh, const std::vector<TriangleId>& triangles) {
  std::vector<VertexId> near;
  for (const TriangleId t : triangles) {
    for (const VertexId v : mesh.corners(t)) {
      near.push_back(v);
      for (const HalfedgeId h : mesh.star(v)) near.push_back(mesh.target(h));
    }
  }
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  return near;
}

void add_removals(const Neighborhood& around, const std::vector<TriangleId>& bad, std::vector<Edit>& edits) {
  std::size_t count = 0;
  for (const VertexId v : vertices_near(around.mesh, bad)) {
    if (around.frozen[v.index] != 0 || around.mesh.is_boundary(v)) continue;
    if (plan_removal(around.mesh, v).status != RemovalStatus::possible) continue;
    if (++count > kMostRemovals) return;
    edits.push_back({.kind = Edit::remove, .vertex = v});
  }
}

}  // namespace

std::vector<Edit> edits_for(const Neighborhood& around, bool vertices, Rng& rng) {
  std::vector<Edit> edits = {{.kind = Edit::nothing}};
  for (int i = 0; i < kKicks; ++i) edits.push_back({.kind = Edit::kick, .seed = rng.next()});
  if (!vertices) return edits;
  const std::vector<TriangleId> bad = some_bad_triangles(around.mesh);
  add_removals(around, bad, edits);
  for (const TriangleId t : bad) add_insertions(around.mesh, t, edits);
  return edits;
}

}  // namespace temper
