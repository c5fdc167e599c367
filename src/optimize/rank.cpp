#include "optimize/rank.hpp"

#include "energy/whole_mesh.hpp"
#include "optimize/run.hpp"
#include "temper/regularity.hpp"

namespace temper {

Rank rank(const Mesh& mesh, const Settings& settings, const VertexSizes* sizes) {
  const OptimizeOptions& o = settings.options;
  Rank r;
  if (o.paper.inversion == Inversion::allow) r.inverted = count_inverted(mesh);
  if (o.paper.hidden != HiddenPolicy::keep)
    r.non_regular = count_non_regular_edges(mesh, false, settings.hooks.executor);
  if (settings.energy.barrier) r.bad = count_bad(mesh, settings.hooks.executor);
  if (sizes != nullptr) {
    r.lacks_margins = !has_margins(mesh, settings.accuracy.margin, settings.hooks.executor);
    r.energy = accuracy_energy(mesh, *sizes, settings.accuracy, settings.hooks.executor);
  } else {
    r.energy = total_energy(mesh, settings.model, settings.hooks.executor);
  }
  return r;
}

}  // namespace temper
