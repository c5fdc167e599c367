#include "optimize/run/judge.hpp"

#include <cmath>
#include <vector>

#include "energy/whole_mesh.hpp"
#include "optimize/run/lengths.hpp"
#include "optimize/run/run.hpp"
#include "temper/regularity.hpp"

namespace temper {

bool replaces(const MeshScore& now, const MeshScore& best, Requirement required) {
  if (required == Requirement::fewer_bad) return now.bad < best.bad;
  if (best < now) return false;
  return required == Requirement::not_worse || now.bad < best.bad || now.missing_lengths < best.missing_lengths;
}

double root_mean_square(const std::vector<double>& squared_errors) {
  if (squared_errors.empty()) return kInfinity;
  double sum = 0;
  for (const double error : squared_errors) sum += std::log(error);
  return std::exp(0.5 * sum / static_cast<double>(squared_errors.size()));
}

Counts count(const Mesh& mesh, const Settings& settings) {
  return {settings.policy.allows_inversion ? count_inverted(mesh) : 0,
          count_non_regular_edges(mesh, false, settings.executor()), count_bad(mesh, settings.executor())};
}

MeshScore score(const Mesh& mesh, const Settings& settings, const EnergyModel& model, const VertexSizes* sizes) {
  Counts counts;  // those that matter to the score
  if (settings.policy.allows_inversion) counts.inverted = count_inverted(mesh);
  if (!settings.policy.keeps_hidden) counts.non_regular = count_non_regular_edges(mesh, false, settings.executor());
  if (settings.energy().barrier) counts.bad = count_bad(mesh, settings.executor());
  return score(mesh, counts, settings, model, sizes);
}

MeshScore score(const Mesh& mesh, const Counts& counts, const Settings& settings, const EnergyModel& model,
                const VertexSizes* sizes) {
  Executor* const executor = settings.executor();
  MeshScore s;
  s.inverted = counts.inverted;
  if (!settings.policy.keeps_hidden) s.non_regular = counts.non_regular;
  if (settings.energy().barrier) s.bad = counts.bad;
  s.missing_lengths = missing_lengths(mesh, settings.accuracy, executor);
  if (sizes == nullptr) {
    s.energy = total_energy(mesh, model, executor);
    return s;
  }
  s.lacks_margins = !has_margins(mesh, settings.accuracy.margin, executor);
  s.energy = settings.errors != nullptr ? root_mean_square(settings.errors->errors(mesh, executor))
                                        : accuracy_energy(mesh, *sizes, settings.accuracy, executor);
  return s;
}

}  // namespace temper
