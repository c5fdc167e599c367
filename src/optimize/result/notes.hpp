// The sentences of the report: what the run did, and what is left to do.
#pragma once

#include <cstddef>

#include "optimize/options/settings.hpp"
#include "optimize/run/run.hpp"

namespace temper {

/// Returns the part of the triangles that is not well-centered.
[[nodiscard]] inline double bad_part(std::size_t n_triangles, std::size_t bad) {
  return static_cast<double>(bad) / static_cast<double>(n_triangles);
}

/// Facts about the end of a run that are not in the report.
struct Ending {
  bool returns_input = false;  ///< nothing better was found
  bool flips_input = false;    ///< except for flips that make it regular
  bool for_accuracy = false;
  std::size_t bad = 0;         ///< bad triangles of the returned mesh, by its score
  double bad_part_before = 0;  ///< bad part of the input's triangles
};

/// Adds the sentences to the report, in their order.
void add_notes(const Mesh& mesh, const Settings& settings, const RunFacts& facts, const Ending& ending,
               OptimizeReport& report);

}  // namespace temper
