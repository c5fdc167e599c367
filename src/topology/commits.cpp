// The commits of an insertion or a split, of a removal, and of a flip. Drawings that are not here are next to the
// plans.
//
// The flips of an insertion change only the star of the new vertex. There they are found by the vertices' numbers.
#include "base/assert.hpp"
#include "mesh/predicates.hpp"
#include "temper/topology.hpp"
#include "topology/flip_inline.hpp"

namespace temper {
namespace {

/// The halfedge a → b with v on its left.
HalfedgeId link_halfedge(const Mesh& mesh, VertexId v, VertexId a, VertexId b) {
  for (const HalfedgeId spoke : mesh.star(v)) {
    const HalfedgeId h = Mesh::next(spoke);
    if (mesh.origin(h) == a && mesh.target(h) == b) return h;
  }
  return {};
}

}  // namespace

VertexId insert_vertex(Mesh& mesh, const InsertionPlan& plan, const InsertionObserver* observer) {
  TEMPER_ASSERT(plan.status == InsertionStatus::possible || plan.status == InsertionStatus::not_regular);
  if (observer != nullptr && observer->inserting) observer->inserting(plan);
  const VertexId v =
      plan.edge.valid() ? split_edge(mesh, plan.edge, plan.point) : insert_in_triangle(mesh, plan.triangle, plan.point);
  for (const auto& [a, b] : plan.flips) {
    const HalfedgeId h = link_halfedge(mesh, v, a, b);
    TEMPER_ASSERT(h.valid());
    if (observer != nullptr && observer->flipped) observer->flipped(a, b, v, mesh.opposite(mesh.twin(h)));
    flip(mesh, h);
  }
  return v;
}

// One triangle into three, at a point strictly inside.
//
//             c               before: triangle abc in slot t, sides h a→b, n b→c, p c→a
//            /|\              after:  abv in slot t; bcv and cav in two new slots
//           / | \             keeps:  the 3 sides with their flags; the region, for all three
//          /  v  \            needs:  v strictly inside (the three new triangles counter-clockwise)
//         / /   \ \           cost:   O(1), amortized over the growth of the arrays
//        a ------- b

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

// Two triangles into four at a point of their common edge, or one into two at a point of the boundary.
//
//             c               before: edge ab = h; triangle abc in slot t, bad in slot u (none on the boundary)
//            /|\              after:  avc in slot t, vbc in a new slot; bvd in slot u, vad in a new slot
//           / | \             keeps:  the outer edges with their flags; the regions of both sides
//          /  |  \            gives:  the flag of ab to av and vb; vc and vd are not constrained
//         a --v-- b           needs:  v so that the new triangles are counter-clockwise; v on ab keeps the domain
//          \  |  /            cost:   O(1), amortized over the growth of the arrays
//           \ | /
//            \|/
//             d

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

// The commit of a vertex removal. The drawing is in remove_vertex.cpp.
//
// Everything is addressed by the star's own order from the first spoke on, never by the numbers of slots. So the same
// plan on the same mesh with its triangles in other slots gives the same mesh in those slots.

namespace {

/// One triangle of the star: its slot, and the outer side of its link edge.
struct Rim {
  TriangleId slot;
  inlined::OuterSide outside;
  std::int32_t region;
};

/// The former star, and the line whose two edges become one.
struct Star {
  std::vector<Rim> rim;
  std::size_t line_end = 0;  ///< index in the link where the line from link[0] ends; 0: no line
  bool line_constrained = false;
};

Star gather(const Mesh& mesh, const RemovalPlan& plan) {
  Star star;
  const bool on_boundary = mesh.is_boundary(plan.first);
  HalfedgeId h = plan.first;
  for (std::size_t i = 0; h.valid() && (i == 0 || h != plan.first); ++i, h = mesh.rotate(h)) {
    star.rim.push_back({Mesh::triangle(h), inlined::outer_side(mesh, Mesh::next(h)), mesh.region(Mesh::triangle(h))});
    if (i > 0 && !on_boundary && mesh.is_constrained(h)) star.line_end = i;
  }
  if (on_boundary) star.line_end = plan.link.size() - 1;
  star.line_constrained = star.line_end > 0 && mesh.is_constrained(plan.first);
  return star;
}

/// The halfedge a → b among the first n slots of the rim, or invalid.
HalfedgeId find_new(const Mesh& mesh, const std::vector<Rim>& rim, std::size_t n, VertexId a, VertexId b) {
  for (std::size_t i = 0; i < n; ++i) {
    for (int k = 0; k < 3; ++k) {
      const HalfedgeId h = Mesh::halfedge(rim[i].slot, k);
      if (mesh.origin(h) == a && mesh.target(h) == b) return h;
    }
  }
  return {};
}

/// The region of new triangle i. On an interface the first side has line_end − 1 new triangles.
std::int32_t new_region(const Star& star, std::size_t i) {
  const bool is_interface = 0 < star.line_end && star.line_end < star.rim.size();
  return star.rim[is_interface && i + 1 >= star.line_end ? star.line_end : 0].region;
}

/// The triangles of the plan, in the first slots of the star, linked to one another and to nothing else.
void write_triangles(Mesh& mesh, const RemovalPlan& plan, const Star& star) {
  const std::size_t n = plan.triangles.size();
  MeshEditor edit(mesh);
  for (std::size_t i = 0; i < n; ++i) {
    mesh.set_region(star.rim[i].slot, new_region(star, i));
    for (int k = 0; k < 3; ++k) {
      const HalfedgeId h = Mesh::halfedge(star.rim[i].slot, k);
      edit.set_corner(h, plan.triangles[i][static_cast<std::size_t>(k)]);
      edit.link(h, HalfedgeId());
      mesh.set_constrained(h, false);
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (int k = 0; k < 3; ++k) {
      const HalfedgeId h = Mesh::halfedge(star.rim[i].slot, k);
      edit.link(h, find_new(mesh, star.rim, n, mesh.target(h), mesh.origin(h)));
    }
  }
}

}  // namespace

void remove_vertex(Mesh& mesh, const RemovalPlan& plan) {
  TEMPER_ASSERT(plan.status == RemovalStatus::possible && mesh.origin(plan.first) == plan.vertex);
  const Star star = gather(mesh, plan);
  const std::size_t n = plan.triangles.size(), k = plan.link.size();
  TEMPER_ASSERT(star.rim.size() > n);
  MeshEditor edit(mesh);
  for (const Rim& r : star.rim) edit.erase(r.slot);
  write_triangles(mesh, plan, star);
  for (std::size_t i = 0; i < star.rim.size(); ++i) {
    const HalfedgeId h = find_new(mesh, star.rim, n, plan.link[i], plan.link[(i + 1) % k]);
    TEMPER_ASSERT(h.valid());
    inlined::attach(mesh, h, star.rim[i].outside);
  }
  if (star.line_constrained) {
    const HalfedgeId line = find_new(mesh, star.rim, n, plan.link[star.line_end], plan.link[0]);
    mesh.set_constrained(line, true);
  }
  for (std::size_t i = 0; i < k; ++i) {
    const HalfedgeId h = find_new(mesh, star.rim, n, plan.link[i], plan.link[(i + 1) % k]);
    edit.set_outgoing(plan.link[i], canonical_outgoing(mesh, h));
  }
  edit.set_outgoing(plan.vertex, HalfedgeId());
}

// Ask and commit for one edge flip. The drawing and the body are in flip_inline.hpp.
//
// can_flip tests exactly that the two new triangles are counter-clockwise. The quad adbc is strictly convex when its
// diagonal dc leaves a on its left (triangle dca) and b on its right (triangle cdb).

FlipStatus can_flip(const Mesh& mesh, HalfedgeId h) {
  if (mesh.is_boundary(h)) return FlipStatus::boundary;
  if (mesh.is_constrained(h)) return FlipStatus::constrained;
  const auto [a, b, c, d] = inlined::quad(mesh, h);
  if (inlined::orientation(mesh, d, c, a) != Sign::positive) return FlipStatus::not_convex;
  if (inlined::orientation(mesh, c, d, b) != Sign::positive) return FlipStatus::not_convex;
  return FlipStatus::possible;
}

HalfedgeId flip(Mesh& mesh, HalfedgeId h) {
  TEMPER_ASSERT_SLOW(can_flip(mesh, h) == FlipStatus::possible);
  return inlined::flip(mesh, h);
}

void unflip(Mesh& mesh, HalfedgeId flipped) { inlined::unflip(mesh, flipped); }

}  // namespace temper
