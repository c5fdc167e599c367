// Ask and commit for one edge flip. The drawing and the body are in flip_inline.hpp.
//
// can_flip asks exactly what makes the two new triangles counter-clockwise, and no more: the quad adbc is strictly
// convex when its diagonal dc leaves a on its left (triangle dca) and b on its right (triangle cdb).
#include "mesh/predicates.hpp"
#include "topology/flip_inline.hpp"

namespace temper {

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
