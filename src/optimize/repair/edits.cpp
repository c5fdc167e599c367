#include "optimize/repair/edits.hpp"

#include <algorithm>

#include "geometry/in_space.hpp"
#include "mesh/bad_triangles.hpp"
#include "optimize/run/run.hpp"
#include "topology/locate.hpp"

namespace temper {
namespace {

constexpr int kKicks = 3;
// A neighbourhood with more bad triangles has more than one place to begin at.
constexpr std::size_t kMostBad = 6;
constexpr std::size_t kMostRemovals = 12;
// Gradations of sizes, from such that hardly grow to such that double within their own length.
constexpr double kGradations[] = {0.3, 0.6, 1};

/// The one that the neighbourhood is around, and others.
std::vector<TriangleId> some_bad_triangles(const Neighborhood& around) {
  std::vector<TriangleId> bad = {around.seed};
  for (const TriangleId t : around.mesh.triangles()) {
    if (bad.size() == kMostBad) break;
    if (t != around.seed && is_bad(around.mesh, t)) bad.push_back(t);
  }
  return bad;
}

void add_insertions(const Mesh& mesh, TriangleId t, std::vector<Edit>& edits) {
  const auto [a, b, c] = mesh.points(t);
  edits.push_back({.kind = Edit::insert, .triangle = t, .place = middle(mesh.space(), a, b, c)});
  const WeightedPoint o = orthocenter(mesh.space(), a, b, c);
  const Location at = locate(mesh, o, t);
  if (at.kind == Location::Kind::in_triangle) {
    edits.push_back({.kind = Edit::insert, .triangle = at.triangle, .place = o});
  }
  for (int side = 0; side < 3; ++side) {
    const HalfedgeId h = Mesh::halfedge(t, side);
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
    if (!may_be_removed(around.mesh, around.frozen, v)) continue;
    if (plan_removal(around.mesh, v).status != RemovalStatus::possible) continue;
    if (++count > kMostRemovals) return;
    edits.push_back({.kind = Edit::remove, .vertex = v});
  }
}

}  // namespace

std::vector<std::vector<Edit>> edits_for(const Neighborhood& around, bool weighs, bool vertices, Rng& rng) {
  std::vector<Edit> moves = {{.kind = Edit::nothing}}, weights, one, many, anew;
  for (int i = 0; i < kKicks; ++i) moves.push_back({.kind = Edit::kick, .seed = rng.next()});
  if (weighs) weights.push_back({.kind = Edit::weigh});
  if (!vertices) return {moves, weights};
  const std::vector<TriangleId> bad = some_bad_triangles(around);
  add_removals(around, bad, one);
  for (const TriangleId t : bad) add_insertions(around.mesh, t, one);
  if (around.mesh.space().is_periodic()) return {moves, weights, one};  // refinement measures across the neighbourhood
  for (const double gradation : kGradations) {
    many.push_back({.kind = Edit::refine, .gradation = gradation});
    anew.push_back({.kind = Edit::remesh, .gradation = gradation});
  }
  return {moves, weights, one, many, anew};
}

}  // namespace temper
