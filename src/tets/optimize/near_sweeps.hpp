// Sweeps over the vertices at violating tetrahedra, and over no others: optimize/stages/near_sweeps.hpp has the same
// for triangles, and says which vertices.
#pragma once

#include "temper/detail/criterion.hpp"
#include "tets/optimize/draft.hpp"
#include "tets/optimize/sweeper.hpp"

namespace temper::tets {

struct NearOptions {
  Criterion criterion = Criterion::well_centered;
  double most_cosine = 1;  ///< of dihedral angles
};

/// Makes the sweeps, which keep the connectivity. They see a patch around the violations alone. Returns false if it was
/// stopped.
bool sweep_near_violations(Draft& draft, const NearOptions& options, const MustStop& must_stop, Executor* executor);

}  // namespace temper::tets
