// The complete search over connectivities: it finds weights for some triangulation of the vertices, or proves that no
// triangulation has any.
//
//   explore(edges):  the best margin of all rows that these edges imply (edge_rows.hpp)
//                    negative: the proof names the edges that it needs; they are a lemma
//                    else, for a side of an edge without triangle: explore(edges + two) for each possible apex
//                    if all apexes fail, their lemmas together are a lemma
//
// A lemma often needs few of the edges. If it does not need the last two, the search goes back beyond them. A lemma
// applies again wherever its edges are known. The side with the fewest apexes comes first, by preference at an edge
// that many lemmas name, and where the regular triangulation of the program's weights breaks constraints. The apex that
// this triangulation has comes first.
#pragma once

#include <cstddef>
#include <functional>

#include "temper/detail/connectivity.hpp"

namespace temper {

struct CompleteSearchResult {
  enum class End {
    found,      ///< `weights` keep the constraints in their regular triangulation, exactly
    none,       ///< `proof` shows that no triangulation has weights
    stopped,    ///< By the caller
    undecided,  ///< The best margin of some triangulation is zero up to rounding
  };
  End end = End::undecided;
  double bound = kUnbounded;  ///< No triangulation has a greater margin, up to rounding
  IdVector<VertexId, double> weights;
  ConnectivityProof proof;
  std::size_t programs = 0;
};

/// Precondition: the mesh lies in the plane. For n vertices each level of the search needs O(n²) memory.
[[nodiscard]] CompleteSearchResult search_completely(const Mesh& mesh, Constraints constraints,
                                                     const std::function<bool()>& stop);

}  // namespace temper
