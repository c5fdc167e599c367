// Weights and connectivity together, with fixed positions: which edges should flip so that good weights exist?
//
// For a given connectivity the best margin is known, with a proof if it is not positive (temper/feasibility.hpp). For
// given weights the regular triangulation is known, and a mesh with only positive h is regular. For both together there
// are two searches. For small meshes of the plane a complete search finds a connectivity that has weights, or proves
// that none exists. A local search makes the margin greater. It ends if neither the regular triangulation of the
// weights nor any single flip has a greater best margin.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string_view>
#include <vector>

#include "temper/feasibility.hpp"

namespace temper {

/// Largest number of vertices of the complete search: it keeps tables of all pairs of vertices.
inline constexpr std::size_t kMostVerticesOfCompleteSearch = 300;

struct ConnectivityOptions {
  Constraints constraints = Constraints::well_centered;  ///< Constraints: well_centered or heights_only
  std::size_t programs = 10000;  ///< Largest number of linear programs of the whole mesh, in the local search
  /// Function that returns true to end the search, with the best connectivity so far. It is called often.
  std::function<bool()> stop = {};
};

/// A change of connectivity that made the best margin greater.
struct ConnectivityStep {
  enum class Kind {
    regular,   ///< The regular triangulation of the weights with the best margin
    flip,      ///< A flip of one edge
    complete,  ///< The triangulation that the complete search found
  };
  Kind kind = Kind::regular;
  std::size_t flips = 0;
  double margin = 0;  ///< Best margin after the step
};
[[nodiscard]] std::string_view name(ConnectivityStep::Kind kind);

/// The reason why best_connectivity ended.
enum class SearchEnd {
  no_better_neighbor,  ///< Neither kind of step makes the margin greater
  none_exists,         ///< No connectivity has weights: ConnectivityReport::proof
  limit,               ///< The limit of linear programs was reached
  stopped,             ///< By the caller
  failed,              ///< The solver gave up on the input mesh
};
[[nodiscard]] std::string_view name(SearchEnd end);

/// A proof that no connectivity has weights. Each of its lemmas says that no triangulation with certain edges has
/// weights that keep the constraints. The last lemma needs no edges. Edges of the boundary and constrained edges belong
/// to all triangulations, so lemmas do not name them.
struct ConnectivityProof {
  using Edge = std::array<VertexId, 2>;

  /// A lemma is proved in one of two ways:
  ///
  ///   - `terms`: a sum of constraints that is a contradiction, as in a certificate. A height over the edge pq of pqr
  ///     counts if pq is an edge of the lemma, of the boundary or constrained, and pqr lies in the domain. A crossing
  ///     of pq counts if the segment lies in the domain. Neither pqr nor pq have to be part of a triangulation: the
  ///     inequality holds by convexity (docs/explanation/connectivities.md).
  ///   - `side`, `cases`: the triangle to the left of the edge `side` has one of several corners as its apex. For each
  ///     possible apex X, either a new edge crosses an edge of the lemma, or a case names an earlier lemma. That lemma
  ///     has no edges except those of this one and the two edges from `side` to X.
  struct Lemma {
    struct Case {
      VertexId apex;
      std::size_t lemma = 0;
      friend bool operator==(const Case&, const Case&) = default;
    };
    std::vector<Edge> edges;
    std::vector<Certificate::Term> terms = {};
    Edge side = {};
    std::vector<Case> cases = {};
    friend bool operator==(const Lemma&, const Lemma&) = default;
  };
  Constraints constraints = Constraints::well_centered;
  std::vector<Lemma> lemmas;
  friend bool operator==(const ConnectivityProof&, const ConnectivityProof&) = default;
};

/// Verifies a proof in exact arithmetic, from positions, boundary and constrained edges alone. The connectivity of the
/// mesh does not matter. A mesh of more than kMostVerticesOfCompleteSearch vertices has no such proofs. Precondition:
/// the mesh lies in the plane.
[[nodiscard]] CertificateCheck check_proof(const Mesh& mesh, const ConnectivityProof& proof);

struct ConnectivityReport {
  Mesh mesh;  ///< Mesh with the connectivity found; positions, weights and flags are those in the input
  SearchEnd end = SearchEnd::failed;
  double before = 0, margin = 0;        ///< Best margins of the input's connectivity and of the connectivity found
  std::vector<ConnectivityStep> steps;  ///< Steps with growing margins
  std::size_t programs = 0;             ///< Number of linear programs of the whole mesh
  IdVector<VertexId, double> weights;   ///< Weights with margin `margin`: for proofs, not for meshes, as in BestMargin
  /// Margin that no connectivity exceeds, up to rounding; 0 if none has weights. kUnbounded without complete search.
  double bound = kUnbounded;
  std::size_t complete_programs = 0;  ///< Number of linear programs of the complete search
  ConnectivityProof proof;            ///< Proof that no connectivity has weights. It has lemmas only for `none_exists`
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
///
/// If regular triangulations alone give no margin above zero, the complete search runs before the first single flip. It
/// needs the plane and at most kMostVerticesOfCompleteSearch vertices. Its time is exponential at worst, so give
/// `stop`.
[[nodiscard]] Expected<ConnectivityReport> best_connectivity(const Mesh& mesh, LpSolver& solver,
                                                             const ConnectivityOptions& options = {});

}  // namespace temper
