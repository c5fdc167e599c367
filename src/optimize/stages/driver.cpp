#include "optimize/stages/driver.hpp"

#include <algorithm>
#include <utility>

#include "base/assert.hpp"
#include "base/rng.hpp"
#include "energy/whole_mesh.hpp"
#include "mesh/bad_triangles.hpp"
#include "optimize/coarsen/coarsening.hpp"
#include "optimize/flips/grading.hpp"
#include "optimize/repair/growing_search.hpp"
#include "optimize/repair/neighborhood.hpp"
#include "optimize/repair/repair_search.hpp"
#include "optimize/repair/trial.hpp"
#include "optimize/run/judge.hpp"
#include "optimize/stages/near_sweeps.hpp"
#include "optimize/step/ties.hpp"
#include "optimize/sweep/insertion.hpp"
#include "temper/regularity.hpp"
#include "topology/locate.hpp"

namespace temper {
Driver::Driver(WorkingCopy& work, const Settings& settings, SweepState& state, Run& run, std::size_t part_size)
    : work_(work),
      mesh_(work.mesh),
      settings_(settings),
      state_(state),
      run_(run),
      recorder_(settings.hooks.tracer, work, state.energy_unit(work.units)),
      flipper_(mesh_, settings, state, recorder_),
      sweeper_(work, flipper_, part_size) {
  recorder_.begin_sweep(run.next_sweep());
  const SweepOrder order = settings.policy.order;
  if (order == SweepOrder::hilbert) return;
  for (const VertexId v : mesh_.vertices()) sequence_.push_back(v);
  if (order == SweepOrder::reverse) {
    std::reverse(sequence_.begin(), sequence_.end());
  } else if (order == SweepOrder::random) {
    Rng rng(settings.policy.seed);
    for (std::size_t i = sequence_.size(); i > 1; --i) {
      std::swap(sequence_[i - 1], sequence_[rng.below(static_cast<std::uint32_t>(i))]);
    }
  }
}

/// Algorithm 1.
int Driver::run(Phase& phase, int first) {
  const int sweeps = run_.report.sweeps;
  begin(phase, first);
  Verdict verdict = Verdict::improving;
  std::optional<Stopped> asked;  // set if the caller stops the run, whatever later flips find
  do {                           // outer iterations
    do {                         // inner iterations
      verdict = sweep(phase);
    } while (verdict == Verdict::improving && !(settings_.policy.defers_flips() && ++inner_ == settings_.policy.inner));
    if (run_.stopped_early()) asked = run_.report.stopped;
    verdict = flip_if_deferred(phase, verdict);
  } while (verdict == Verdict::improving);
  const int last = run_.report.sweeps > sweeps ? recorder_.sweep() : first;
  const int kept = run_.report.stopped == Stopped::hidden ? return_regular(last) : return_best(phase, last);
  if (asked) run_.report.stopped = *asked;
  return kept;
}

void Driver::begin(Phase& phase, int sweep) {
  phase.begin();
  recorder_.set_energy_unit(state_.energy_unit(work_.units));
  if (run_.report.history.empty()) record(phase.measure());
  best_.measure = phase.total();
  if (phase.keeps() == Phase::Keeps::best_points) keep(phase, best_.measure, sweep);
  keep_regular(sweep);
  run_.report.stopped = Stopped::max_sweeps;
  run_.begin_sweeps();
  show(Snapshot::Moment::start, phase);
}

/// Makes lines 9 to 18 of Algorithm 1 and returns the phase's verdict.
Driver::Verdict Driver::sweep(Phase& phase) {
  if (!phase.may_sweep()) return Verdict::stopped;
  recorder_.begin_sweep(run_.report.sweeps + 1);
  const std::optional<bool> moved = phase.move_all(recorder_);
  const bool whole = moved ? *moved : improve_all_vertices(phase.iteration);
  const bool removed = flipper_.has_removed();
  compact();
  const bool inserted = whole && insert_vertices(phase.iteration);
  shift_weights_to_anchor();
  TEMPER_ASSERT_SLOW(!settings_.policy.keeps_regular() || count_non_regular_edges(mesh_, false) == 0);
  ++phase.iteration;
  ++run_.report.sweeps;
  record(phase.measure());
  if (!settings_.policy.defers_flips()) keep_if_best(phase);
  show(Snapshot::Moment::after_sweep, phase);
  run_.offer(work_, settings_, state_);
  if (!whole) return Verdict::stopped;  // the caller or the clock stopped it
  const Verdict verdict = phase.judge(removed || inserted);
  if (verdict == Verdict::restarted) {
    best_ = {{}, phase.total()};
    best_points_ = {};
    recorder_.set_energy_unit(state_.energy_unit(work_.units));
    return Verdict::improving;
  }
  if (verdict != Verdict::infinite) return verdict;
  if (!halve_weights()) return Verdict::stopped;
  amend_record(phase.measure());
  phase.compare_from_here();
  return Verdict::improving;
}

/// Makes lines 20 and 21, and says whether another outer iteration follows.
Driver::Verdict Driver::flip_if_deferred(Phase& phase, Verdict of_sweeps) {
  if (!settings_.policy.defers_flips()) return Verdict::stopped;
  show(Snapshot::Moment::before_flips, phase);
  const std::size_t flips = run_.report.flips;
  if (!restore_regularity()) return Verdict::stopped;
  amend_record(phase.measure());
  phase.compare_from_here();
  keep_if_best(phase);
  keep_regular(recorder_.sweep());
  show(Snapshot::Moment::after_flips, phase);
  inner_ = 0;
  ++outer_;
  const bool needed = run_.report.flips > flips;
  if (of_sweeps == Verdict::stopped) return Verdict::stopped;
  if (of_sweeps == Verdict::settled && !needed && !phase.goes_on_with_weights()) return Verdict::stopped;
  run_.report.stopped = outer_ == settings_.policy.outer ? Stopped::max_outer : Stopped::max_sweeps;
  return outer_ == settings_.policy.outer ? Verdict::stopped : Verdict::improving;
}

/// Makes one Gauss-Seidel sweep, lines 9 to 16. Returns false if it was stopped.
bool Driver::improve_all_vertices(int iteration) {
  if (!settings_.policy.defers_updates() || settings_.policy.defers_flips())
    return sweeper_.sweep(iteration, sequence_, run_);
  const IdVector<VertexId, WeightedPoint> before = points();
  const bool whole = sweeper_.sweep(iteration, sequence_, run_);
  settle_updates(before);
  return whole;
}

/// Deferred updates together may hide a vertex. Then weights get half of their changes, then a quarter, and so on. In
/// the end neither weights nor positions change.
void Driver::settle_updates(const IdVector<VertexId, WeightedPoint>& before) {
  constexpr int kHalvings = 6;  // smaller changes are not worth a step
  // With another policy, flips that need the new positions may have been made.
  const Space& space = mesh_.space();
  const bool moves_back = settings_.policy.defers_positions() && settings_.policy.undoes_hidden();
  for (int i = 0; !flipper_.restore_all() && i <= kHalvings; ++i) {
    for (const VertexId v : mesh_.vertices()) {
      if (mesh_.is_isolated(v)) continue;
      const WeightedPoint now = mesh_.point(v), old = before[v];
      const double old_w = space.weight(old), w = old_w + (i < kHalvings ? 0.5 : 0.0) * (space.weight(now) - old_w);
      const WeightedPoint& place = moves_back && i == kHalvings ? old : now;
      set_point(v, space.with_weight(place, w));
    }
  }
}

IdVector<VertexId, WeightedPoint> Driver::points() const {
  IdVector<VertexId, WeightedPoint> all(mesh_.n_vertices());
  for (const VertexId v : mesh_.vertices()) all[v] = mesh_.point(v);
  return all;
}

/// Returns true if there are new vertices. Among inverted triangles no point has a triangle of its own.
bool Driver::insert_vertices(int iteration) {
  const Policy& policy = settings_.policy;
  if (!policy.insertion_from || iteration < *policy.insertion_from) return false;
  if (policy.allows_inversion() && count_inverted(mesh_) > 0) return false;
  if (!insert_where_energy_is_large(work_, flipper_, settings_, state_.model)) return false;
  grow();
  return true;
}

/// Drops removed vertices and triangles everywhere. Returns nothing if there are none.
std::optional<Compaction> Driver::compact() {
  if (!flipper_.has_removed()) return std::nullopt;
  const std::size_t n = mesh_.n_vertices();
  Compaction kept = work_.compact();
  sweeper_.renumber(kept);
  if (sequence_.empty()) return kept;
  IdVector<VertexId, VertexId> new_id(n);
  for (const VertexId v : mesh_.vertices()) new_id[kept.vertices[v]] = v;
  for (VertexId& v : sequence_) v = new_id[v];
  std::erase_if(sequence_, [](VertexId v) { return !v.valid(); });
  return kept;
}

void Driver::grow() {
  sweeper_.grow();
  if (sequence_.empty()) return;
  for (std::size_t i = sequence_.size(); i < mesh_.n_vertices(); ++i) sequence_.emplace_back(i);
}

/// Halves all weights if they leave edges uncrossed and steps of single vertices cannot repair that. Repeated, it ends
/// at zero weights, which satisfy every barrier on d. Returns false if weights or connectivity must not change.
bool Driver::halve_weights() {
  if (settings_.options.unknowns == Unknowns::positions || settings_.policy.keeps_connectivity()) return false;
  run_.facts.weights_shrunk = true;
  recorder_.begin_sweep(run_.report.sweeps + 1);
  for (const VertexId v : mesh_.vertices()) set_weight(v, 0.5 * mesh_.weight(v));
  return restore_regularity();
}

/// Line 17 of Algorithm 1. Equal shifts of all weights change no energy and, except for rounding, no edge.
void Driver::shift_weights_to_anchor() {
  if (!settings_.policy.anchor.valid()) return;
  const VertexId anchor = work_.from_user(settings_.policy.anchor);
  if (!anchor.valid()) return;  // removed: the choice of the constant is free
  const double shift = mesh_.weight(anchor);
  const IdVector<VertexId, WeightedPoint> before = points();
  const Space& space = mesh_.space();
  for (const VertexId v : mesh_.vertices())
    set_point(v, space.with_weight(mesh_.point(v), space.weight(before[v]) - shift));
  if (settings_.policy.keeps_connectivity() || settings_.policy.defers_flips() || flipper_.restore_all()) return;
  // Rounding may hide a vertex that was nearly hidden. Then the shift is undone.
  for (const VertexId v : mesh_.vertices()) set_point(v, before[v]);
}

void Driver::set_point(VertexId v, const WeightedPoint& p) {
  const WeightedPoint from = mesh_.point(v);
  if (p == from) return;
  mesh_.set_point(v, p);
  recorder_.placed(v, from, p, kNoEnergy, kNoEnergy);
}

void Driver::set_weight(VertexId v, double w) {
  if (!mesh_.is_frozen(v)) set_point(v, mesh_.space().with_weight(mesh_.point(v), w));
}

/// Line 20 of Algorithm 1. Returns false if flips cannot restore it: with inverted triangles or a vertex hidden against
/// the policy.
bool Driver::restore_regularity() {
  if (settings_.policy.allows_inversion() && count_inverted(mesh_) > 0) {
    run_.report.stopped = Stopped::tangled;
    return false;
  }
  if (!flipper_.restore_all()) {
    run_.report.stopped = Stopped::hidden;
    return false;
  }
  compact();
  return true;
}

bool Driver::make_regular() {
  if (!flipper_.restore_all()) return false;
  compact();
  run_.count(flipper_.take_changes());
  return true;
}

void Driver::grade_boundary() {
  if (settings_.options.boundary != BoundaryVertices::split) return;
  TEMPER_ASSERT_SLOW(settings_.policy.keeps_hidden() || count_non_regular_edges(mesh_, false) == 0);
  const SplitCounts cuts = split_boundary(work_, flipper_, settings_.options.boundary_ratio, settings_.guard);
  grow();
  TEMPER_ASSERT_SLOW(settings_.policy.keeps_hidden() || count_non_regular_edges(mesh_, false) == 0);
  run_.facts.boundary_splits = cuts;  // the same in each restart
}

void Driver::split_where_bad() {
  run_.facts.splits_where_bad = temper::split_where_bad(work_, flipper_, settings_.guard);
  grow();
}

std::size_t Driver::refine_where_bad(double factor) {
  constexpr int kRingsAround = 2;
  constexpr double kGradation = 0.6;
  std::vector<Vec2> places;
  for (const TriangleId t : bad_triangles(mesh_)) {
    const auto [a, b, c] = mesh_.points(t);
    places.push_back((1.0 / 3) * (a.position() + b.position() + c.position()));
  }
  recorder_.begin_sweep(run_.next_sweep());
  for (const VertexId v : mesh_.vertices()) set_weight(v, 0);
  const std::size_t before = work_.n_vertices_named;
  if (!flipper_.restore_all()) return 0;
  const Edit edit = Refine{.sizes = {kGradation, factor}, .splits_lines = true, .sweeps = false};
  TriangleId near(0);
  for (const Vec2 p : places) {
    if (run_.asked_to_stop(0)) break;
    const Location at = locate(mesh_, p, near);
    if (!at.triangle.valid()) continue;
    near = at.triangle;
    const Neighborhood around = neighborhood_of(work_, near, kRingsAround);
    const TrialResult refined = try_edit(around, edit, settings_, work_.units, {.with_events = true});
    if (!refined.valid) continue;
    splice(work_, flipper_, around, refined.events);
    grow();
    flipper_.restore_all();
  }
  end_sweep_of_its_own();
  return work_.n_vertices_named - before;
}

void Driver::jitter(double amount) {
  if (amount == 0 || settings_.options.unknowns == Unknowns::weights || settings_.policy.keeps_connectivity()) return;
  recorder_.begin_sweep(run_.report.sweeps + 1);
  Rng rng(settings_.policy.seed);
  sweeper_.shake(amount, rng);
}

int Driver::restart(const Restart& restart, bool may_give_up) {
  if (reweight_ties(restart.tie_weight)) return polish(run_.report.sweeps);
  jitter(restart.jitter);
  const int first = run_.next_sweep();
  const bool may_return_there = restart.first_energy.has_value() || settings_.policy.defers_flips();
  // A trace names the sweep to which a run returns.
  if (first > 0 && may_return_there) end_sweep_of_its_own();
  EnergyPhase phase(work_, settings_, state_, run_, restart);
  if (may_give_up) phase.let_give_up();
  const int last = run(phase, first);
  phase.take_last_energy();
  return last;
}

bool Driver::reweight_ties(double amount) {
  if (amount == 0) return false;
  recorder_.begin_sweep(run_.next_sweep());
  std::vector<std::pair<VertexId, double>> before;
  for (const auto& [v, shortest2] : heavier_ends_of_ties(mesh_, settings_.options)) {
    before.emplace_back(v, mesh_.weight(v));
    set_weight(v, mesh_.weight(v) + amount * shortest2);
  }
  if (!make_regular()) {  // a vertex would be hidden
    for (const auto& [v, w] : before) set_weight(v, w);
  }
  end_sweep_of_its_own();
  return run_.report.history.back().bad == 0;
}

void Driver::end_sweep_of_its_own() {
  ++run_.report.sweeps;
  record(EnergyPhase(work_, settings_, state_, run_, kPolish).measure());
}

template <class Measure>
void Driver::end_round(const Phase& phase, const Measure& measure) {
  grow();
  const std::optional<Compaction> kept = compact();
  ++run_.report.sweeps;
  record(measure(kept));
  show(Snapshot::Moment::after_sweep, phase);
  run_.offer(work_, settings_, state_);
  recorder_.begin_sweep(run_.report.sweeps + 1);
}

bool Driver::repair(TrialMemo& memo, std::uint64_t seed, Pace pace, bool asks_programs) {
  EnergyPhase phase(work_, settings_, state_, run_, kPolish);  // puts repairs into the history
  RepairSearch search(work_, run_, flipper_, memo, seed, asks_programs, pace);
  bool changed = false;
  RunningEnergyAndBad totals;
  const std::optional<std::vector<TriangleId>> all;  // after a renumbering
  while (run_.sweeps_left() && search.improve_one_place()) {
    changed = true;
    end_round(phase, [&](const std::optional<Compaction>& kept) {
      if (kept) search.renumber(*kept);
      return phase.record_of(totals.measure(mesh_, state_.model, kept ? all : search.changed(), settings_.executor()));
    });
  }
  return changed;
}

int Driver::mend() {
  EnergyPhase phase(work_, settings_, state_, run_, kPolish);
  phase.begin();
  if (run_.report.history.empty()) record(phase.measure());
  run_.begin_sweeps();
  recorder_.begin_sweep(run_.report.sweeps + 1);
  if (run_.sweeps_left() && NearSweeps(work_, flipper_, state_, run_).run())
    end_round(phase, [&](const auto&) { return phase.measure(); });
  GrowingSearch search(work_, run_, flipper_, settings_.policy.seed);
  while (run_.sweeps_left() && search.improve()) end_round(phase, [&](const auto&) { return phase.measure(); });
  if (!run_.goes_on() && !run_.stopped_early()) run_.report.stopped = Stopped::max_sweeps;
  return run_.report.sweeps;
}

void Driver::coarsen(int moves_of_cure) {
  EnergyPhase phase(work_, settings_, state_, run_, kPolish);  // puts rounds into the history
  Coarsening search(work_, run_, flipper_, moves_of_cure);
  recorder_.begin_sweep(run_.report.sweeps + 1);
  for (bool goes_on = true; goes_on;) {  // rounds of moves, which `max_sweeps` does not limit
    run_.n_vertices = mesh_.n_vertices();
    goes_on = search.improve();
    end_round(phase, [&](const auto&) { return phase.measure(); });
  }
  run_.n_vertices.reset();
}

int Driver::polish(int sweep) {
  const WorkingCopy before = work_;
  const auto measure = [&] {
    const bool by_triangles = settings_.criterion == Criterion::well_centered;
    return std::pair(by_triangles ? 0 : count_violations(mesh_, settings_), count_bad(mesh_, settings_.executor()));
  };
  const auto bad = measure();
  EnergyPhase phase(work_, settings_, state_, run_, kPolish);
  const int last = run(phase, sweep);
  if (measure() <= bad) return last;
  work_ = before;
  recorder_.returned_to(sweep);
  return sweep;
}

/// HOT energies can rise at a flip, and the accuracy energy may rise a little at the end because of its barrier. After
/// γ has settled, barrier energies fall.
void Driver::keep_if_best(const Phase& phase) {
  const double energy = run_.report.history.back().energy;
  if (phase.keeps() == Phase::Keeps::last || !best_.is_beaten_by(energy)) return;
  if (settings_.policy.allows_inversion() && count_inverted(mesh_) > 0) return;
  keep(phase, energy, recorder_.sweep());
}

void Driver::keep(const Phase& phase, double energy, int sweep) {
  if (phase.keeps() == Phase::Keeps::best_points) {
    best_points_.resize(mesh_.n_vertices());  // in place: for the largest meshes memory has no room for a copy
    for (const VertexId v : mesh_.vertices()) best_points_[v] = mesh_.point(v);
  } else {
    best_.kept.reset();  // before the copy: for the largest meshes memory has no room for two
    best_.kept = Candidate{work_, sweep};
  }
  best_.measure = energy;
  best_sweep_ = sweep;
}

int Driver::return_best(const Phase& phase, int last_sweep) {
  const auto points = std::exchange(best_points_, {});  // frees them in any case
  const bool has_best = best_.kept || !points.empty();
  if (!has_best || !(best_.measure < run_.report.history.back().energy)) return last_sweep;
  if (best_.kept) {
    work_ = (*std::exchange(best_.kept, std::nullopt)).work;
  } else {
    for (const VertexId v : mesh_.vertices()) mesh_.set_point(v, points[v]);
  }
  recorder_.returned_to(best_sweep_);
  if (phase.keeps() == Phase::Keeps::best_sweep) run_.facts.energy_rose = true;
  return best_sweep_;
}

/// Deferred flips may find a hidden vertex. Then some edges cannot be made regular by flips.
void Driver::keep_regular(int sweep) {
  if (!settings_.policy.defers_flips() || settings_.policy.keeps_hidden()) return;
  regular_ = Candidate{work_, sweep};
}

/// Returns to the best mesh if one is kept, else to the last regular mesh.
int Driver::return_regular(int last_sweep) {
  std::optional<Candidate>& kept = best_.kept ? best_.kept : regular_;
  if (!kept) return last_sweep;
  const int sweep = kept->sweep;
  work_ = (*std::exchange(kept, std::nullopt)).work;
  recorder_.returned_to(sweep);
  return sweep;
}

void Driver::record(const SweepRecord& measured) {
  run_.record({});
  amend_record(measured);
}

void Driver::amend_record(const SweepRecord& measured) {
  SweepRecord& r = run_.report.history.back();
  const Flipper::Changes changes = flipper_.take_changes();
  r.energy = measured.energy;
  r.length_parameter = measured.length_parameter;
  r.bad = measured.bad;
  r.objective = measured.objective;
  r.flips += changes.flips;
  r.seconds = run_.seconds();
  run_.count(changes);
}

void Driver::show(Snapshot::Moment moment, const Phase& phase) const {
  if (!settings_.hooks.snapshots) return;
  const Mesh mesh = work_.in_user_terms();
  const auto vertices = work_.user_vertices();
  settings_.hooks.snapshots({moment, run_.report.sweeps, outer_, phase.total(), mesh, vertices});
}

}  // namespace temper
