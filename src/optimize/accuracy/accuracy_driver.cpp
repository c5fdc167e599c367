#include "optimize/accuracy/accuracy_driver.hpp"

#include <cmath>

namespace temper {

AccuracyDriver::AccuracyDriver(WorkingCopy& work, const Settings& settings, Run& run, const AccuracySizes& sizes,
                               std::size_t part_size)
    : work_(work),
      mesh_(work.mesh),
      settings_(settings),
      options_(settings.options.accuracy),
      run_(run),
      energy_unit_(work.frame.scale * work.frame.scale),
      recorder_(settings.options.tracer, work, energy_unit_),
      ground_{sizes.of(work, settings.options.executor), {}, {}},
      sweeper_(mesh_, settings, work.frame, ground_, recorder_, part_size),
      bad_(count_bad(mesh_, settings.options.executor)) {}

int AccuracyDriver::optimize(int sweep) {
  recorder_.begin_sweep(run_.next_sweep());
  shift_weights_to_anchor();
  ground_.floors.raise(mesh_, options_.margin, settings_.options.executor);
  now_ = total();
  if (run_.report.history.empty()) record(now_);
  keep_if_best(now_, sweep);
  show(Snapshot::Moment::start);
  sweep_until_it_is_enough();
  return_best();
  return best_.sweep;
}

void AccuracyDriver::sweep_until_it_is_enough() {
  run_.report.stopped = Stopped::accuracy_sweeps;
  for (int i = 0; i < options_.sweeps; ++i) {
    if (!run_.sweeps_left()) {
      run_.report.stopped = Stopped::max_sweeps;
      return;
    }
    recorder_.begin_sweep(run_.report.sweeps + 1);
    const bool whole = sweeper_.sweep(run_);
    ++run_.report.sweeps;
    const AccuracyTotal before = now_;
    now_ = total();
    record(now_);
    keep_if_best(now_, run_.report.sweeps);
    show(Snapshot::Moment::after_sweep);
    if (!whole) return;  // by the caller or the clock, which has said so
    const bool raised = ground_.floors.raise(mesh_, options_.margin, settings_.options.executor) > 0;
    if (!raised && converged(before, now_)) {
      run_.report.stopped = Stopped::converged;
      return;
    }
    if (raised) now_ = total();  // of another barrier
  }
}

bool AccuracyDriver::converged(const AccuracyTotal& before, const AccuracyTotal& after) const {
  const double change = (before.energy + before.barrier) - (after.energy + after.barrier);
  return std::abs(change) <= options_.tolerance * std::abs(after.energy);
}

/// Once: from then on the anchor's weight stays. Equal shifts of all weights change no energy but by rounding.
void AccuracyDriver::shift_weights_to_anchor() {
  if (!settings_.options.anchor) return;
  ground_.anchor = work_.from_user(VertexId(*settings_.options.anchor));
  if (!ground_.anchor.valid()) return;
  const double shift = mesh_.weight(ground_.anchor);
  if (shift == 0) return;
  for (const VertexId v : mesh_.vertices()) {
    const WeightedPoint from = mesh_.point(v);
    mesh_.set_weight(v, from.w - shift);
    recorder_.placed(v, from, mesh_.point(v), kNoEnergy, kNoEnergy);
  }
}

AccuracyTotal AccuracyDriver::total() const {
  return accuracy_total(mesh_, ground_.sizes, ground_.floors, settings_.accuracy, settings_.options.executor);
}

void AccuracyDriver::record(const AccuracyTotal& total) {
  SweepRecord r;
  r.sweep = run_.report.sweeps;
  r.energy = energy_unit_ * total.energy;
  r.bad = bad_;
  r.seconds = run_.seconds();
  r.objective = Objective::accuracy;
  run_.report.history.push_back(r);
}

/// The energy is lowered together with its barrier, for which it may rise a little in the end.
void AccuracyDriver::keep_if_best(const AccuracyTotal& total, int sweep) {
  if (!best_.points.empty() && !(total.energy < best_.energy)) return;
  best_.energy = total.energy;
  best_.points.resize(mesh_.n_vertices());
  for (const VertexId v : mesh_.vertices()) best_.points[v] = mesh_.point(v);
  best_.sweep = sweep;
}

void AccuracyDriver::return_best() {
  if (!(best_.energy < now_.energy)) return;
  for (const VertexId v : mesh_.vertices()) mesh_.set_point(v, best_.points[v]);
  recorder_.returned_to(best_.sweep);
}

void AccuracyDriver::show(Snapshot::Moment moment) const {
  if (!settings_.options.watch) return;
  const Mesh mesh = work_.in_user_terms();
  const auto vertices = work_.user_vertices();
  settings_.options.watch({moment, run_.report.sweeps, 0, energy_unit_ * now_.energy, mesh, vertices});
}

}  // namespace temper
