#include "optimize/driver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/rng.hpp"
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
constexpr double kUnknownEnergy = std::numeric_limits<double>::quiet_NaN();  // of changes to all vertices at once

}  // namespace

Driver::Driver(WorkingCopy& work, Settings& settings, Run& run)
    : work_(work),
      mesh_(work.mesh),
      settings_(settings),
      energy_unit_(std::pow(work.frame.scale, settings.energy.length_exponent)),
      run_(run),
      recorder_(settings.options.tracer, work, energy_unit_),
      flipper_(mesh_, settings, recorder_),
      step_(mesh_, settings, work.frame, flipper_, recorder_) {
  recorder_.begin_sweep(run.report.sweeps == 0 ? 0 : run.report.sweeps + 1);
  const SweepOrder order = settings.options.order;
  if (order != SweepOrder::reverse && order != SweepOrder::random) return;
  for (const VertexId v : mesh_.vertices()) sequence_.push_back(v);
  if (order == SweepOrder::reverse) {
    std::reverse(sequence_.begin(), sequence_.end());
  } else {
    Rng rng(settings.options.seed);
    for (std::size_t i = sequence_.size(); i > 1; --i) {
      std::swap(sequence_[i - 1], sequence_[rng.below(static_cast<std::uint32_t>(i))]);
    }
  }
}

/// Algorithm 1.
void Driver::optimize(const Attempt& attempt, bool may_give_up) {
  const OptimizeOptions& o = settings_.options;
  Softener softener(attempt, settings_.energy, o);
  softener.start(mesh_, settings_.model);
  if (run_.report.history.empty()) record();
  least_bad_ = mesh_.n_triangles();
  before_ = best_energy_ = total();
  final_sweep_ = best_sweep_ = run_.report.sweeps;
  run_.report.stopped = Stopped::max_sweeps;
  show(Snapshot::Moment::start, 0);

  Verdict verdict = Verdict::improving;
  int i = 0;
  for (int outer = 0; verdict != Verdict::stopped && run_.sweeps_left(); ++outer) {  // outer iterations
    int inner = 0;
    do {
      verdict = sweep(i++, softener, may_give_up);
    } while (verdict == Verdict::improving && run_.sweeps_left() && (!defers_flips() || ++inner != o.inner));
    if (!defers_flips()) break;
    show(Snapshot::Moment::before_flips, outer);
    const std::size_t flips = run_.report.flips;
    if (!restore_regularity()) break;
    show(Snapshot::Moment::after_flips, outer);
    keep_if_best();
    if (verdict == Verdict::settled && run_.report.flips == flips) break;  // until no flips were needed
    if (verdict != Verdict::stopped) run_.report.stopped = Stopped::max_sweeps;
    if (outer + 1 == o.outer) {
      run_.report.stopped = Stopped::max_outer;
      break;
    }
  }
  return_best();
}

/// Lines 9 to 18 of Algorithm 1, for iteration i, and whether there should be another.
Driver::Verdict Driver::sweep(int i, Softener& softener, bool may_give_up) {
  recorder_.begin_sweep(run_.report.sweeps + 1);
  const bool whole = improve_all_vertices(i);
  step_.end_sweep();
  if (!defers_flips() && settings_.options.weight_updates == WeightUpdates::deferred) flipper_.restore_all();
  const bool removed = flipper_.has_removed();
  if (removed) compact();
  shift_weights_to_anchor();
  ++run_.report.sweeps;
  record();
  if (!defers_flips()) keep_if_best();
  show(Snapshot::Moment::after_sweep, 0);
  if (!whole) return Verdict::stopped;  // by the caller or the clock

  const double after = run_.report.history.back().energy;
  if (!std::isfinite(after)) {
    if (++infinite_sweeps_ > kInfinitePatience && !halve_weights()) return Verdict::stopped;
    before_ = total();
    return Verdict::improving;
  }
  if (softener.settled() && !removed && converged(before_, after)) {
    run_.report.stopped = Stopped::converged;
    return Verdict::settled;
  }
  if (softener.settled() && may_give_up && stagnates()) return Verdict::stopped;
  const bool changed = softener.advance(mesh_, (before_ - after) / std::abs(after), settings_.model);
  before_ = changed ? total() : after;
  return Verdict::improving;
}

/// One Gauss-Seidel sweep. False when it was cut short.
bool Driver::improve_all_vertices(int i) {
  step_.begin_sweep(i);
  const std::size_t n = mesh_.n_vertices();
  for (std::size_t k = 0; k < n; ++k) {
    const double done = static_cast<double>(k) / static_cast<double>(n);
    if (k % kVerticesBetweenCalls == 0 && run_.asked_to_stop(done)) return false;
    const VertexId v = sequence_.empty() ? VertexId(k) : sequence_[k];
    if (!mesh_.is_isolated(v)) step_.improve(v);
  }
  return true;
}

/// Drops what the sweep has removed, everywhere.
void Driver::compact() {
  const std::size_t n = mesh_.n_vertices();
  const Compaction kept = work_.compact();
  step_.renumber(kept);
  if (sequence_.empty()) return;
  IdVector<VertexId, VertexId> new_id(n);
  for (const VertexId v : mesh_.vertices()) new_id[kept.vertices[v]] = v;
  for (VertexId& v : sequence_) v = new_id[v];
  std::erase_if(sequence_, [](VertexId v) { return !v.valid(); });
}

