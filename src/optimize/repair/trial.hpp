// One trial of a repair on a copy of a neighborhood: an edit, then sweeps of E_BP with a shrinking γ.
//
// A trial changes only its copy. The chosen trial runs again with a listener, which gets its events. splice()
// (neighborhood.hpp) applies them to the whole mesh.
#pragma once

#include <compare>
#include <cstdint>
#include <variant>
#include <vector>

#include "optimize/options/settings.hpp"
#include "optimize/repair/local_copy.hpp"
#include "optimize/repair/neighborhood.hpp"
#include "optimize/repair/refinement.hpp"

namespace temper {

// The first edit of a trial, in the numbers of the neighborhood.

/// Sweeps alone.
struct JustSweep {};
/// Moves all free vertices at random, by part of their shortest edge.
struct Perturb {
  std::uint64_t seed = 0;
};
/// A linear program gives the weights that lack least of a margin; positions stay.
struct AssignWeights {};
/// Inserts a vertex in a triangle, without a weight.
struct Insert {
  TriangleId triangle;
  WeightedPoint place;
};
/// Splits an edge at a part of the way from its origin.
struct Split {
  HalfedgeId edge;
  double part = 0.5;
};
/// Splits all lines at a vertex, at one distance from it.
struct CutCorner {
  VertexId vertex;
  double distance = 0;
};
struct Remove {
  VertexId vertex;
};
/// Inserts vertices until no triangle is too large for its place.
struct Refine {
  DelaunayRefinement::Sizes sizes;
  bool splits_lines = false;  ///< where they are too long
  bool anew = false;          ///< removes all free vertices first
  bool sweeps = true;         ///< if not, the caller makes edges of the rim regular
};
using Edit = std::variant<JustSweep, Perturb, AssignWeights, Insert, Split, CutCorner, Remove, Refine>;

/// Cost of AssignWeights, in trials of other edits.
inline constexpr int kTrialsOfAProgram = 20;

/// Says whether the edit brings new vertices.
[[nodiscard]] bool inserts_vertices(const Edit& edit);

/// The distance of a mesh from well-centered: first the number of bad triangles, then how bad they are and how much
/// length edges lack (optimize/run/judge.hpp). For another criterion: the number of violated duals, and the sum of
/// their lengths over those of their edges.
struct LocalDefect {
  std::size_t bad = 0;
  double violation = 0;  ///< Σ of the worst of −h/ℓ, −d/ℓ and d/ℓ − 1 over bad triangles, plus missing lengths
  friend auto operator<=>(const LocalDefect&, const LocalDefect&) = default;
};
[[nodiscard]] LocalDefect defect_of(const Mesh& mesh, const AccuracyModel& model = {});
/// The distance of the place from the criterion of the settings, with this mesh in it.
[[nodiscard]] LocalDefect defect_of(const Neighborhood& around, const Mesh& local, const Settings& settings);

/// The result of a trial.
struct TrialResult {
  bool valid = false;  ///< all edges are regular, on the rim too, and no vertex is hidden
  LocalDefect defect;
  std::vector<TraceEvent> events;  ///< if requested; in local numbers, new vertices last
};

/// The manner of a trial.
struct TrialOptions {
  bool with_events = false;  ///< Record what it does
  Pace pace = Pace::thorough;
};

/// Applies the edit to a copy of the neighborhood and optimizes it. If new vertices are not possible with the present
/// weights, tries again with level weights of all vertices that are not frozen. `grid`: the whole mesh's, for
/// positions.
[[nodiscard]] TrialResult try_edit(const Neighborhood& around, const Edit& edit, const Settings& settings,
                                   const WorkingUnits& grid, const TrialOptions& options = {});

}  // namespace temper
