#include "experiments/weight_policies.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "experiments/recording.hpp"

namespace temper::gallery {
namespace {

constexpr int kPolicySweeps = 40;
constexpr double kNoChange = 1e-9;  // of a weight: rounding, and the shift to the anchor's zero

/// Changes of each vertex's weight, against its last one.
class Reversals {
 public:
  explicit Reversals(std::size_t n) : last_(n, 0) {}
  void add(VertexId v, double change) {
    if (std::abs(change) <= kNoChange) return;
    if (last_[v] != 0) {
      ++all_;
      if (last_[v] * change < 0) ++reversed_;
    }
    last_[v] = change;
  }
  [[nodiscard]] double part() const {
    return all_ == 0 ? 0 : static_cast<double>(reversed_) / static_cast<double>(all_);
  }

 private:
  IdVector<VertexId, double> last_;
  std::size_t all_ = 0, reversed_ = 0;
};

/// Edges that flips took away and did not bring back, by the start's numbers of their ends.
class EdgesGone {
 public:
  /// Whether the edge that the flip makes is one of them.
  bool add_flip(VertexId a, VertexId b, VertexId c, VertexId d) {
    edges_.insert(std::minmax({a, b}));
    return edges_.erase(std::minmax({c, d})) > 0;
  }

 private:
  std::set<std::pair<VertexId, VertexId>> edges_;
};

/// One sweep, and the flips after it. Where the weights hide a corner of the domain it is kept.
Moment one_sweep(PolicyRun& policy_run, EdgesGone& gone, const OptimizeOptions& options) {
  Recording run = record(policy_run.end, options, Keep::sweeps);
  if (!run.error.empty()) {
    OptimizeOptions keeping = options;
    keeping.paper.hidden = HiddenPolicy::keep;
    run = record(policy_run.end, keeping, Keep::sweeps);
  }
  VertexId last;  // whose weight was the last to change
  for (const TraceEvent& e : run.events) {
    if (e.kind == EventKind::weight || e.kind == EventKind::move) last = e.vertex;
    if (e.kind != EventKind::flip) continue;
    ++policy_run.flips;
    const auto& names = policy_run.vertices;
    const auto [a, b, c, d] = e.quad;
    const bool back = gone.add_flip(names[a.index], names[b.index], names[c.index], names[d.index]);
    if (!last.valid()) continue;
    ++policy_run.flips_by_vertex[names[last.index]];
    if (back) ++policy_run.flips_back_by_vertex[names[last.index]];
  }
  return std::move(run.moments.back());
}

int settled_at(const std::vector<double>& energies) {
  std::size_t i = energies.size() - 1;
  const double bound = PolicyRun::kSettled * std::abs(energies.back());
  while (i > 0 && std::abs(energies[i - 1] - energies.back()) <= bound) --i;
  return static_cast<int>(i);
}

}  // namespace

std::vector<WeightPolicy> weight_policies() {
  std::vector<WeightPolicy> policies;
  for (const auto& [limit, limit_name] :
       {std::pair{FlipLimit::unlimited, "unlimited"}, std::pair{FlipLimit::before, "before"},
        std::pair{FlipLimit::after, "after"}}) {
    using enum Updates;
    policies.push_back({limit_name, "weights and flips at once", limit, immediate, Flips::immediate});
    policies.push_back({limit_name, "flips deferred", limit, immediate, Flips::deferred});
    policies.push_back({limit_name, "weights and flips deferred", limit, deferred, Flips::deferred});
  }
  return policies;
}

OptimizeOptions policy_options(const WeightPolicy& policy, const VertexOrder& order) {
  OptimizeOptions options = positions_and_collapses();
  options.unknowns = Unknowns::weights;
  options.paper.collapse_from = {};
  visit_in(order, options);
  options.paper.weight_updates = policy.weights;
  options.flips = policy.flips;
  options.paper.flip_limit = policy.limit;
  options.paper.hidden = HiddenPolicy::remove;
  options.paper.inner = 1;
  options.paper.outer = 1;
  options.max_sweeps = 1;
  return options;
}

PolicyRun run_policy(const WeightPolicy& policy, const Mesh& start, const VertexOrder& order, int sweeps,
                     const WeightReading& reading) {
  OptimizeOptions options = policy_options(policy, order);
  options.energy = reading.energy;
  options.paper.weight_search_radius = reading.reach;
  EnergyModel model = energy_dt();
  model.kind = reading.energy;
  const double overshoot = options.paper.overshoot - 1;
  PolicyRun run;
  run.policy = policy;
  run.energies = {total_energy(start, model)};
  run.end = start;
  for (const VertexId v : start.vertices()) run.vertices.push_back(v);
  Reversals reversals(start.n_vertices());
  EdgesGone gone;
  for (int i = 0; i < sweeps; ++i) {
    options.paper.overshoot = 1 + overshoot * std::pow(0.1, i);  // as it would shrink in one run
    Moment after = one_sweep(run, gone, options);
    std::vector<VertexId> vertices;
    for (const VertexId v : after.mesh.vertices()) {
      const VertexId before = after.vertices[v];
      vertices.push_back(run.vertices[before.index]);
      reversals.add(vertices.back(), after.mesh.weight(v) - run.end.weight(before));
    }
    run.rises += after.energy > run.energies.back() ? 1 : 0;
    run.energies.push_back(after.energy);
    run.end = std::move(after.mesh);
    run.vertices = std::move(vertices);
  }
  for (const VertexId v : start.vertices()) {
    if (std::ranges::find(run.vertices, v) != run.vertices.end()) continue;
    ++(start.is_boundary(v) ? run.hidden_on_boundary : run.hidden_inside);
  }
  run.reversals = reversals.part();
  run.settled = settled_at(run.energies);
  return run;
}

std::vector<PolicyRun> run_policies(const VertexOrder& order, const WeightReading& reading) {
  std::vector<PolicyRun> all;
  for (const WeightPolicy& policy : weight_policies()) {
    all.push_back(run_policy(policy, oscillating_mesh(), order, kPolicySweeps, reading));
  }
  return all;
}

const std::vector<PolicyRun>& policy_runs(const WeightReading& reading) {
  static std::map<WeightReading, std::vector<PolicyRun>> runs;
  const auto found = runs.find(reading);
  return found != runs.end() ? found->second
                             : runs.emplace(reading, run_policies(shown_order(), reading)).first->second;
}

const PolicyRun& policy_run(const std::vector<PolicyRun>& runs, FlipLimit limit, std::size_t column) {
  const auto row = static_cast<std::size_t>(std::ranges::find(kPolicyRows, limit) - std::begin(kPolicyRows));
  return runs[row * kPolicyColumns + column];
}

}  // namespace temper::gallery
