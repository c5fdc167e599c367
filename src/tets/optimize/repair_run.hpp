// The steps of a run that change the connectivity.
#pragma once

#include <cstddef>

#include "tets/optimize/local_search.hpp"
#include "tets/optimize/run.hpp"

namespace temper::tets {

class RepairRun : protected Run {
 protected:
  RepairRun(TetMesh& mesh, const OptimizeOptions& options, const OptimizeHooks& hooks,
            std::span<const VertexId> frozen);

  [[nodiscard]] bool changes_connectivity() const;
  /// Changes the connectivity where sweeps alone are not enough: first at all bad tetrahedra at once, then, from the
  /// best mesh, in patches. Each round counts as one sweep. `sought`: what changes aim at, the criterion of the run or
  /// a stricter one. They end when the criterion of the run is kept.
  void repair(Criterion sought);
  /// The second half of it: patches around places that violate what is sought.
  void repair_in_patches(Criterion sought);

 private:
  /// Makes a round of changes at all places. False: there was nothing to do, or it must stop.
  bool change_places(const SearchOptions& options);
  /// Changes the connectivity at small margins, too, as long as the energy falls: large weights there make errors
  /// large. A round in vain may be a step to a better mesh, two are not.
  void widen_margins();
  void repair_patches(const SearchOptions& options);

  std::size_t work_;  ///< What is left of the work of all searches
};

}  // namespace temper::tets
