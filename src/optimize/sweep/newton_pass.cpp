#include "optimize/sweep/newton_pass.hpp"

#include <algorithm>

#include "energy/whole_mesh.hpp"
#include "optimize/step/newton_constants.hpp"

namespace temper {
namespace {

/// Of the triangles that move; +∞ when one of them is not well-centered.
double energy_inside(const Mesh& mesh, const PartSystem& system, const EdgeFormula& formula) {
  double sum = 0;
  TriangleLanes lanes;
  for (std::size_t begin = 0; begin < system.n_triangles() && sum < kInfinity; begin += kLanes) {
    const std::size_t n = system.load(mesh, begin, lanes);
    sum += star_kernels().barrier_sum(formula, lanes, n);
    if (!(sum < kInfinity) || count_bad(lanes, n) > 0) return kInfinity;
  }
  return sum;
}

}  // namespace

bool allows_newton_passes(const Settings& settings) {
  const OptimizeOptions& o = settings.options;
  const bool only_moves = !o.collapse_from && o.removal == Removal::none && !o.anchor && !o.size_band;
  return o.newton_passes && makes_newton_steps(settings) && only_moves && o.order == SweepOrder::hilbert &&
         o.stopping == StoppingRule::relative;
}

void NewtonPass::run(Unknowns unknowns, Watch& watch) {
  const std::size_t count = std::max<std::size_t>(1, (mesh_.n_vertices() + part_size_ / 2) / part_size_);
  const bool shifted = count > 1 && passes_++ % 2 == 1;
  const std::size_t n_parts = shifted ? count + 1 : count;
  desks_.make_room(n_parts);
  const auto block = [&](std::size_t i) {
    if (!watch.goes_on()) return;
    auto& desk = desks_.take([] { return std::make_unique<Worker>(); });
    const Part here = part_of(mesh_.n_vertices(), count, i, shifted);
    improve(here, unknowns, *desk.worker);
    watch.passed(here.last.index - here.first.index, 0);
    desk.leave();
  };
  if (settings_.options.executor != nullptr && !recorder_.on()) {
    static_cast<void>(watch.goes_on());  // asks, should no part run on this thread
    settings_.options.executor->run(n_parts, block);
  } else {
    for (std::size_t i = 0; i < n_parts; ++i) block(i);
  }
}

void NewtonPass::improve(const Part& part, Unknowns unknowns, Worker& worker) {
  const EdgeFormula formula = edge_formula(settings_.model);
  PartSystem& system = worker.system;
  system.gather(mesh_, limits_.mobility, unknowns, part);
  const double before = system.assemble(mesh_, formula);
  if (!(before < kInfinity)) return;
  system.solve();
  worker.before.clear();
  for (std::size_t i = 0; i < system.size(); ++i) worker.before.push_back(mesh_.point(system.vertex(i)));
  double t = 1;
  for (int trial = 0; trial < kTrials; ++trial, t *= 0.5) {
    place(worker, t);
    if (energy_inside(mesh_, system, formula) < before) return record(worker);
  }
  take_back(worker);
}

/// What moves, at t of its step.
void NewtonPass::place(Worker& worker, double t) {
  const PartSystem& system = worker.system;
  for (std::size_t i = 0; i < system.size(); ++i) {
    const Movable movable = system.movable(i);
    if (movable == Movable::nothing) continue;
    const auto [x, y, w] = system.step(i);
    WeightedPoint to = worker.before[i];
    if (movable != Movable::weight) {
      const Vec2 p = frame_.snap({to.x + t * x, to.y + t * y});
      to.x = p.x, to.y = p.y;
    }
    if (movable != Movable::position) to.w += t * w;
    mesh_.set_point(system.vertex(i), to);
  }
}

void NewtonPass::take_back(Worker& worker) {
  const PartSystem& system = worker.system;
  for (std::size_t i = 0; i < system.size(); ++i) {
    if (system.movable(i) != Movable::nothing) mesh_.set_point(system.vertex(i), worker.before[i]);
  }
}

void NewtonPass::record(const Worker& worker) const {
  if (!recorder_.on()) return;
  for (std::size_t i = 0; i < worker.system.size(); ++i) {
    const VertexId v = worker.system.vertex(i);
    if (mesh_.point(v) != worker.before[i]) {
      recorder_.placed(v, worker.before[i], mesh_.point(v), kNoEnergy, kNoEnergy);
    }
  }
}

}  // namespace temper
