// What the report says of a run in sentences: what was done, and what is left.
#pragma once

#include <cstddef>

#include "optimize/options/settings.hpp"
#include "optimize/run/run.hpp"

namespace temper {

/// The part of the triangles that is not well-centered.
[[nodiscard]] inline double bad_part(const Mesh& mesh, std::size_t bad) {
  return static_cast<double>(bad) / static_cast<double>(mesh.n_triangles());
}

/// What the report does not know of the end of a run.
struct Ending {
  bool returns_input = false;  ///< nothing better was found
  bool flips_input = false;    ///< but for flips that make it regular
  bool for_accuracy = false;
  std::size_t bad = 0;         ///< triangles of the mesh that is returned, as its score counts them
  double bad_part_before = 0;  ///< of the input's triangles
};

/// Adds the sentences to the report, in the order in which they are told.
void add_notes(const Mesh& mesh, const Settings& settings, const RunFacts& facts, const Ending& ending,
               OptimizeReport& report);

}  // namespace temper
