#include "experiments/summary_matrix.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "experiments/closeness.hpp"
#include "experiments/domain.hpp"
#include "experiments/energies.hpp"
#include "experiments/high_heat.hpp"
#include "temper/quality.hpp"

namespace temper::gallery {
namespace {

// Energies of a mess are 1e12 and more, of meshes without one at most a few times the input's.
constexpr double kBeyondBounds = 1000;

OptimizeOptions options_of(const Cell& cell, Effort effort, Inversion inversion, Star star) {
  OptimizeOptions options = high_heat_options(cell.energy);
  options.unknowns = cell.unknowns;
  options.paper.weights_from = 0;
  options.paper.inversion = inversion;
  options.paper.outer = 4;
  options.star = star;
  options.max_sweeps = effort == Effort::reduced ? 20 : star == Star::one ? 150 : 60;
  if (cell.rule == RemovalRule::patch) options.paper.removal = Removal::patch;
  if (cell.rule != RemovalRule::short_edge) options.paper.collapse_from = {};
  return options;
}

Ending ending_of(const Recording& run) {
  const Moment& last = run.moments.back();
  Ending e;
  e.mesh = last.mesh;
  const Quality q = quality(e.mesh);
  e.inverted = q.inverted_triangles;
  e.non_regular = q.non_regular_edges;
  e.coincident = close_pairs(e.mesh).size();
  e.energy = last.energy;
  e.well_centered = q.well_centered_fraction;
  const double bound = kBeyondBounds * std::abs(run.moments.front().energy);
  if (e.inverted > 0 || !(std::abs(e.energy) < bound)) {
    e.verdict = Verdict::mess;
  } else if (e.non_regular > 0) {
    e.verdict = Verdict::hidden;
  } else if (e.coincident > 0) {
    e.verdict = Verdict::collapsed;
  }
  return e;
}

void run_cell(Cell& cell, const OptimizeOptions& setting, Effort effort) {
  std::vector<VertexOrder> orders = vertex_orders(effort == Effort::full ? 1 : 0);
  if (setting.star != Star::one) orders.resize(2);
  if (effort == Effort::reduced) orders.resize(1);
  for (const VertexOrder& order : orders) {
    OptimizeOptions options = setting;
    visit_in(order, options);
    const Recording run = record(dense_horseshoe(), options, Keep::outer);
    if (run.error.empty()) cell.endings.push_back(ending_of(run));
  }
}

Matrix compute(Effort effort, Inversion inversion, Star star) {
  Matrix matrix;
  for (const std::string_view energy : kFiveEnergies) {
    for (const Unknowns unknowns : kUnknowns) {
      for (const RemovalRule rule : kRules) {
        Cell cell{energy, unknowns, rule, {}};
        run_cell(cell, options_of(cell, effort, inversion, star), effort);
        matrix.cells.push_back(std::move(cell));
      }
    }
  }
  return matrix;
}

}  // namespace

std::vector<Ending> endings(std::string_view energy, Unknowns unknowns, RemovalRule rule, HiddenPolicy hidden,
                            Effort effort) {
  Cell cell{energy, unknowns, rule, {}};
  OptimizeOptions options = options_of(cell, effort, Inversion::refuse, Star::one);
  options.paper.hidden = hidden;
  run_cell(cell, options, effort);
  return std::move(cell.endings);
}

std::string_view name(Verdict verdict) {
  constexpr std::array<std::string_view, kVerdicts> kNames = {"HOT mess", "hidden vertices", "collapsed edges",
                                                              "good mesh"};
  return kNames[static_cast<std::size_t>(verdict)];
}

std::size_t Cell::count(Verdict verdict) const {
  return static_cast<std::size_t>(std::ranges::count(endings, verdict, &Ending::verdict));
}

Verdict Cell::verdict() const {
  Verdict most = Verdict::mess;
  for (std::size_t i = 1; i < kVerdicts; ++i) {
    if (count(static_cast<Verdict>(i)) > count(most)) most = static_cast<Verdict>(i);
  }
  return most;
}

const Cell& Matrix::at(std::string_view energy, Unknowns unknowns, RemovalRule rule) const {
  return *std::ranges::find_if(
      cells, [&](const Cell& c) { return c.energy == energy && c.unknowns == unknowns && c.rule == rule; });
}

const Matrix& summary_matrix(Effort effort, Inversion inversion, Star star) {
  static std::map<std::tuple<Effort, Inversion, Star>, Matrix> computed;
  const auto key = std::tuple(effort, inversion, star);
  const auto found = computed.find(key);
  return found != computed.end() ? found->second
                                 : computed.emplace(key, compute(effort, inversion, star)).first->second;
}

}  // namespace temper::gallery
