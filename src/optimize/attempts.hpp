// What a run tries, each time from the same beginning, until no triangle is bad.
#pragma once

#include "optimize/input_mesh.hpp"
#include "optimize/report.hpp"

namespace temper {

/// Attempts from the input until one leaves nothing bad; the best of them.
[[nodiscard]] Expected<Candidate> best_attempt(InputMesh& input, Settings& settings, Run& run);

/// Repairs, until a search leaves nothing bad: from the same beginning, on a copy; the best result is kept, and swept
/// once more. Where bad triangles are far apart, from what the search before has left; and in place, without a sweep
/// of the whole mesh, where they are so from the first.
[[nodiscard]] Candidate repaired(Candidate best, Settings& settings, Run& run);

}  // namespace temper
