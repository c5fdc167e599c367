// What a run planned, each time from the same beginning, until no triangle is bad.
#pragma once

#include "optimize/run/run.hpp"
#include "optimize/working/working_copy.hpp"

namespace temper {

/// Restarts from the input until one leaves nothing bad; the best of them.
[[nodiscard]] Expected<Candidate> best_restart(InputMesh& input, const Settings& settings, SweepState& state, Run& run);

/// Restarts from the input with weights alone, where that leaves fewer triangles bad: where they are thin as they have
/// to be, in layers, moves that lower the energy elsewhere may leave them no weights.
[[nodiscard]] Candidate reweighted(Candidate best, InputMesh& input, const Settings& settings, SweepState state,
                                   Run& run);

/// Says whether a repair that made `now` of `before` is kept: it is no worse, and vertices that came or went have cured
/// something.
[[nodiscard]] bool has_gained(const Candidate& now, const Candidate& before, const Settings& settings,
                              const EnergyModel& model);

/// Repairs, until a search leaves nothing bad: from the same beginning, on a copy; the best result is kept, and swept
/// once more. One more search, after the first, asks linear programs for weights, and goes on with what that has
/// left. Where bad triangles are far apart, from what the search before has left; and in place, without a sweep of the
/// whole mesh, where they are so from the first.
[[nodiscard]] Candidate repaired(Candidate best, const Settings& settings, SweepState& state, Run& run);

}  // namespace temper
