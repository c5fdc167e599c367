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
    split,           ///< an inner edge at its midpoint
    remove,          ///< a vertex
    refine,          ///< inserts vertices until no triangle is too large for its place
    remesh,          ///< removes all free vertices, then refines
  } kind = nothing;
  TriangleId triangle = {};  ///< insert
  WeightedPoint place = {};  ///< insert; without a weight
  HalfedgeId edge = {};      ///< split
  VertexId vertex = {};      ///< remove
  double gradation = 0;      ///< refine, remesh: growth of the size of triangles with the distance from the boundary
  std::uint64_t seed = 0;    ///< kick
};

/// The distance of a mesh from well-centered: first the number of bad triangles, then how bad they are and how much
/// length edges lack (optimize/run/judge.hpp).
struct LocalDefect {
  std::size_t bad = 0;
  double violation = 0;  ///< Σ of the worst of −h/ℓ, −d/ℓ and d/ℓ − 1 over bad triangles, plus missing lengths
  friend auto operator<=>(const LocalDefect&, const LocalDefect&) = default;
};
[[nodiscard]] LocalDefect defect_of(const Mesh& mesh, const AccuracyModel& model = {});

/// Says whether v is neither fixed nor on a boundary, interface or rim. plan_removal says whether it can be removed.
[[nodiscard]] bool may_be_removed(const Mesh& mesh, const std::vector<std::uint8_t>& frozen, VertexId v);

/// The result of a trial.
struct TrialResult {
  bool valid = false;  ///< all edges are regular, on the rim too, and no vertex is hidden
  LocalDefect defect;
  std::vector<TraceEvent> events;  ///< if requested; in local numbers, new vertices last
};

/// Applies the edit to a copy of the neighborhood and optimizes it. `grid`: the whole mesh's, for positions.
[[nodiscard]] TrialResult try_edit(const Neighborhood& around, const Edit& edit, const Settings& settings,
                                   const WorkingUnits& grid, bool with_events);

}  // namespace temper
