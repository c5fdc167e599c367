// Ties that weights alone can cure: quads of two triangles whose four corners lie on one circle, or so nearly that
// rounding decides about the diagonal, and cannot move.
//
// Either diagonal will do, and both leave the two orthocenters on it, at the center of the circle. Weights move them
// off, each into its triangle, where the ends of the diagonal are heavier than the other two corners. So the diagonals
// matter: where those of a row of squares are parallel, a vertex is the end of one and across from the next, and its
// weight has to grow from square to square. Where they zigzag, every other vertex is the end of all of its diagonals,
// and may be as heavy as all others like it.
//
//     o---*---o---*        The ends of the sides of a quad get different colors, like the squares of a chessboard; then
//     | / | \ | / |        one color is made heavier (*), and the regular triangulation has the diagonals between
//     *---o---*---o        heavier ends. Where quads leave no such coloring, the first ones in order have their way.
#pragma once

#include <vector>

#include "optimize/options/settings.hpp"

namespace temper {

/// Says whether the mesh has such a quad. O(n).
[[nodiscard]] bool has_tied_quads(const Mesh& mesh, const OptimizeOptions& options);

/// An end of ties that is to be heavier than its neighbors.
struct TieEnd {
  VertexId vertex;
  double shortest2;  ///< squared length of its shortest edge: a difference of weights less than that hides no vertex
};
/// The ends to be made heavier, in ascending order: of each connected set of quads the color that has the ends of
/// most present diagonals. O(n log n).
[[nodiscard]] std::vector<TieEnd> heavier_ends_of_ties(const Mesh& mesh, const OptimizeOptions& options);

}  // namespace temper
