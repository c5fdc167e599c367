// One triangle into three, at a point strictly inside.
//
//             c               before: triangle abc in slot t, sides h a→b, n b→c, p c→a
//            /|\              after:  abv in slot t; bcv and cav in two new slots
//           / | \             keeps:  the 3 sides with their flags; the region, for all three
//          /  v  \            needs:  v strictly inside (the three new triangles counter-clockwise)
//         / /   \ \           cost:   O(1), amortised over the growth of the arrays
//        a ------- b
#include "base/assert.hpp"
#include "mesh/predicates.hpp"
#include "topology/flip_inline.hpp"

namespace temper {

VertexId insert_in_triangle(Mesh& mesh, TriangleId t, WeightedPoint point) {
  const auto [a, b, c] = mesh.corners(t);
  MeshEditor edit(mesh);
  const VertexId v = edit.add_vertex(point);
  TEMPER_ASSERT_SLOW(inlined::orientation(mesh, a, b, v) == Sign::positive &&
                     inlined::orientation(mesh, b, c, v) == Sign::positive &&
                     inlined::orientation(mesh, c, a, v) == Sign::positive);
  const TriangleId bcv = edit.add_triangle({b, c, v}, mesh.region(t));
  const TriangleId cav = edit.add_triangle({c, a, v}, mesh.region(t));
  const HalfedgeId n = Mesh::halfedge(t, 1), p = Mesh::halfedge(t, 2);  // become b→v and v→a
  const bool was_boundary = mesh.is_boundary(n);

  inlined::attach(mesh, Mesh::halfedge(bcv, 0), inlined::outer_side(mesh, n));
  inlined::attach(mesh, Mesh::halfedge(cav, 0), inlined::outer_side(mesh, p));
  edit.set_corner(p, v);
  edit.link(n, Mesh::halfedge(bcv, 2));
  edit.link(Mesh::halfedge(bcv, 1), Mesh::halfedge(cav, 2));
  edit.link(Mesh::halfedge(cav, 1), p);
  mesh.set_constrained(n, false), mesh.set_constrained(p, false);

  edit.set_outgoing(v, Mesh::halfedge(cav, 2));
  update_outgoing(mesh, a, Mesh::halfedge(cav, 1));
  update_outgoing(mesh, c, Mesh::halfedge(cav, 0));
  // If b → c was the boundary halfedge of b, its old slot still leaves b, but it is b → v now.
  if (was_boundary && mesh.outgoing(b) == n) edit.set_outgoing(b, Mesh::halfedge(bcv, 0));
  update_outgoing(mesh, b, Mesh::halfedge(bcv, 0));
  return v;
}

}  // namespace temper
