// Two triangles into four at a point of their common edge, or one into two at a point of the boundary.
//
//             c               before: edge ab = h; triangle abc in slot t, bad in slot u (none on the boundary)
//            /|\              after:  avc in slot t, vbc in a new slot; bvd in slot u, vad in a new slot
//           / | \             keeps:  the outer edges with their flags; the regions of both sides
//          /  |  \            gives:  the flag of ab to av and vb; vc and vd are not constrained
//         a --v-- b           needs:  v so that the new triangles are counter-clockwise; v on ab keeps the domain
//          \  |  /            cost:   O(1), amortised over the growth of the arrays
//           \ | /
//            \|/
//             d
#include "base/assert.hpp"
#include "mesh/predicates.hpp"
#include "topology/flip_inline.hpp"

namespace temper {
namespace {

/// Cuts the triangle of h (a → b, c across) along vc. Its slot keeps avc; returns v → b of the new slot.
HalfedgeId cut_triangle(Mesh& mesh, HalfedgeId h, VertexId v) {
  const HalfedgeId n = Mesh::next(h);
  const VertexId b = mesh.origin(n), c = mesh.opposite(h);
  TEMPER_ASSERT_SLOW(inlined::orientation(mesh, mesh.origin(h), v, c) == Sign::positive &&
                     inlined::orientation(mesh, v, b, c) == Sign::positive);
  MeshEditor edit(mesh);
  const TriangleId vbc = edit.add_triangle({v, b, c}, mesh.region(Mesh::triangle(h)));
  inlined::attach(mesh, Mesh::halfedge(vbc, 1), inlined::outer_side(mesh, n));
  edit.set_corner(n, v);
  edit.link(n, Mesh::halfedge(vbc, 2));
  mesh.set_constrained(n, false);
  return Mesh::halfedge(vbc, 0);
}

}  // namespace

VertexId split_edge(Mesh& mesh, HalfedgeId h, WeightedPoint point) {
  const HalfedgeId g = mesh.twin(h);
  const bool constrained = mesh.is_constrained(h);
  const VertexId a = mesh.origin(h), b = mesh.target(h), c = mesh.opposite(h);
  MeshEditor edit(mesh);
  const VertexId v = edit.add_vertex(point);
  const HalfedgeId vb = cut_triangle(mesh, h, v);
  if (g.valid()) {
    const VertexId d = mesh.opposite(g);
    const HalfedgeId va = cut_triangle(mesh, g, v);
    edit.link(vb, g);
    edit.link(h, va);
    update_outgoing(mesh, a, Mesh::next(va));
    update_outgoing(mesh, d, Mesh::prev(va));
  }
  mesh.set_constrained(h, constrained);
  mesh.set_constrained(vb, constrained);
  update_outgoing(mesh, b, Mesh::next(vb));
  update_outgoing(mesh, c, Mesh::prev(vb));
  edit.set_outgoing(v, canonical_outgoing(mesh, vb));
  return v;
}

}  // namespace temper
