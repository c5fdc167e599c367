// One idea for a repair, tried out on a copy of a neighborhood: an edit, then sweeps of E_BP with a shrinking γ.
//
// A trial changes nothing outside of itself. Run again with a listener, the same trial tells its events, and these are
// what is then applied to the whole mesh (neighborhood.hpp).
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "optimize/options/settings.hpp"
#include "optimize/repair/neighborhood.hpp"

namespace temper {

/// The edit that a trial begins with, in the numbers of the neighborhood.
struct Edit {
  enum Kind {
    nothing,         ///< only sweep again
    kick,            ///< all free vertices, at random, by part of their shortest edge
    assign_weights,  ///< by the linear program of the weights that lack least of a margin; positions stay
    insert,          ///< a vertex in a triangle
    split,           ///< an inner edge in its middle
    remove,          ///< a vertex
    refine,          ///< with vertices, until no triangle is large for its place
    remesh,          ///< the same, after all free vertices have been removed
  } kind = nothing;
  TriangleId triangle = {};  ///< insert
  WeightedPoint place = {};  ///< insert; without a weight
  HalfedgeId edge = {};      ///< split
  VertexId vertex = {};      ///< remove
  double gradation = 0;      ///< refine, remesh: growth of the size of triangles with the distance from the boundary
  std::uint64_t seed = 0;    ///< kick
};

/// The defect of a mesh, how far it is from well-centered: first the number of triangles that are not, then by how
/// much, and by what edges lack of their lengths (optimize/run/judge.hpp).
struct LocalDefect {
  std::size_t bad = 0;
  double violation = 0;  ///< Σ over bad triangles of the worst of −h/ℓ, −d/ℓ and d/ℓ − 1, and over edges
  friend auto operator<=>(const LocalDefect&, const LocalDefect&) = default;
};
[[nodiscard]] LocalDefect defect_of(const Mesh& mesh, const AccuracyModel& model = {});

/// Says whether v is on no boundary, interface or rim and not fixed; plan_removal says whether it can go.
[[nodiscard]] bool may_be_removed(const Mesh& mesh, const std::vector<std::uint8_t>& frozen, VertexId v);

/// The result of a trial.
struct TrialResult {
  bool valid = false;  ///< all edges regular, those of the rim too, and nothing hidden
  LocalDefect defect;
  std::vector<TraceEvent> events;  ///< in the numbers of the neighborhood, new vertices after its own; when asked for
};

/// Applies the edit to a copy of the neighborhood and optimizes that. `grid`: of the whole mesh, for positions.
[[nodiscard]] TrialResult try_edit(const Neighborhood& around, const Edit& edit, const Settings& settings,
                                   const WorkingUnits& grid, bool with_events);

}  // namespace temper