/// Weights that leave edges uncrossed and that single vertices cannot mend: half of all of them, until zero weights at
/// last, where every barrier on d is satisfied. False when weights or connectivity may not change.
bool Driver::halve_weights() {
  const OptimizeOptions& o = settings_.options;
  if (o.unknowns == Unknowns::positions || !o.flips) return false;
  if (!shrunk_) run_.report.notes.push_back("weights of the input leave edges uncrossed: all were made smaller");
  shrunk_ = true;
  recorder_.begin_sweep(run_.report.sweeps + 1);
  for (const VertexId v : mesh_.vertices()) set_weight(v, 0.5 * mesh_.weight(v));
  return restore_regularity();
}

/// Line 17 of Algorithm 1. Equal shifts of all weights change no energy and, but for their rounding, no edge.
void Driver::shift_weights_to_anchor() {
  if (!settings_.options.anchor) return;
  const auto anchor =
      std::find(work_.order.vertices.begin(), work_.order.vertices.end(), VertexId(*settings_.options.anchor));
  if (anchor == work_.order.vertices.end()) return;  // removed: any other constant would do as well
  const double shift = mesh_.weight(VertexId(static_cast<std::size_t>(anchor - work_.order.vertices.begin())));
  for (const VertexId v : mesh_.vertices()) set_weight(v, mesh_.weight(v) - shift);
  if (settings_.options.flips && !defers_flips()) flipper_.restore_all();
}

void Driver::set_weight(VertexId v, double w) {
  const WeightedPoint from = mesh_.point(v);
  mesh_.set_weight(v, w);
  if (w != from.w) recorder_.placed(v, from, mesh_.point(v), kUnknownEnergy, kUnknownEnergy);
}

/// Line 20 of Algorithm 1. False when no flips can: among inverted triangles, or around a hidden vertex that may not
/// be.
bool Driver::restore_regularity() {
  if (settings_.options.inversion == Inversion::allow && count_inverted(mesh_) > 0) {
    run_.report.stopped = Stopped::tangled;
    return false;
  }
  if (!flipper_.restore_all()) {
    run_.report.stopped = Stopped::hidden;
    return false;
  }
  if (flipper_.has_removed()) compact();
  amend_record();
  before_ = run_.report.history.back().energy;
  return true;
}

bool Driver::make_regular() {
  if (!flipper_.restore_all()) return false;
  if (flipper_.has_removed()) compact();
  const Flipper::Changes changes = flipper_.take_changes();
  run_.report.flips += changes.flips;
  run_.report.vertices_removed += changes.removed;
  return true;
}

void Driver::jitter(double amount) {
  const OptimizeOptions& o = settings_.options;
  if (amount == 0 || o.unknowns == Unknowns::weights || !o.flips) return;
  recorder_.begin_sweep(run_.report.sweeps + 1);
  const auto mobility = mobilities(mesh_, o.interfaces);
  Rng rng(o.seed);
  for (const VertexId v : mesh_.vertices()) {
    const WeightedPoint p = mesh_.point(v);
    double shortest2 = kInfinity;
    for (const HalfedgeId h : mesh_.star(v)) {
      shortest2 = std::min(shortest2, squared_length(mesh_.position(mesh_.target(h)) - p.position()));
    }
    const Vec2 away = amount * std::sqrt(shortest2) * Vec2{rng.uniform(-1, 1), rng.uniform(-1, 1)};
    if (mobility[v] == Mobility::free) step_.nudge(v, work_.frame.snap(p.position() + away));
  }
}

bool Driver::defers_flips() const {
  return settings_.options.flips && settings_.options.flip_timing == FlipTiming::deferred;
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
  final_sweep_ = run_.report.sweeps;
  if (settings_.energy.barrier || !(energy < best_energy_)) return;
  if (settings_.options.inversion == Inversion::allow && count_inverted(mesh_) > 0) return;
  best_ = work_;
  best_energy_ = energy;
  best_sweep_ = run_.report.sweeps;
}

void Driver::return_best() {
  if (!best_ || !(best_energy_ < run_.report.history.back().energy)) return;
  work_ = *std::move(best_);
  final_sweep_ = best_sweep_;
  recorder_.returned_to(best_sweep_);
  run_.report.notes.push_back("the energy rose in the last sweeps; the mesh with the least one is returned");
}

double Driver::total() const { return energy_unit_ * total_energy(mesh_, settings_.model, settings_.options.executor); }

void Driver::record() {
  SweepRecord r;
  r.sweep = run_.report.sweeps;
  run_.report.history.push_back(r);
  amend_record();
}

/// The last record, brought up to date.
void Driver::amend_record() {
  SweepRecord& r = run_.report.history.back();
  const Flipper::Changes changes = flipper_.take_changes();
  r.energy = total();
  r.softening = settings_.energy.softened_by_h0 ? settings_.model.h0.value : settings_.model.gamma.value;
  r.bad = count_bad(mesh_, settings_.options.executor);
  r.flips += changes.flips;
  r.seconds = run_.seconds();
  run_.report.flips += changes.flips;
  run_.report.vertices_removed += changes.removed;
}

void Driver::show(Snapshot::Moment moment, int outer) const {
  if (!settings_.options.watch) return;
  const Mesh mesh = work_.in_user_terms();
  const auto vertices = work_.user_vertices();
  settings_.options.watch({moment, run_.report.sweeps, outer, total(), mesh, vertices});
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

std::size_t count_inverted(const Mesh& mesh) {
  std::size_t count = 0;
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    if (inlined::orient2d(mesh.position(a), mesh.position(b), mesh.position(c)) != Sign::positive) ++count;
  }
  return count;
}

}  // namespace temper
