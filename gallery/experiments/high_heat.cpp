#include "experiments/high_heat.hpp"

#include <span>
#include <string>
#include <utility>

#include "experiments/domain.hpp"
#include "experiments/energies.hpp"
#include "experiments/oscillating_horseshoe.hpp"

namespace temper::gallery {
namespace {

constexpr int kWeightsFrom = 40;  // the paper's i_w
constexpr int kRandomOrders = 5;

OrderedHeat summary(std::string order, const Recording& run) {
  OrderedHeat heat{std::move(order), collapses_by_outer(run), {}};
  for (const Moment* m : run.all(Snapshot::Moment::before_flips)) heat.optimal.push_back(m->mesh);
  return heat;
}

std::vector<OrderedHeat> survey(Effort effort) {
  std::vector<OrderedHeat> all;
  for (const VertexOrder& order : vertex_orders(effort == Effort::full ? kRandomOrders : 0)) {
    if (order.order == SweepOrder::input) {
      all.push_back(summary(order.name, high_heat_bp()));
      continue;
    }
    if (effort == Effort::reduced && order.order != SweepOrder::reverse) continue;
    OptimizeOptions options = high_heat_options("BP");
    visit_in(order, options);
    options.max_sweeps = kSurveySweeps;
    all.push_back(summary(order.name, record(dense_horseshoe(), options, Keep::outer)));
  }
  return all;
}

}  // namespace

const std::vector<OrderedHeat>& high_heat_by_order(Effort effort) {
  if (effort == Effort::full) {
    static const std::vector<OrderedHeat> full = survey(Effort::full);
    return full;
  }
  static const std::vector<OrderedHeat> reduced = survey(Effort::reduced);
  return reduced;
}

OptimizeOptions high_heat_options(std::string_view energy) {
  OptimizeOptions options = *options_for("paper");
  options.energy = find_energy(energy)->kind;
  options.paper.gamma = LengthParameter{kPaperGamma, LengthScale::absolute};
  options.paper.h0 = shift_beyond(dense_horseshoe());
  options.paper.removal = Removal::none;
  options.paper.collapse_energy = EnergyKind::F;
  options.paper.weights_from = kWeightsFrom;
  options.paper.inversion = Inversion::infinite;
  return options;
}

const Recording& high_heat_bp() {
  static const Recording run = record(dense_horseshoe(), high_heat_options("BP"), Keep::sweeps);
  return run;
}

const Recording& high_heat_bhs() {
  static const Recording run = record(dense_horseshoe(), high_heat_options("BHs"), Keep::outer);
  return run;
}

std::vector<const Moment*> high_heat_optimal() { return high_heat_bp().all(Snapshot::Moment::before_flips); }
std::vector<const Moment*> high_heat_flipped() { return high_heat_bp().all(Snapshot::Moment::after_flips); }

std::vector<CollapseEvent> collapses(const Recording& run) {
  const auto ends = run.all(Snapshot::Moment::before_flips);
  std::vector<CollapseEvent> found;
  for (std::size_t i = 0; i < run.events.size(); ++i) {
    const TraceEvent& event = run.events[i];
    if (event.kind != EventKind::collapse) continue;
    int outer = 0, begin = 0;
    for (const Moment* end : ends) {
      if (end->sweep >= event.sweep) break;
      outer = end->outer + 1, begin = end->sweep;
    }
    found.push_back({event.sweep, outer, event.sweep - begin, event.vertex, i});
  }
  return found;
}

std::vector<std::size_t> collapses_by_outer(const Recording& run) {
  std::vector<std::size_t> counts(run.all(Snapshot::Moment::before_flips).size());
  for (const CollapseEvent& c : collapses(run)) {
    if (static_cast<std::size_t>(c.outer) < counts.size()) ++counts[static_cast<std::size_t>(c.outer)];
  }
  return counts;
}

ShortEdge rule_before(const Recording& run, const CollapseEvent& collapse) {
  const auto now = replay_with_vertices(run.moments.front().mesh, std::span(run.events).first(collapse.event));
  if (!now) return {};
  const auto input = [&](VertexId v) { return now->vertices.empty() ? v : now->vertices[v]; };
  for (const VertexId v : now->mesh.vertices()) {
    if (input(v) != collapse.vertex) continue;
    ShortEdge rule = short_edge(now->mesh, v);
    rule.nearest = input(rule.nearest);
    return rule;
  }
  return {};
}

std::string listed(const std::vector<std::size_t>& counts) {
  std::string text;
  for (const std::size_t count : counts) text += (text.empty() ? "" : ", ") + std::to_string(count);
  return text;
}

}  // namespace temper::gallery
