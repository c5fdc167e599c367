// Weights and connectivity together, positions fixed: which edges should flip so that good weights exist?
//
// For a given connectivity the best margin is known, with a proof when it is not positive (temper/feasibility.hpp); for
// given weights the regular triangulation is, and a mesh whose h all are positive is regular. For both together nothing
// is proved here: this is a local search, which ends where neither the weights' own regular triangulation nor any
// single flip has a greater best margin.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "temper/feasibility.hpp"

namespace temper {

struct ConnectivityOptions {
  Constraints constraints = Constraints::well_centered;  ///< or heights_only
  std::size_t programs = 10000;                          ///< of the whole mesh, at most
};

/// A change of connectivity that made the best margin greater.
struct ConnectivityStep {
  enum class Kind {
    regular,  ///< the regular triangulation of the weights that have the best margin
    flip,     ///< of one edge
  };
  Kind kind = Kind::regular;
  std::size_t flips = 0;
  double margin = 0;  ///< the best one, after it
};
[[nodiscard]] std::string_view name(ConnectivityStep::Kind kind);

/// How best_connectivity ended.
enum class SearchEnd {
  no_better_neighbor,  ///< neither kind of step makes the margin greater
  limit,               ///< of programs
  failed,              ///< the solver gave up on the mesh as it was
};
[[nodiscard]] std::string_view name(SearchEnd end);

struct ConnectivityReport {
  Mesh mesh;  ///< with the connectivity found; positions, weights and flags are the input's
  SearchEnd end = SearchEnd::failed;
  double before = 0, margin = 0;        ///< best margins of the input's connectivity, and of the one found
  std::vector<ConnectivityStep> steps;  ///< their margins grow
  std::size_t programs = 0;             ///< of the whole mesh
  IdVector<VertexId, double> weights;   ///< with margin `margin`: for proofs, not for meshes, as in BestMargin
};

/// Looks for a connectivity with a greater best margin. In turn, each time from the best connectivity so far: the edges
/// that are not regular with the weights of its best margin flip, by Lawson's algorithm; if that has no greater best
/// margin, the one flip that raises it most. Only flips that take away a term of the proof that the margin is no
/// greater are tried: with all its terms left, the same proof holds after the flip. Edges of the boundary and
/// constrained ones stay. The margin grows with each step by more than rounding, so the search ends. A step costs a
/// program of the whole mesh for each flip that a program of its neighborhood does not rule out. Errors:
/// constraints regular, which every regular triangulation keeps; a periodic plane. Precondition: no erased triangles.
[[nodiscard]] Expected<ConnectivityReport> best_connectivity(const Mesh& mesh, LpSolver& solver,
                                                             const ConnectivityOptions& options = {});

}  // namespace temper
