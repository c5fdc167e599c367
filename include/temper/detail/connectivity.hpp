// Weights and connectivity together, with fixed positions: which edges should flip so that good weights exist?
//
// For a given connectivity the best margin is known, with a proof if it is not positive (temper/feasibility.hpp). For
// given weights the regular triangulation is known, and a mesh with only positive h is regular. For both together
// nothing is proved here. This is a local search. It ends if neither the regular triangulation of the weights nor any
// single flip has a greater best margin.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "temper/feasibility.hpp"

namespace temper {

struct ConnectivityOptions {
  Constraints constraints = Constraints::well_centered;  ///< Constraints: well_centered or heights_only
  std::size_t programs = 10000;                          ///< Largest number of linear programs of the whole mesh
};

/// A change of connectivity that made the best margin greater.
struct ConnectivityStep {
  enum class Kind {
    regular,  ///< The regular triangulation of the weights with the best margin
    flip,     ///< A flip of one edge
  };
  Kind kind = Kind::regular;
  std::size_t flips = 0;
  double margin = 0;  ///< Best margin after the step
};
[[nodiscard]] std::string_view name(ConnectivityStep::Kind kind);

/// The reason why best_connectivity ended.
enum class SearchEnd {
  no_better_neighbor,  ///< Neither kind of step makes the margin greater
  limit,               ///< The limit of linear programs was reached
  failed,              ///< The solver gave up on the input mesh
};
[[nodiscard]] std::string_view name(SearchEnd end);

struct ConnectivityReport {
  Mesh mesh;  ///< Mesh with the connectivity found; positions, weights and flags are those in the input
  SearchEnd end = SearchEnd::failed;
  double before = 0, margin = 0;        ///< Best margins of the input's connectivity and of the connectivity found
  std::vector<ConnectivityStep> steps;  ///< Steps with growing margins
  std::size_t programs = 0;             ///< Number of linear programs of the whole mesh
  IdVector<VertexId, double> weights;   ///< Weights with margin `margin`: for proofs, not for meshes, as in BestMargin
};

/// Searches for a connectivity with a greater best margin. Errors: constraints `regular`, which every regular
/// triangulation keeps; a periodic plane. Precondition: no erased triangles.
///
/// Each step starts from the best connectivity so far. First, edges that are not regular with the weights of its best
/// margin flip, by Lawson's algorithm. If this does not raise the best margin, the single flip that raises it most is
/// taken. Only flips that remove a term of the proof that the margin is no greater are tried: with all its terms, the
/// same proof holds after the flip. Boundary and constrained edges stay. Each step raises the margin by more than
/// rounding, so the search ends. A step costs one linear program of the whole mesh for each flip that a program of its
/// neighborhood does not rule out.
[[nodiscard]] Expected<ConnectivityReport> best_connectivity(const Mesh& mesh, LpSolver& solver,
                                                             const ConnectivityOptions& options = {});

}  // namespace temper
