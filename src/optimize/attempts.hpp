// What a run tries, each time from the same beginning, until no triangle is bad.
#pragma once

#include "optimize/report.hpp"

namespace temper {

/// Attempts from the input until one leaves nothing bad; the best of them.
[[nodiscard]] Expected<Candidate> best_attempt(const Mesh& mesh, Settings& settings, Run& run);

/// Repairs, from the same beginning until a search leaves nothing bad; the best result is kept, and swept once more.
[[nodiscard]] Candidate repaired(Candidate start, Settings& settings, Run& run);

}  // namespace temper
