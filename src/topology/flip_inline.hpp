// Flip and its inverse, for inlining into Lawson's loop. The public functions are in commits.cpp.
//
//             c          before: edge ab = h; triangles abc, bad          h  a→b  n  b→c  p  c→a
//           /   \                (all counter-clockwise)                  g  b→a  gn a→d  gp d→b
//        p /     \ n     after:  edge dc = h; triangles dca, cdb          h  d→c  n  c→a  p  a→d
//         /   h   \                                                       g  c→d  gn d→b  gp b→c
//        a ------> b     keeps:  the 4 outer edges with their flags, the region, who is a twin of whom inside
//         \   g   /      refuses (can_flip): boundary edge, constrained edge, quad not strictly convex
//       gn \     / gp    cost:   O(1), no allocation; finding a lost outgoing() again walks around a vertex
//           \   /
//             d          The slots turn with the quad: a → d, b → c, c → a, d → b. Four turns are none, so the
//                        inverse is three flips, or one turn the other way.
#pragma once

#include <algorithm>

#include "base/assert.hpp"
#include "temper/mesh.hpp"
#include "temper/topology.hpp"
#include "topology/outgoing.hpp"

namespace temper::inlined {

/// The corners around an inner edge ab: c on the left of a → b, d on its right.
struct Quad {
  VertexId a, b, c, d;
};
[[nodiscard]] inline Quad quad(const Mesh& mesh, HalfedgeId h) {
  const HalfedgeId g = mesh.twin(h);
  return {mesh.origin(h), mesh.origin(g), mesh.opposite(h), mesh.opposite(g)};
}

/// Puts the outer side `from` had (its twin and its flag) where `to` is now.
struct OuterSide {
  HalfedgeId twin;
  bool constrained;
};
[[nodiscard]] inline OuterSide outer_side(const Mesh& mesh, HalfedgeId h) {
  return {mesh.twin(h), mesh.is_constrained(h)};
}
inline void attach(Mesh& mesh, HalfedgeId h, OuterSide side) {
  MeshEditor(mesh).link(h, side.twin);
  if (mesh.is_constrained(h) != side.constrained) mesh.set_constrained(h, side.constrained);
}

inline HalfedgeId flip(Mesh& mesh, HalfedgeId h) {
  TEMPER_ASSERT(!mesh.is_boundary(h) && !mesh.is_constrained(h));
  const HalfedgeId g = mesh.twin(h);
  const HalfedgeId n = Mesh::next(h), p = Mesh::prev(h), gn = Mesh::next(g), gp = Mesh::prev(g);
  const auto [a, b, c, d] = quad(mesh, h);
  const OuterSide bc = outer_side(mesh, n), ca = outer_side(mesh, p);
  const OuterSide ad = outer_side(mesh, gn), db = outer_side(mesh, gp);

  MeshEditor edit(mesh);
  edit.set_corner(h, d), edit.set_corner(n, c), edit.set_corner(p, a);
  edit.set_corner(g, c), edit.set_corner(gn, d), edit.set_corner(gp, b);
  attach(mesh, n, ca), attach(mesh, p, ad), attach(mesh, gn, db), attach(mesh, gp, bc);

  update_outgoing(mesh, a, p);
  update_outgoing(mesh, b, gp);
  update_outgoing(mesh, c, std::max(n, g));
  update_outgoing(mesh, d, std::max(h, gn));
  return h;
}

// One turn the other way: a → c, c → b, b → d, d → a, with the letters of the quad before the call.
inline void unflip(Mesh& mesh, HalfedgeId h) {
  TEMPER_ASSERT(!mesh.is_boundary(h) && !mesh.is_constrained(h));
  const HalfedgeId g = mesh.twin(h);
  const HalfedgeId n = Mesh::next(h), p = Mesh::prev(h), gn = Mesh::next(g), gp = Mesh::prev(g);
  const auto [a, b, c, d] = quad(mesh, h);
  const OuterSide bc = outer_side(mesh, n), ca = outer_side(mesh, p);
  const OuterSide ad = outer_side(mesh, gn), db = outer_side(mesh, gp);

  MeshEditor edit(mesh);
  edit.set_corner(h, c), edit.set_corner(n, d), edit.set_corner(p, b);
  edit.set_corner(g, d), edit.set_corner(gn, c), edit.set_corner(gp, a);
  attach(mesh, n, db), attach(mesh, p, bc), attach(mesh, gn, ca), attach(mesh, gp, ad);

  update_outgoing(mesh, a, gp);
  update_outgoing(mesh, b, p);
  update_outgoing(mesh, c, std::max(h, gn));
  update_outgoing(mesh, d, std::max(n, g));
}

}  // namespace temper::inlined
