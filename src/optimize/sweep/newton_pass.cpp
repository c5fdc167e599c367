#include "optimize/sweep/newton_pass.hpp"

#include <algorithm>

#include "base/assert.hpp"
#include "energy/whole_mesh.hpp"
#include "optimize/step/search.hpp"

namespace temper {
namespace {

/// The energy of the triangles that move; +∞ when one of them is not well-centered.
double energy_inside(const Mesh& mesh, const PartSystem& system, const EdgeFormula& formula) {
  double sum = 0;
  TriangleLanes lanes;
  for (std::size_t begin = 0; begin < system.n_triangles() && sum < kInfinity; begin += kLanes) {
    const std::size_t n = system.load(mesh, begin, lanes);
    sum += star_kernels(mesh.space()).barrier_sum(formula, lanes, n);
    if (!(sum < kInfinity) || count_bad(mesh.space(), lanes, n) > 0) return kInfinity;
  }
  return sum;
}

}  // namespace

bool allows_newton_passes(const Settings& settings, const Space& space) {
  const OptimizeOptions& o = settings.options;
  const bool only_moves =
      !changes_vertices(o) && !o.paper.anchor.valid() && !o.size_band && o.paper.visits == Visits::once;
  return space.kind() == SpaceKind::plane && o.paper.newton_passes && makes_newton_steps(settings) && only_moves &&
         o.paper.order == SweepOrder::hilbert && o.paper.stopping == StoppingRule::relative;
}

void NewtonPass::run(Unknowns unknowns, StopToken& stop) {
  TEMPER_ASSERT_SLOW(count_bad(mesh_, nullptr) == 0);
  const std::size_t count = std::max<std::size_t>(1, (mesh_.n_vertices() + part_size_ / 2) / part_size_);
  const Cut cut{mesh_.n_vertices(), count, count > 1 && passes_++ % 2 == 1};
  const Engine engine = recorder_.on() ? Engine(&in_order_) : engine_of(settings_.hooks);
  const auto pass = [&](Worker& worker, std::size_t i) {
    const Part part = cut[i];
    if (!stop.goes_on()) return;
    improve(part, unknowns, worker);
    stop.passed(part.last.index - part.first.index, 0);
  };
  const auto vertices = [&](std::size_t i) { return IdRange<VertexId>(cut[i].first, cut[i].last); };
  for_parts(
      cut.size(), engine, workers_, stop, pass,
      [&](ByteWriter& writer, std::size_t i) { write_points(writer, mesh_, vertices(i)); },
      [&](ByteReader& reader, std::size_t i) { read_points(reader, mesh_, vertices(i)); });
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
  bool found = false;
  damped_search(1, kTrials, 1.0, true, [&](double& t, double shorter, bool) {
    place(worker, t);
    t *= shorter;
    found = energy_inside(mesh_, system, formula) < before;
    return !found;
  });
  found ? record(worker) : take_back(worker);
}

/// Puts the vertices that move to t of their steps.
void NewtonPass::place(Worker& worker, double t) {
  const PartSystem& system = worker.system;
  for (std::size_t i = 0; i < system.size(); ++i) {
    const Movable movable = system.movable(i);
    if (movable == Movable::nothing) continue;
    const auto [x, y, w] = system.step(i);
    WeightedPoint to = worker.before[i];
    if (movable != Movable::weight) {
      const Vec2 p = frame_.snap(Vec2{to.x + t * x, to.y + t * y});
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
