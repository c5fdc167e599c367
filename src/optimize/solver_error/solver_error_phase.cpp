#include "optimize/solver_error/solver_error_phase.hpp"

#include <cmath>
#include <utility>

#include "energy/whole_mesh.hpp"
#include "optimize/flips/guard.hpp"
#include "optimize/run/judge.hpp"
#include "optimize/trace/recorder.hpp"

namespace temper {
namespace {

constexpr std::size_t kStepsToGain = 10;  // number of steps that together must gain the tolerance

void add(WeightedPoint& to, double factor, const WeightedPoint& of) {
  to.x += factor * of.x;
  to.y += factor * of.y;
  to.w += factor * of.w;
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
    : SizedPhase(work, of_errors(settings), run, std::move(sizes)), units_(work.units), before_(mesh_.n_vertices()) {
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

/// Returns false if the caller has stopped the run.
std::optional<bool> SolverErrorPhase::move_all(const Recorder& recorder) {
  for (const VertexId v : mesh_.vertices()) before_[v] = mesh_.point(v);
  is_last_step_ = iteration + 1 >= most_solver_error_steps(settings_.options);
  const Descent::Outcome outcome =
      descent_.take_step(*this, now_, settings_.executor(), [this] { return run_.asked_to_stop(0); });
  stuck_ = outcome == Descent::Outcome::stuck;
  for (const VertexId v : mesh_.vertices()) {
    if (recorder.on() && mesh_.point(v) != before_[v])
      recorder.placed(v, before_[v], mesh_.point(v), kNoEnergy, kNoEnergy);
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
  Value result;
  result.lowered = result.error = kInfinity;
  const auto [energy, barrier] = sum();
  const double total = energy + barrier;
  if (!std::isfinite(total) || !(total > 0)) return result;
  std::vector<Gradient> gradients;
  const std::vector<double> errors =
      settings_.errors->errors(mesh_, is_last_step_ ? nullptr : &gradients, settings_.executor());
  if (start_.empty()) start_ = errors;
  if (errors.empty()) return result;
  result.error = root_mean_square(errors);
  const LogObjective objective = log_objective(errors, start_, total, settings_.options.solver_error.offset_share);
  result.lowered = objective.value;
  if (is_last_step_) return result;
  Gradient gradient(mesh_.n_vertices(), WeightedPoint{});
  for (std::size_t i = 0; i < errors.size(); ++i) {
    for (const VertexId v : mesh_.vertices()) add(gradient[v], objective.by_error[i], gradients[i][v]);
  }
  const Gradient of_energy = accuracy_gradient(mesh_, domain_, settings_.accuracy, settings_.executor());
  for (const VertexId v : mesh_.vertices()) add(gradient[v], objective.by_total, of_energy[v]);
  result.gradient = scaled(gradient);
  return result;
}

/// Says exactly whether all triangles are well-centered. The barrier says whether they are above their floors.
bool SolverErrorPhase::is_inside() const {
  return count_bad(mesh_, settings_.executor()) <= bad_ &&
         count_beyond(mesh_, units_, settings_.guard, settings_.executor()) <= beyond_guard_;
}

double SolverErrorPhase::room(std::size_t triangle) const {
  const TriangleId t(triangle);
  return triangle_margin(mesh_, t) - (domain_.floors.has(t) ? domain_.floors[t] : 0);
}

void SolverErrorPhase::place(const Vector& step, double t) {
  for (const VertexId v : mesh_.vertices()) {
    WeightedPoint p = before_[v];
    const double s = t * domain_.sizes[v];
    const double* by = &step[kUnknowns * v.index];
    if (dofs_[v].moves()) {
      const Vec2 to = units_.snap(Vec2{p.x + s * by[0], p.y + s * by[1]});
      p.x = to.x, p.y = to.y;
    }
    p.w += s * domain_.sizes[v] * by[2];
    mesh_.set_point(v, t == 0 || p == before_[v] ? before_[v] : p);
  }
}

/// Returns the gradient by the scaled unknowns; 0 for a coordinate that is no unknown.
SolverErrorPhase::Vector SolverErrorPhase::scaled(const Gradient& gradient) const {
  Vector result(kUnknowns * mesh_.n_vertices(), 0.0);
  for (const VertexId v : mesh_.vertices()) {
    const Dofs& free = dofs_[v];
    const double s = domain_.sizes[v];
    double* to = &result[kUnknowns * v.index];
    if (free.moves()) to[0] = s * gradient[v].x, to[1] = s * gradient[v].y;
    if (free.weighs()) to[2] = s * s * gradient[v].w;
  }
  return result;
}

}  // namespace temper
