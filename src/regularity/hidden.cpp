// From stuck edges to hidden vertices.
//
// A stuck edge names the vertex at its reflex end, and rightly so (lawson.hpp). But a vertex can hide in the shadow
// of another: next to a tall peak the surface may be convex around a vertex that is itself above the regular
// surface. So the named vertices are taken out of a copy of the mesh, Lawson runs again, and whatever is stuck then
// is hidden too. Only vertices inside the domain and off all constrained edges can be taken out of a mesh that must
// keep its domain; the others are named and their stuck edges left.
#include "regularity/hidden.hpp"

#include <algorithm>

#include "regularity/lawson.hpp"
#include "temper/geometry.hpp"
#include "temper/topology.hpp"

namespace temper {
namespace {

void sort_unique(std::vector<VertexId>& vertices) {
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
}

bool can_be_removed(const Mesh& mesh, VertexId v) {
  if (mesh.is_boundary(v)) return false;
  for (const HalfedgeId h : mesh.star(v)) {
    if (mesh.is_constrained(h)) return false;
  }
  return true;
}

/// Flips edges of v away until its link is a triangle, or a convex quad with v where the diagonals cross: the one case
/// in which an inner vertex of degree four or more has no edge that can be flipped.
void simplify_star(Mesh& mesh, VertexId v) {
  for (HalfedgeId flippable;;) {
    std::size_t degree = 0;
    flippable = HalfedgeId();
    for (const HalfedgeId h : mesh.star(v)) {
      ++degree;
      if (!flippable.valid() && can_flip(mesh, h) == FlipStatus::possible) flippable = h;
    }
    if (degree == 3 || !flippable.valid()) return;
    flip(mesh, flippable);
  }
}

//        c                      c        A star of three becomes one triangle, a star of four two: a fan from
//      / | \                  /   \      the first corner of the link. The old triangles are erased.
//     d--v--b      becomes    d     b
//      \ | /                  \ . /
//        a                      a
void remove_simple_star(Mesh& mesh, VertexId v) {
  std::vector<VertexId> link;
  std::vector<inlined::OuterSide> sides;
  std::vector<TriangleId> old;
  for (const HalfedgeId h : mesh.star(v)) {
    link.push_back(mesh.target(h));
    sides.push_back(inlined::outer_side(mesh, Mesh::next(h)));
    old.push_back(Mesh::triangle(h));
  }
  TEMPER_ASSERT(link.size() == 3 || link.size() == 4);
  const std::int32_t region = mesh.region(old[0]);
  for (const TriangleId t : old) mesh.erase(t);
  HalfedgeId closing;  // the side of the fan so far that faces the next triangle
  for (std::size_t i = 1; i + 1 < link.size(); ++i) {
    const TriangleId t = mesh.add_triangle({link[0], link[i], link[i + 1]}, region);
    if (i == 1) {
      inlined::attach(mesh, Mesh::halfedge(t, 0), sides[0]);
    } else {
      mesh.link(Mesh::halfedge(t, 0), closing);
    }
    inlined::attach(mesh, Mesh::halfedge(t, 1), sides[i]);
    closing = Mesh::halfedge(t, 2);
    for (int k = 0; k < 3; ++k) mesh.set_outgoing(mesh.origin(Mesh::halfedge(t, k)), Mesh::halfedge(t, k));
  }
  inlined::attach(mesh, closing, sides.back());
  for (const VertexId u : link) mesh.set_outgoing(u, canonical_outgoing(mesh, mesh.outgoing(u)));
}

}  // namespace

VertexId reflex_end(const Mesh& mesh, HalfedgeId stuck) {
  const auto [a, b, c, d] = inlined::quad(mesh, stuck);
  return orient2d(mesh.position(d), mesh.position(c), mesh.position(a)) == Sign::positive ? b : a;
}

std::vector<VertexId> hidden_vertices(const Mesh& mesh, const std::vector<HalfedgeId>& stuck) {
  Mesh reduced = mesh;
  std::vector<VertexId> hidden;
  std::vector<HalfedgeId> edges = stuck;
  for (bool removed = true; removed;) {
    std::vector<VertexId> found;
    for (const HalfedgeId h : edges) found.push_back(reflex_end(reduced, h));
    hidden.insert(hidden.end(), found.begin(), found.end());
    sort_unique(found);
    removed = false;
    for (const VertexId v : found) {
      if (!can_be_removed(reduced, v)) continue;
      simplify_star(reduced, v);
      remove_simple_star(reduced, v);
      removed = true;
    }
    Lawson lawson;
    lawson.push_all(reduced);
    lawson.run(reduced);
    edges = lawson.stuck(reduced);
  }
  sort_unique(hidden);
  return hidden;
}

}  // namespace temper
