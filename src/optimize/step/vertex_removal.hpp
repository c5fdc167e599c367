// Removal of one vertex during sweeps: by the short-edge rule, or because its patch is better without it.
#pragma once

#include "energy/patch.hpp"
#include "optimize/flips/flipper.hpp"
#include "optimize/step/vertex_limits.hpp"

namespace temper {

/// Its storage is kept from one vertex to the next.
class VertexRemoval : StepContext {
 public:
  VertexRemoval(const StepContext& context, Flipper& flipper, Guard& guard)
      : StepContext(context), flipper_(flipper), guard_(guard) {}

  /// Algorithm 2: if E_c would put v onto a neighbor, the mesh is better without v. Returns true if v is removed.
  bool collapse(VertexId v);
  /// Line 15 of Algorithm 1 removes v if the patch is better without it. §7 removes a vertex that the weights are about
  /// to hide. `patch`: the present star of v.
  void remove_if_better(VertexId v, const Patch& patch);

 private:
  /// Says whether regularity and guard allow the plan.
  [[nodiscard]] bool is_allowed();

  Flipper& flipper_;
  Guard& guard_;
  Patch collapsing_;  // gathered for E_c
  RemovalPlan plan_;
};

}  // namespace temper
