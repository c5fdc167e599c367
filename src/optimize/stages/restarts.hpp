// The attempts of a run, each from the same beginning, until no triangle is bad; and the run that changes the least.
#pragma once

#include "optimize/run/run.hpp"
#include "optimize/working/input_mesh.hpp"

namespace temper {

/// Restarts from the input until no triangle is bad, and returns the best result.
[[nodiscard]] Expected<Candidate> best_restart(InputMesh& input, const Settings& settings, SweepState& state, Run& run);

/// The input with as few changes as possible (repair/growing_search.hpp).
struct Mended {
  Candidate candidate;
  std::size_t left = 0;  ///< triangles at violations of the criterion
  bool many = false;     ///< their places fill the whole mesh, so only flips were tried
};
[[nodiscard]] Expected<Mended> mended(InputMesh& input, const Settings& settings, SweepState& state, Run& run);

/// Restarts from the input with weights alone, and returns the result if fewer triangles are bad. In layers, triangles
/// must be thin. If moves lower the energy elsewhere, no good weights may be left for them.
[[nodiscard]] Candidate reweighted(Candidate best, InputMesh& input, const Settings& settings, SweepState state,
                                   Run& run);

/// Says whether a repair of `before` is kept: `now` is not worse, and new or removed vertices have cured something.
[[nodiscard]] bool has_gained(const Candidate& now, const Candidate& before, const Settings& settings,
                              const EnergyModel& model);

/// Repairs until a search leaves no triangle bad. Each search has the same beginning, on a copy. The best result is
/// kept and swept once more. After the first search, another one finds weights by linear programs and goes on from its
/// result. If bad triangles are far apart, each search goes on from the one before. If they are far apart from the
/// start, searches work in place, without a sweep of the whole mesh.
[[nodiscard]] Candidate repaired(Candidate best, const Settings& settings, SweepState& state, Run& run);

/// Refines the mesh where triangles stay bad, and sweeps and repairs it again, until none is bad. Smaller triangles
/// find more room. Only if the options allow new vertices, on lines too.
[[nodiscard]] Candidate refined(Candidate best, const Settings& settings, SweepState& state, Run& run);

/// Cures bad triangles and searches for a mesh with fewer vertices, if the options ask for it. `moves_of_cure`: as of
/// Coarsening.
[[nodiscard]] Candidate coarsened(Candidate best, const Settings& settings, SweepState& state, Run& run,
                                  int moves_of_cure);

}  // namespace temper
