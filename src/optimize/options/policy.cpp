#include "optimize/options/policy.hpp"

namespace temper {

Policy::Policy(const OptimizeOptions& o)
    : PaperSwitches(o.paper),
      flips_at_once(o.flips == Flips::immediate),
      defers_flips(o.flips == Flips::deferred),
      keeps_connectivity(o.flips == Flips::none),
      allows_inversion(inversion == Inversion::allow),
      refuses_inversion(inversion == Inversion::refuse),
      undoes_hidden(hidden == HiddenPolicy::undo),
      keeps_hidden(hidden == HiddenPolicy::keep),
      removes_hidden(hidden == HiddenPolicy::remove),
      changes_vertices(collapse_from || removal != Removal::none || insertion_from),
      defers_positions(position_updates == Updates::deferred),
      defers_weights(weight_updates == Updates::deferred),
      makes_newton_steps(solver == Solver::newton && flips_at_once && refuses_inversion && !defers_positions) {
  if (switch_at == 0) first_energy.reset();
}

/// A barrier prices every flip, so it needs no limit; HOT is continuous at a flip and may be led past one, a little.
FlipLimit Policy::flip_limit_for(const EnergyInfo& energy) const {
  if (keeps_connectivity) return FlipLimit::before;
  return flip_limit.value_or(energy.barrier ? FlipLimit::unlimited : FlipLimit::after);
}

}  // namespace temper
