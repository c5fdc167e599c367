#include "optimize/rank.hpp"

#include <cmath>
#include <vector>

#include "energy/whole_mesh.hpp"
#include "optimize/lengths.hpp"
#include "optimize/run.hpp"
#include "temper/regularity.hpp"

namespace temper {

namespace {

std::size_t count_inverted_if_allowed(const Mesh& mesh, const OptimizeOptions& o) {
  return o.paper.inversion == Inversion::allow ? count_inverted(mesh) : 0;
}

}  // namespace

double root_mean_square(const std::vector<double>& squared_errors) {
  if (squared_errors.empty()) return kInfinity;
  double sum = 0;
  for (const double error : squared_errors) sum += std::log(error);
  return std::exp(0.5 * sum / static_cast<double>(squared_errors.size()));
}

Counts count(const Mesh& mesh, const Settings& settings) {
  return {count_inverted_if_allowed(mesh, settings.options),
          count_non_regular_edges(mesh, false, settings.hooks.executor), count_bad(mesh, settings.hooks.executor)};
}

Rank rank(const Mesh& mesh, const Settings& settings, const VertexSizes* sizes) {
  Counts counts;  // those that count
  counts.inverted = count_inverted_if_allowed(mesh, settings.options);
  if (settings.options.paper.hidden != HiddenPolicy::keep)
    counts.non_regular = count_non_regular_edges(mesh, false, settings.hooks.executor);
  if (settings.energy.barrier) counts.bad = count_bad(mesh, settings.hooks.executor);
  return rank(mesh, counts, settings, sizes);
}

Rank rank(const Mesh& mesh, const Counts& counts, const Settings& settings, const VertexSizes* sizes) {
  Rank r;
  r.inverted = counts.inverted;
  if (settings.options.paper.hidden != HiddenPolicy::keep) r.non_regular = counts.non_regular;
  if (settings.energy.barrier) r.bad = counts.bad;
  r.missing_lengths = missing_lengths(mesh, settings.accuracy, settings.hooks.executor);
  if (sizes != nullptr) {
    r.lacks_margins = !has_margins(mesh, settings.accuracy.margin, settings.hooks.executor);
    const ErrorModel* model = settings.options.error.model.get();
    r.energy = model != nullptr ? root_mean_square(model->errors(mesh, settings.hooks.executor))
                                : accuracy_energy(mesh, *sizes, settings.accuracy, settings.hooks.executor);
  } else {
    r.energy = total_energy(mesh, settings.model, settings.hooks.executor);
  }
  return r;
}

}  // namespace temper
