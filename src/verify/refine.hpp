// Regular refinement of a weighted mesh, for orders of convergence.
#pragma once

#include "temper/detail/error.hpp"
#include "temper/mesh.hpp"

namespace temper::verify_detail {

/// Divides every triangle into four. Weights are w/2 at the vertices and linear between, (w_i + w_j)/4 at the
/// midpoints. So each child at a corner is similar to its parent, orthocenter and all, and an edge's halves have half
/// of its dual length. No weights would do that for the fourth, turned child as well: those that the three fix have the
/// opposite sign there. Inside of a triangle these weights are linear, and the four are Delaunay among themselves
/// unless the parent is obtuse; then edges are not regular any more, and flips restore that where the parent mesh was
/// regular.
[[nodiscard]] Expected<Mesh> refined(const Mesh& mesh);

}  // namespace temper::verify_detail
