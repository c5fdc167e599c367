#include "optimize/run/estimate.hpp"

#include <algorithm>
#include <cmath>

namespace temper {
namespace {

constexpr std::size_t kGains = 4;  // from whose first and last the factor is taken: two alone jump

/// The limits of the stage that a sweep belongs to.
struct Limits {
  double tolerance = 0;  ///< relative
  int sweeps = 0;        ///< of the run, at most
  int after = 0;         ///< sweeps of the stage that follows
};

Limits limits_of(std::span<const SweepRecord> history, const OptimizeOptions& o) {
  if (history.back().objective == Objective::energy) {
    return {o.paper.tolerance, o.max_sweeps, objective_of(o) == Objective::energy ? 0 : o.accuracy.sweeps};
  }
  if (history.back().objective == Objective::error) {
    const auto first = std::ranges::find(history, Objective::error, &SweepRecord::objective);
    return {o.error.tolerance, std::min(o.max_sweeps, first->sweep + o.error.steps)};
  }
  const auto first = std::ranges::find(history, Objective::accuracy, &SweepRecord::objective);
  return {o.accuracy.tolerance, std::min(o.max_sweeps, first->sweep + o.accuracy.sweeps)};
}

bool one_stage(const SweepRecord& a, const SweepRecord& b) {
  return a.softening == b.softening && a.objective == b.objective;
}

}  // namespace

std::optional<double> estimate_sweeps_left(std::span<const SweepRecord> history, const OptimizeOptions& options) {
  if (history.size() <= kGains || options.paper.stopping == StoppingRule::paper) return std::nullopt;
  const std::span<const SweepRecord> last = history.last(kGains + 1);
  double gains[kGains];
  for (std::size_t i = 0; i < kGains; ++i) {
    gains[i] = last[i].energy - last[i + 1].energy;
    if (!one_stage(last[i], last[i + 1]) || !(gains[i] > 0)) return std::nullopt;
  }
  const double shrinking = std::log(gains[0] / gains[kGains - 1]) / (kGains - 1);  // of the gain's logarithm, a sweep
  if (!(shrinking > 0)) return std::nullopt;
  const Limits limits = limits_of(history, options);
  const double target = limits.tolerance * std::abs(last.back().energy);
  const double sweeps = target > 0 ? std::log(gains[kGains - 1] / target) / shrinking : limits.sweeps;
  return std::clamp(std::max(0.0, sweeps) + limits.after, 0.0,
                    static_cast<double>(std::max(0, limits.sweeps - last.back().sweep)));
}

}  // namespace temper
