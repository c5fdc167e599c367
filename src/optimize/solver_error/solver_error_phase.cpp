#include "optimize/solver_error/solver_error_phase.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/sum.hpp"
#include "energy/whole_mesh.hpp"
#include "mesh/blocks.hpp"
#include "optimize/flips/guard.hpp"
#include "optimize/run/judge.hpp"
#include "optimize/trace/recorder.hpp"
#include "temper/detail/discretization_error.hpp"

namespace temper {
namespace {

constexpr double kLongestStep = 0.3;      // of a scaled unknown in a step
constexpr double kKeptRoom = 0.2;         // part of a triangle's room above its floor that a step must leave
constexpr int kMostHalvings = 25;         // halvings of a step
constexpr double kArmijo = 1e-4;          // part of the gradient's prediction that a step must reach (Armijo)
constexpr std::size_t kStepsToGain = 10;  // number of steps that together must gain the tolerance

void add(WeightedPoint& to, double factor, const WeightedPoint& of) {
  to.x += factor * of.x;
  to.y += factor * of.y;
  to.w += factor * of.w;
}

double mean_ratio(const std::vector<double>& errors, const std::vector<double>& start) {
  double sum = 0;
  for (std::size_t i = 0; i < errors.size(); ++i) sum += errors[i] / start[i];
  return sum / static_cast<double>(errors.size());
}

/// Returns settings with which no edge flips and no vertex slides.
Settings of_errors(Settings s) {
  s.options.flips = Flips::none;
  s.options.boundary = BoundaryVertices::keep;
  s.options.interfaces = InterfaceVertices::fixed;
  s.options.paper.insertion_from.reset();
  s.policy = Policy(s.options);
  return s;
}

}  // namespace

SolverErrorPhase::SolverErrorPhase(WorkingCopy& work, const Settings& settings, Run& run, VertexSizes sizes)
    : SizedPhase(work, of_errors(settings), run, std::move(sizes)), units_(work.units) {
  const auto mobility = mobilities(mesh_, settings_.options, settings_.executor());
  dofs_.resize(mesh_.n_vertices());
  for (const VertexId v : mesh_.vertices()) dofs_[v] = dofs(mesh_, v, mobility[v], settings_.options.unknowns);
}

void SolverErrorPhase::begin() {
  raise_floors();
  beyond_guard_ = count_beyond(mesh_, units_, settings_.guard, settings_.executor());
  now_ = value();
  history_ = {now_.lowered};
}

bool SolverErrorPhase::may_sweep() const {
  const bool can = bad_ == 0 && std::isfinite(now_.lowered);
  const bool steps_left = iteration < most_solver_error_steps(settings_.options);
  if (!can) run_.report.stopped = Stopped::converged;
  if (can && !steps_left) run_.report.stopped = Stopped::sweep_limit;
  return can && steps_left && run_.sweeps_left();
}

/// Makes one step of L-BFGS, halved until it lowers the objective. Returns false if the caller has stopped the run.
std::optional<bool> SolverErrorPhase::move_all(const Recorder& recorder) {
  IdVector<VertexId, WeightedPoint> before(mesh_.n_vertices());
  for (const VertexId v : mesh_.vertices()) before[v] = mesh_.point(v);
  Vector step = descent_.direction(now_.gradient);
  shorten(before, step);
  const double slope = dot(now_.gradient, step);
  Value there;
  double t = 1;
  bool found = false;
  for (int i = 0; i < kMostHalvings && slope < 0 && !found; ++i, t *= found ? 1 : 0.5) {
    place(before, step, t);
    if (!is_inside()) continue;
    there = value();
    found = there.lowered <= now_.lowered + kArmijo * t * slope;
    if (run_.asked_to_stop(0)) break;
  }
  if (!found) {
    place(before, step, 0);
    stuck_ = descent_.knows_nothing();
    descent_.forget();
  } else {
    Vector change = there.gradient;
    for (std::size_t i = 0; i < change.size(); ++i) change[i] -= now_.gradient[i], step[i] *= t;
    descent_.learn(std::move(step), std::move(change));
    now_ = std::move(there);
    for (const VertexId v : mesh_.vertices()) {
      if (recorder.on() && mesh_.point(v) != before[v]) {
        recorder.placed(v, before[v], mesh_.point(v), kNoEnergy, kNoEnergy);
      }
    }
  }
  return !run_.stopped_early() && !run_.asked_to_stop(0);
}

SweepRecord SolverErrorPhase::measure() {
  return {.energy = now_.error, .bad = bad_, .objective = Objective::solver_error};
}

Phase::Verdict SolverErrorPhase::judge(bool /*changed*/) {
  if (raise_floors()) {
    now_ = value();  // the barrier has changed
    descent_.forget();
  }
  history_.push_back(now_.lowered);
  const bool slow = history_.size() > kStepsToGain && history_[history_.size() - 1 - kStepsToGain] - now_.lowered <
                                                          settings_.options.solver_error.tolerance;
  if (!stuck_ && !slow) return Verdict::improving;
  run_.report.stopped = Stopped::converged;
  return Verdict::settled;
}

SolverErrorPhase::Value SolverErrorPhase::value() {
  Executor* executor = settings_.executor();
  Value result;
  result.lowered = result.error = kInfinity;
  const auto [energy, barrier] = sum();
  const double total = energy + barrier, share = settings_.options.solver_error.offset_share;
  if (!std::isfinite(total) || !(total > 0)) return result;
  std::vector<DiscretizationError::Gradient> gradients;
  const std::vector<double> errors = settings_.errors->errors(mesh_, gradients, executor);
  if (start_.empty()) start_ = errors;
  if (errors.empty()) return result;
  result.error = root_mean_square(errors);
  result.lowered = std::log(mean_ratio(errors, start_)) + share * std::log(total);
  DiscretizationError::Gradient gradient(mesh_.n_vertices(), WeightedPoint{});
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const double factor = 1 / (static_cast<double>(errors.size()) * start_[i] * mean_ratio(errors, start_));
    for (const VertexId v : mesh_.vertices()) add(gradient[v], factor, gradients[i][v]);
  }
  add_gradient_of_energy(share / total, gradient);
  result.gradient = scaled(gradient);
  return result;
}

