// Moves of the search for fewer vertices, each on a copy of a neighborhood.
#pragma once

#include <cstdint>
#include <vector>

#include "optimize/coarsen/search_copy.hpp"

namespace temper {

struct Move {
  enum Kind {
    exchange,  ///< removes the vertices `removed`, and inserts at most `most_inserted` where triangles stay bad
    crowd,     ///< inserts `most_inserted` vertices anywhere, then removes all others that it can
  } kind = exchange;
  std::vector<VertexId> removed = {};  ///< in the numbers of the neighborhood
  int most_inserted = 0;
  std::uint64_t seed = 0;  ///< of random choices
};

struct MoveResult {
  bool valid = false;  ///< all edges are regular, on the rim too
  LocalDefect defect;
  int more_vertices = 0;  ///< inserted minus removed
  // If requested:
  std::vector<TraceEvent> events;  ///< in local numbers, new vertices last
  Mesh mesh;                       ///< the changed neighborhood
};

/// Makes the move on a copy of the neighborhood. `settings` and `grid` as in SearchCopy.
[[nodiscard]] MoveResult try_move(const Neighborhood& around, const Move& move, const Settings& settings,
                                  const WorkingUnits& grid, bool with_events);

}  // namespace temper
