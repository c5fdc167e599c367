#include "experiments/position_weight_loop.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "temper/detail/geometry.hpp"
#include "temper/regularity.hpp"

namespace temper::gallery {
namespace {

std::size_t count_inverted(const Mesh& mesh) {
  std::size_t count = 0;
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    if (orient2d(mesh.position(a), mesh.position(b), mesh.position(c)) != Sign::positive) ++count;
  }
  return count;
}

LoopStage stage(std::string name, const Mesh& mesh, EnergyKind energy) {
  EnergyModel model;
  model.kind = energy;
  LoopStage s{std::move(name), mesh, total_energy(mesh, model), count_inverted(mesh), 0, 0};
  if (s.inverted == 0) s.non_regular = count_non_regular_edges(mesh);
  for (const VertexId v : mesh.vertices()) s.largest_weight = std::max(s.largest_weight, std::abs(mesh.weight(v)));
  return s;
}

OptimizeOptions options_of(const PositionWeightLoop& loop, const VertexOrder& order, int sweeps) {
  OptimizeOptions options = positions_and_collapses();
  options.energy = loop.energy;
  options.unknowns = Unknowns::positions_and_weights;
  options.paper.collapse_from = {};
  options.paper.anchor = {};
  options.paper.inversion = Inversion::allow;
  options.paper.visits = Visits::twice;
  options.paper.weight_reach = loop.weight_reach;
  options.paper.flip_limit = loop.limited ? FlipLimit::after : FlipLimit::unlimited;
  options.paper.inner = 1;
  options.paper.outer = 0;
  options.paper.stopping = StoppingRule::relative;  // a rise ends the paper's
  options.paper.tolerance = 0;
  options.max_sweeps = sweeps;
  visit_in(order, options);
  return options;
}

/// The mesh after the positions of a sweep, counted from 1: all events up to the last move of it.
Mesh after_positions(const Recording& run, int sweep) {
  std::size_t end = 0;
  for (std::size_t i = 0; i < run.events.size(); ++i) {
    if (run.events[i].sweep < sweep || (run.events[i].sweep == sweep && run.events[i].kind == EventKind::move))
      end = i + 1;
  }
  auto mesh = replay(run.moments.front().mesh, std::span(run.events).first(end));
  return mesh ? *std::move(mesh) : Mesh();
}

}  // namespace

std::vector<LoopStage> run_loop(const PositionWeightLoop& loop, const Mesh& start, const VertexOrder& order,
                                int sweeps) {
  const Recording run = record(start, options_of(loop, order, sweeps), Keep::sweeps);
  std::vector<LoopStage> stages = {stage("start", start, loop.energy)};
  for (const Moment& m : run.moments) {
    if (m.kind == Snapshot::Moment::after_sweep) {
      const std::string number = std::to_string(m.sweep);
      stages.push_back(stage("positions " + number, after_positions(run, m.sweep), loop.energy));
      stages.push_back(stage("weights " + number, m.mesh, loop.energy));
    } else if (m.kind == Snapshot::Moment::after_flips) {
      stages.push_back(stage("flips " + std::to_string(m.sweep), m.mesh, loop.energy));
    }
  }
  return stages;
}

}  // namespace temper::gallery
