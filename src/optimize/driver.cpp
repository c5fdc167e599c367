#include "optimize/driver.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/rng.hpp"
#include "base/text.hpp"
#include "optimize/repair/grading.hpp"
#include "optimize/repair/repair_search.hpp"
#include "temper/regularity.hpp"

namespace temper {
namespace {

// Sweeps at the last γ without fewer bad triangles, after which another attempt promises more; and without a lower
// energy, after which none will come.
constexpr int kPatience = 25;
// Sweeps in which vertices may bring a barrier's infinite energy down one by one, before all weights shrink.
constexpr int kInfinitePatience = 5;
// A sweep that still lowers the energy by this part of itself finds its way among flips and minima: passes wait.
constexpr double kSlowFall = 0.01;

}  // namespace

Driver::Driver(WorkingCopy& work, Settings& settings, Run& run, std::size_t part_size)
    : work_(work),
      mesh_(work.mesh),
      settings_(settings),
      energy_unit_(std::pow(work.frame.scale, settings.energy.length_exponent)),
      run_(run),
      recorder_(settings.options.tracer, work, energy_unit_),
      flipper_(mesh_, settings, recorder_),
      sweeper_(mesh_, settings, work.frame, flipper_, recorder_, part_size) {
  recorder_.begin_sweep(run.next_sweep());
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
  begin(attempt);
  Verdict verdict = Verdict::improving;
  do {    // outer iterations
    do {  // inner iterations
      verdict = sweep(may_give_up);
    } while (verdict == Verdict::improving &&
             !(defers_flips(settings_.options) && ++inner_ == settings_.options.inner));
    verdict = flip_if_deferred(verdict);
  } while (verdict == Verdict::improving);
  return_best();
}

void Driver::begin(const Attempt& attempt) {
  softener_ = Softener(attempt, settings_.energy, settings_.options);
  softener_.start(mesh_, settings_.model);
  settings_.relaxation = settings_.options.relaxation.value_or(softener_.relaxation());
  if (run_.report.history.empty()) record();
  least_bad_ = mesh_.n_triangles();
  before_ = best_energy_ = total();
  least_energy_ = fall_ = kInfinity;
  passes_pay_ = true;
  best_sweep_ = recorder_.sweep();
  run_.report.stopped = Stopped::max_sweeps;
  show(Snapshot::Moment::start);
}

/// Lines 9 to 18 of Algorithm 1.
Driver::Verdict Driver::sweep(bool may_give_up) {
  if (!run_.sweeps_left()) return Verdict::stopped;
  const bool passed = newton_passes_help();
  if (passed && !(newton_pass() && run_.sweeps_left())) return Verdict::stopped;
  const double halfway = run_.report.history.back().energy;
  recorder_.begin_sweep(run_.report.sweeps + 1);
  const bool whole = improve_all_vertices();
  const bool removed = flipper_.has_removed();
  if (removed) compact();
  shift_weights_to_anchor();
  ++iteration_;
  ++run_.report.sweeps;
  record();
  if (passed) passes_pay_ = before_ - halfway > halfway - run_.report.history.back().energy;
  if (!defers_flips(settings_.options)) keep_if_best();
  show(Snapshot::Moment::after_sweep);
  return whole ? judge_sweep(removed, may_give_up) : Verdict::stopped;  // by the caller or the clock
}

/// Line 19, and what a softened barrier or an infinite energy ask for besides.
Driver::Verdict Driver::judge_sweep(bool removed, bool may_give_up) {
  if (settings_.enough && settings_.enough(mesh_)) {
    run_.report.stopped = Stopped::converged;  // what comes next needs no more of this energy
    return Verdict::settled;
  }
  const double after = run_.report.history.back().energy;
  if (!std::isfinite(after)) {
    if (++infinite_sweeps_ > kInfinitePatience && !halve_weights()) return Verdict::stopped;
    before_ = total();
    return Verdict::improving;
  }
  if (softener_.settled() && !removed && converged(before_, after)) {
    if (!defers_flips(settings_.options) && begin_weights()) return Verdict::improving;
    run_.report.stopped = Stopped::converged;
    return Verdict::settled;
  }
  if (softener_.settled() && may_give_up && stagnates()) return Verdict::stopped;
  const std::size_t bad = run_.report.history.back().bad;
  const double fall = (before_ - after) / std::abs(after);
  if (softener_.settled()) fall_ = fall;
  const bool changed = softener_.advance(mesh_, fall, bad, settings_.model);
  settings_.relaxation = settings_.options.relaxation.value_or(softener_.relaxation());
  before_ = !changed ? after : softener_.compares_energies() ? total() : kInfinity;
  return Verdict::improving;
}

/// Lines 20 and 21: whether there is another outer iteration.
Driver::Verdict Driver::flip_if_deferred(Verdict of_sweeps) {
  if (!defers_flips(settings_.options)) return Verdict::stopped;
  show(Snapshot::Moment::before_flips);
  const std::size_t flips = run_.report.flips;
  if (!restore_regularity()) return Verdict::stopped;
  keep_if_best();
  show(Snapshot::Moment::after_flips);
  inner_ = 0;
  ++outer_;
  const bool needed = run_.report.flips > flips;
  if (of_sweeps == Verdict::stopped) return Verdict::stopped;
  if (of_sweeps == Verdict::settled && !needed && !begin_weights()) return Verdict::stopped;
  run_.report.stopped = outer_ == settings_.options.outer ? Stopped::max_outer : Stopped::max_sweeps;
  return outer_ == settings_.options.outer ? Verdict::stopped : Verdict::improving;
}

/// Newton's method for many vertices at once is for where nothing is bad and sweeps have become slow.
bool Driver::newton_passes_help() const {
  return passes_pay_ && fall_ < kSlowFall && run_.report.history.back().bad == 0 && allows_newton_passes(settings_);
}

/// A sweep of its own, that makes one step of the stopping rule with the sweep after it. False when it was cut short.
bool Driver::newton_pass() {
  recorder_.begin_sweep(run_.report.sweeps + 1);
  const bool whole = sweeper_.newton_pass(iteration_, run_);
  ++iteration_;
  ++run_.report.sweeps;
  record();
  show(Snapshot::Moment::after_sweep);
  return whole;
}

/// One Gauss-Seidel sweep, lines 9 to 16. False when it was cut short.
bool Driver::improve_all_vertices() {
  const bool whole = sweeper_.sweep(iteration_, sequence_, run_);
  const bool many_changed = settings_.options.weight_updates == WeightUpdates::deferred;
  if (many_changed && !defers_flips(settings_.options)) flipper_.restore_all();
  return whole;
}

/// Drops what the sweep has removed, everywhere.
void Driver::compact() {
  const std::size_t n = mesh_.n_vertices();
  const Compaction kept = work_.compact();
  sweeper_.renumber(kept);
  if (sequence_.empty()) return;
  IdVector<VertexId, VertexId> new_id(n);
  for (const VertexId v : mesh_.vertices()) new_id[kept.vertices[v]] = v;
  for (VertexId& v : sequence_) v = new_id[v];
  std::erase_if(sequence_, [](VertexId v) { return !v.valid(); });
}

/// Makes room for the vertices that have been inserted, everywhere.
void Driver::grow() {
  sweeper_.grow();
  if (sequence_.empty()) return;
  for (std::size_t i = sequence_.size(); i < mesh_.n_vertices(); ++i) sequence_.push_back(VertexId(i));
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
  const VertexId anchor = work_.from_user(VertexId(*settings_.options.anchor));
  if (!anchor.valid()) return;  // removed: any other constant would do as well
  const double shift = mesh_.weight(anchor);
  for (const VertexId v : mesh_.vertices()) set_weight(v, mesh_.weight(v) - shift);
  if (settings_.options.flips && !defers_flips(settings_.options)) flipper_.restore_all();
}

void Driver::set_weight(VertexId v, double w) {
  const WeightedPoint from = mesh_.point(v);
  mesh_.set_weight(v, w);
  if (w != from.w) recorder_.placed(v, from, mesh_.point(v), kNoEnergy, kNoEnergy);
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

void Driver::grade_boundary() {
  const OptimizeOptions& o = settings_.options;
  if (o.boundary_vertices != BoundaryVertices::split) return;
  const BoundaryCuts cuts = cut_boundary(work_, flipper_, o.boundary_ratio);
  grow();
  if (!run_.report.history.empty()) return;  // of the first attempt: others do the same again
  const auto rounded = [](double ratio) { return to_text(std::round(100 * ratio) / 100); };
  const auto vertices = [](std::size_t n) { return std::to_string(n) + (n == 1 ? " vertex" : " vertices"); };
  if (cuts.vertices > 0) {
    run_.report.notes.push_back(vertices(cuts.vertices) +
                                " inserted on the boundary and on lines: edges that meet there differed in "
                                "length by a factor of " +
                                rounded(cuts.ratio_before) + ", now " + rounded(cuts.ratio_after));
  }
  if (cuts.conflicts > 0) {
    run_.report.notes.push_back(std::to_string(cuts.conflicts) +
                                " of these split edges that left their dual no place to cross, or hardly one");
  }
  if (cuts.inside > 0) {
    run_.report.notes.push_back(vertices(cuts.inside) +
                                " inserted in triangles whose corners all were on the boundary or on lines");
  }
  if (cuts.refused > 0) {
    run_.report.notes.push_back(
        std::to_string(cuts.refused) +
        " cuts of the boundary were not made: coordinates are too coarse there, or weights would hide a vertex");
  }
}

bool Driver::repair(std::uint64_t seed) {
  RepairSearch search(work_, settings_, run_, flipper_, recorder_, seed);
  bool changed = false;
  while (run_.sweeps_left() && search.improve_one_place()) {
    grow();
    if (flipper_.has_removed()) compact();
    changed = true;
    ++run_.report.sweeps;
    record();
    show(Snapshot::Moment::after_sweep);
    recorder_.begin_sweep(run_.report.sweeps + 1);
  }
  final_sweep_ = run_.report.sweeps;
  return changed;
}

int Driver::polish(int sweep) {
  const WorkingCopy before = work_;
  const std::size_t bad = count_bad(mesh_, settings_.options.executor);
  optimize(kPolish, false);
  if (count_bad(mesh_, settings_.options.executor) <= bad) return final_sweep_;
  work_ = before;
  recorder_.returned_to(sweep);
  return sweep;
}

void Driver::jitter(double amount) {
  const OptimizeOptions& o = settings_.options;
  if (amount == 0 || o.unknowns == Unknowns::weights || !o.flips) return;
  recorder_.begin_sweep(run_.report.sweeps + 1);
  Rng rng(o.seed);
  sweeper_.shake(amount, rng);
}

/// The paper's rule takes a rise for convergence. The relative one waits whether the energy falls again.
bool Driver::converged(double before, double after) {
  const double tolerance = settings_.options.tolerance;
  if (settings_.options.stopping == StoppingRule::paper) {
    return before - after < tolerance * static_cast<double>(mesh_.n_triangles());
  }
  const double change = tolerance * std::abs(after);
  const bool lower = after < least_energy_ - change;
  sweeps_since_lower_ = lower ? 0 : sweeps_since_lower_ + 1;
  least_energy_ = std::min(least_energy_, after);
  return std::abs(before - after) <= change || sweeps_since_lower_ >= kPatience;
}

/// Positions have converged before i_w: the weights' turn has come.
bool Driver::begin_weights() {
  const OptimizeOptions& o = settings_.options;
  if (o.unknowns != Unknowns::positions_and_weights || iteration_ >= o.weights_from) return false;
  iteration_ = o.weights_from;
  fall_ = kInfinity;  // of another problem
  passes_pay_ = true;
  return true;
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
  if (settings_.options.inversion == Inversion::allow && count_inverted(mesh_) > 0) return;
  best_ = work_;
  best_energy_ = energy;
  best_sweep_ = recorder_.sweep();
}

void Driver::return_best() {
  final_sweep_ = recorder_.sweep();
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
  const auto [energy, bad] = energy_and_bad(mesh_, settings_.model, settings_.options.executor);
  r.energy = energy_unit_ * energy;
  r.softening = settings_.energy.softened_by_h0 ? settings_.model.h0.value : settings_.model.gamma.value;
  r.bad = bad;
  r.flips += changes.flips;
  r.seconds = run_.seconds();
  run_.report.flips += changes.flips;
  run_.report.vertices_removed += changes.removed;
  run_.report.vertices_inserted += changes.inserted;
}

void Driver::show(Snapshot::Moment moment) const {
  if (!settings_.options.watch) return;
  const Mesh mesh = work_.in_user_terms();
  const auto vertices = work_.user_vertices();
  settings_.options.watch({moment, run_.report.sweeps, outer_, total(), mesh, vertices});
}

}  // namespace temper
