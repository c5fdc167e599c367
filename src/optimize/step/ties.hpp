// Ties that weights alone can cure: quads of two triangles whose four corners cannot move and lie on one circle. If
// they are near one circle, rounding decides about the diagonal.
//
// Both diagonals are regular, and both contain the two orthocenters, at the center of the circle. If the ends of the
// diagonal are heavier than the other two corners, the orthocenters move off, each into its triangle. So the choice of
// diagonals matters. If the diagonals of a row of squares are parallel, each vertex is the end of one diagonal and
// across from the next. Then weights have to grow from square to square. If the diagonals zigzag, every other vertex is
// the end of all of its diagonals, and all these vertices may have the same weight.
//
//     o---*---o---*        The ends of the sides of a quad get different colors, like the squares of a chessboard. Then
//     | / | \ | / |        one color is made heavier (*), and the regular triangulation has the diagonals between
//     *---o---*---o        heavier ends. If quads allow no such coloring, the first quads in order decide.
#pragma once

#include <vector>

#include "optimize/options/settings.hpp"

namespace temper {

/// Says whether the mesh has such a quad. O(n).
[[nodiscard]] bool has_tied_quads(const Mesh& mesh, const OptimizeOptions& options);

/// A vertex at the end of tied diagonals, to be made heavier than its neighbors.
struct TieEnd {
  VertexId vertex;
  double shortest2;  ///< squared length of its shortest edge; a smaller difference of weights hides no vertex
};
/// Returns the ends to be made heavier, in ascending order. In each connected set of quads these are the vertices of
/// the color in which most present diagonals end. O(n log n).
[[nodiscard]] std::vector<TieEnd> heavier_ends_of_ties(const Mesh& mesh, const OptimizeOptions& options);

}  // namespace temper
