#include "optimize/driver.hpp"

#include <cmath>

#include "base/sum.hpp"
#include "geometry/predicates_inline.hpp"
#include "temper/regularity.hpp"

namespace temper {
namespace {

constexpr std::size_t kVerticesBetweenCalls = 8192;  // of the observer and the clock: a few milliseconds
// Sweeps at the last γ without fewer bad triangles, after which another attempt promises more.
constexpr int kPatience = 25;
// Sweeps in which vertices may bring a barrier's infinite energy down one by one, before all weights shrink.
constexpr int kInfinitePatience = 5;

}  // namespace

void Driver::optimize(const Attempt& attempt, bool may_give_up) {
  Softener softener(attempt, settings_.energy, settings_.options);
  softener.start(mesh_, settings_.model);
  if (run_.report.history.empty()) record(0);
  least_bad_ = mesh_.n_triangles();
  double before = best_energy_ = total();
  run_.report.stopped = Stopped::max_sweeps;
  for (int sweep = 0; run_.sweeps_left(); ++sweep) {
    const bool whole = improve_all_vertices(sweep);
    // Collapse, removal and insertion of vertices go here: they change the mesh between sweeps, never within one.
    shift_weights_to_anchor();
    const std::size_t flips = step_.flips() + restore_deferred_flips();
    ++run_.report.sweeps;
    record(flips);
    keep_if_best();
    if (!whole) break;  // stopped by the caller or the clock

    const double after = run_.report.history.back().energy;
    if (!std::isfinite(after)) {
      if (++infinite_sweeps_ > kInfinitePatience && !halve_weights()) break;
      before = total();
      continue;
    }
    if (softener.settled() && converged(before, after)) {
      run_.report.stopped = Stopped::converged;
      break;
    }
    if (softener.settled() && may_give_up && stagnates()) break;
    const bool changed = softener.advance(mesh_, (before - after) / std::abs(after), settings_.model);
    before = changed ? total() : after;
  }
  return_best();
}

/// One Gauss-Seidel sweep. False when it was cut short.
bool Driver::improve_all_vertices(int sweep) {
  step_.begin_sweep(sweep);
  const double n = static_cast<double>(mesh_.n_vertices());
  for (const VertexId v : mesh_.vertices()) {
    if (v.index % kVerticesBetweenCalls == 0 && run_.asked_to_stop(static_cast<double>(v.index) / n)) return false;
    step_.improve(v);
  }
  return true;
}

/// Weights that leave edges uncrossed and that single vertices cannot mend: half of all of them, until zero weights at
/// last, where every barrier on d is satisfied. False when weights or connectivity may not change.
bool Driver::halve_weights() {
  const OptimizeOptions& o = settings_.options;
  if (o.unknowns == Unknowns::positions || !o.flips) return false;
  if (!shrunk_) run_.report.notes.push_back("weights of the input leave edges uncrossed: all were made smaller");
  shrunk_ = true;
  const Mesh before = mesh_;
  for (const VertexId v : mesh_.vertices()) mesh_.set_weight(v, 0.5 * mesh_.weight(v));
  const Restoration restored = restore_regularity(mesh_);
  run_.report.flips += restored.flips;
  if (!restored.regular()) mesh_ = before;
  return restored.regular();
}

/// Line 17 of Algorithm 1. Equal shifts of all weights change no energy and, but for their rounding, no edge.
void Driver::shift_weights_to_anchor() {
  if (!settings_.options.anchor) return;
  const double shift = mesh_.weight(VertexId(*settings_.options.anchor));
  for (const VertexId v : mesh_.vertices()) mesh_.set_weight(v, mesh_.weight(v) - shift);
  if (settings_.options.flips) run_.report.flips += restore_regularity(mesh_).flips;
}

/// Line 20 of Algorithm 1, at the end of each sweep.
std::size_t Driver::restore_deferred_flips() {
  if (!settings_.options.flips || settings_.options.flip_timing == FlipTiming::immediate) return 0;
  return restore_regularity(mesh_).flips;
}

bool Driver::converged(double before, double after) const {
  const double fall = before - after;
  if (settings_.options.stopping == StoppingRule::paper) {
    return fall < settings_.options.tolerance * static_cast<double>(mesh_.n_triangles());
  }
  return fall <= settings_.options.tolerance * std::abs(after);
}

bool Driver::stagnates() {
  const std::size_t bad = run_.report.history.back().bad;
  sweeps_since_fewer_bad_ = bad < least_bad_ ? 0 : sweeps_since_fewer_bad_ + 1;
  least_bad_ = std::min(least_bad_, bad);
  return bad > 0 && sweeps_since_fewer_bad_ >= kPatience;
}

/// HOT energies need not fall at every flip: the best sweep is kept. A barrier's does, once γ has settled.
void Driver::keep_if_best() {
  const double energy = run_.report.history.back().energy;
  if (settings_.energy.barrier || !(energy < best_energy_)) return;
  best_ = mesh_;
  best_energy_ = energy;
}

void Driver::return_best() {
  if (!best_ || !(best_energy_ < run_.report.history.back().energy)) return;
  mesh_ = *std::move(best_);
  run_.report.notes.push_back("the energy rose in the last sweeps; the mesh with the least one is returned");
}

double Driver::total() const { return energy_unit_ * total_energy(mesh_, settings_.model, settings_.options.executor); }

void Driver::record(std::size_t flips) {
  SweepRecord r;
  r.sweep = run_.report.sweeps;
  r.energy = total();
  r.bad = count_bad(mesh_, settings_.options.executor);
  r.flips = flips;
  r.softening = settings_.energy.softened_by_h0 ? settings_.model.h0.value : settings_.model.gamma.value;
  r.seconds = run_.seconds();
  run_.report.flips += flips;
  run_.report.history.push_back(r);
}

bool Run::asked_to_stop(double fraction_of_sweep) {
  if (options_.time_limit > 0 && seconds() > options_.time_limit) {
    report.stopped = Stopped::time_limit;
    return true;
  }
  if (observer_ && observer_({report.history.back(), fraction_of_sweep, options_.max_sweeps}) == Continue::no) {
    report.stopped = Stopped::cancelled;
    return true;
  }
  return false;
}

std::size_t count_bad(const Mesh& mesh, Executor* executor) {
  return static_cast<std::size_t>(blockwise_sum(mesh.n_triangles(), executor, [&](std::size_t i) {
    const auto [p, q, r] = mesh.corners(TriangleId(i));
    return inlined::is_well_centered(mesh.point(p), mesh.point(q), mesh.point(r)) ? 0.0 : 1.0;
  }));
}

}  // namespace temper