/// Only the star of a vertex depends on it in E and B.
void SolverErrorPhase::add_gradient_of_energy(double factor, IdVector<VertexId, WeightedPoint>& gradient) const {
  for_blocks(mesh_.n_vertices(), settings_.executor(), [&](std::size_t first, std::size_t last) {
    AccuracyPatch patch;
    for (std::size_t i = first; i < last; ++i) {
      const VertexId v(i);
      if (mesh_.is_isolated(v) || !patch.gather(mesh_, domain_.sizes, domain_.floors, settings_.accuracy, v)) continue;
      if (!std::isfinite(patch.value(mesh_.point(v)))) continue;
      const auto [x, y, w] = patch.derivatives().gradient;
      add(gradient[v], factor, {x, y, w});
    }
  });
}

/// Says exactly whether all triangles are well-centered. The barrier says whether they are above their floors.
bool SolverErrorPhase::is_inside() const {
  return count_bad(mesh_, settings_.executor()) <= bad_ &&
         count_beyond(mesh_, units_, settings_.guard, settings_.executor()) <= beyond_guard_;
}

void SolverErrorPhase::shorten(const IdVector<VertexId, WeightedPoint>& from, Vector& step) {
  const auto scale = [&](VertexId v, double factor) {
    for (double* x = &step[3 * std::size_t{v.index}]; x != &step[3 * std::size_t{v.index}] + 3; ++x) *x *= factor;
  };
  for (const VertexId v : mesh_.vertices()) {
    const double* by = &step[3 * std::size_t{v.index}];
    const double most = std::max({std::abs(by[0]), std::abs(by[1]), std::abs(by[2])});
    if (most > kLongestStep) scale(v, kLongestStep / most);
  }
  const auto room = [this](TriangleId t) {
    return triangle_margin(mesh_, t) - (domain_.floors.has(t) ? domain_.floors[t] : 0);
  };
  IdVector<TriangleId, double> least(mesh_.n_triangles(), 0.0);
  for_each_index(least.size(), settings_.executor(), [&](std::size_t i) {
    const TriangleId t(i);
    least[t] = kKeptRoom * room(t);
  });
  std::vector<std::uint8_t> is_short(least.size());
  for (int i = 0; i < kMostHalvings; ++i) {
    place(from, step, 1);
    for_each_index(least.size(), settings_.executor(), [&](std::size_t k) {
      const TriangleId t(k);
      is_short[k] = room(t) >= least[t] ? 0 : 1;
    });
    IdVector<VertexId, std::uint8_t> halved(mesh_.n_vertices(), 0);
    for (const TriangleId t : mesh_.triangles()) {
      if (is_short[t.index] == 0) continue;
      for (const VertexId v : mesh_.corners(t)) {
        if (std::exchange(halved[v], 1) == 0) scale(v, 0.5);
      }
    }
    if (std::find(is_short.begin(), is_short.end(), 1) == is_short.end()) break;
  }
}

void SolverErrorPhase::place(const IdVector<VertexId, WeightedPoint>& from, const Vector& step, double t) {
  for (const VertexId v : mesh_.vertices()) {
    WeightedPoint p = from[v];
    const double s = t * domain_.sizes[v];
    const double* by = &step[3 * std::size_t{v.index}];
    if (dofs_[v].moves()) {
      const Vec2 to = units_.snap(Vec2{p.x + s * by[0], p.y + s * by[1]});
      p.x = to.x, p.y = to.y;
    }
    p.w += s * domain_.sizes[v] * by[2];
    mesh_.set_point(v, t == 0 || p == from[v] ? from[v] : p);
  }
}

/// Returns the gradient by the scaled unknowns, three per vertex; 0 for a coordinate that is no unknown.
SolverErrorPhase::Vector SolverErrorPhase::scaled(const IdVector<VertexId, WeightedPoint>& gradient) const {
  Vector result(3 * mesh_.n_vertices(), 0.0);
  for (const VertexId v : mesh_.vertices()) {
    const Dofs& free = dofs_[v];
    const double s = domain_.sizes[v];
    double* to = &result[3 * std::size_t{v.index}];
    if (free.moves()) to[0] = s * gradient[v].x, to[1] = s * gradient[v].y;
    if (free.weighs()) to[2] = s * s * gradient[v].w;
  }
  return result;
}

}  // namespace temper
