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
//                        inverse is three flips, or one turn back: a → c, c → b, b → d, d → a.
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

/// Turns the quad around h: to the next diagonal, or back to the last one.
template <bool forward>
void turn(Mesh& mesh, HalfedgeId h) {
  TEMPER_ASSERT(!mesh.is_boundary(h) && !mesh.is_constrained(h));
  const HalfedgeId g = mesh.twin(h);
  const HalfedgeId n = Mesh::next(h), p = Mesh::prev(h), gn = Mesh::next(g), gp = Mesh::prev(g);
  const auto [a, b, c, d] = quad(mesh, h);
  const Quad to = forward ? Quad{d, c, a, b} : Quad{c, d, b, a};
  const OuterSide sides[] = {outer_side(mesh, n), outer_side(mesh, p), outer_side(mesh, gn), outer_side(mesh, gp)};
  constexpr int k = forward ? 1 : 3;

  MeshEditor edit(mesh);
  edit.set_corner(h, to.a), edit.set_corner(n, to.b), edit.set_corner(p, to.c);
  edit.set_corner(g, to.b), edit.set_corner(gn, to.a), edit.set_corner(gp, to.d);
  attach(mesh, n, sides[k]), attach(mesh, p, sides[(k + 1) % 4]);
  attach(mesh, gn, sides[(k + 2) % 4]), attach(mesh, gp, sides[(k + 3) % 4]);

  update_outgoing(mesh, to.a, std::max(h, gn));
  update_outgoing(mesh, to.b, std::max(n, g));
  update_outgoing(mesh, to.c, p);
  update_outgoing(mesh, to.d, gp);
}

inline HalfedgeId flip(Mesh& mesh, HalfedgeId h) { return turn<true>(mesh, h), h; }
inline void unflip(Mesh& mesh, HalfedgeId h) { turn<false>(mesh, h); }

}  // namespace temper::inlined
