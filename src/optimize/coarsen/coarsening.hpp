// The search for a mesh with fewer vertices in which all triangles are well-centered.
//
// The search first cures bad triangles with as many vertices as that takes. Then it removes single vertices until none
// can go. Then it makes moves of several vertices at random places. It keeps moves that leave fewer vertices, and some
// that leave as many, so that the next move begins elsewhere. So the mesh is the best one at any time.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "base/rng.hpp"
#include "optimize/coarsen/moves.hpp"
#include "optimize/coarsen/size_limit.hpp"
#include "optimize/flips/flipper.hpp"
#include "optimize/run/run.hpp"

namespace temper {

class Coarsening {
 public:
  /// The flipper's settings have a factor of coarsening. `moves_of_cure`: after so many moves without fewer bad
  /// triangles the search is over.
  Coarsening(WorkingCopy& work, Run& run, Flipper& flipper, int moves_of_cure);

  /// Makes one round of moves. Removed vertices stay isolated until the caller compacts, before the next round. Returns
  /// false if the search is over.
  bool improve();

 private:
  bool cure(const std::vector<TriangleId>& bad);
  bool remove_one_by_one();
  bool move_at_random();

  /// The vertices of a place, by number in the whole mesh, after a change there.
  using Changed = std::optional<std::vector<VertexId>>;
  enum class Sideways { refused, allowed };
  Changed make(const Neighborhood& around, const Move& move, Sideways sideways);
  Changed remove(VertexId v);

  [[nodiscard]] std::vector<VertexId> removable() const;
  [[nodiscard]] std::vector<VertexId> removable_near(const Neighborhood& around, VertexId v) const;
  [[nodiscard]] Neighborhood random_neighborhood(TriangleId t);

  WorkingCopy& work_;
  const Settings settings_;  // of local copies
  Run& run_;
  Flipper& flipper_;
  SizeLimit sizes_;
  Rng rng_;
  int moves_left_, moves_of_cure_;
  bool has_removed_singly_ = false;
  std::size_t least_bad_ = std::numeric_limits<std::size_t>::max();
  int moves_since_fewer_bad_ = 0;
};

}  // namespace temper
