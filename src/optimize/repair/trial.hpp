// One trial of a repair on a copy of a neighborhood: an edit, then sweeps of E_BP with a shrinking γ.
//
// A trial changes only its copy. The chosen trial runs again with a listener, which gets its events. splice()
// (neighborhood.hpp) applies them to the whole mesh.
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "optimize/options/settings.hpp"
#include "optimize/repair/neighborhood.hpp"

namespace temper {

/// The first edit of a trial, in the numbers of the neighborhood.
struct Edit {
  enum Kind {
    nothing,         ///< sweeps alone
    kick,            ///< moves all free vertices at random, by part of their shortest edge
    assign_weights,  ///< a linear program gives the weights that lack least of a margin; positions stay
    insert,          ///< a vertex in a triangle
    split,           ///< an edge, at a part of the way
    cut_corner,      ///< all lines at a vertex, at one distance from it
    remove,          ///< a vertex
    refine,          ///< inserts vertices until no triangle is too large for its place
    remesh,          ///< removes all free vertices, then refines
    only_refine,     ///< refines without sweeps; the caller makes edges of the rim regular
  } kind = nothing;
  TriangleId triangle = {};   ///< insert
  WeightedPoint place = {};   ///< insert; without a weight
  HalfedgeId edge = {};       ///< split
  double part = 0.5;          ///< split: part of the way from the edge's origin
  VertexId vertex = {};       ///< remove, cut_corner
  double distance = 0;        ///< cut_corner
  double gradation = 0;       ///< refine (all three): growth of the size of triangles with the distance from what stays
  double factor = 1;          ///< refine: of these sizes
  bool splits_lines = false;  ///< refine: where they are too long
  std::uint64_t seed = 0;     ///< kick
};

/// Says whether the edit brings new vertices.
[[nodiscard]] bool inserts_vertices(const Edit& edit);

/// The distance of a mesh from well-centered: first the number of bad triangles, then how bad they are and how much
/// length edges lack (optimize/run/judge.hpp).
struct LocalDefect {
  std::size_t bad = 0;
  double violation = 0;  ///< Σ of the worst of −h/ℓ, −d/ℓ and d/ℓ − 1 over bad triangles, plus missing lengths
  friend auto operator<=>(const LocalDefect&, const LocalDefect&) = default;
};
[[nodiscard]] LocalDefect defect_of(const Mesh& mesh, const AccuracyModel& model = {});

/// The result of a trial.
struct TrialResult {
  bool valid = false;  ///< all edges are regular, on the rim too, and no vertex is hidden
  LocalDefect defect;
  std::vector<TraceEvent> events;  ///< if requested; in local numbers, new vertices last
};

/// Applies the edit to a copy of the neighborhood and optimizes it. If new vertices are not possible with the present
/// weights, tries again with level weights of all vertices that are not frozen. `grid`: the whole mesh's, for
/// positions.
[[nodiscard]] TrialResult try_edit(const Neighborhood& around, const Edit& edit, const Settings& settings,
                                   const WorkingUnits& grid, bool with_events);

}  // namespace temper
