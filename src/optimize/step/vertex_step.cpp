#include "optimize/step/vertex_step.hpp"

#include <algorithm>
#include <cmath>

#include "base/assert.hpp"
#include "mesh/edge_lengths.hpp"
#include "optimize/step/descent.hpp"
#include "optimize/step/search.hpp"
#include "regularity/flip_threshold.hpp"
#include "regularity/lawson.hpp"
#include "temper/regularity.hpp"

namespace temper {
namespace {

// If a flip does not pay, a step ends at this part of the way to it.
constexpr double kBeforeFlip = 0.99;
// A threshold below this part of the step is a tie: a step that ends before it would not move.
constexpr double kTie = 1e-6;
// A threshold that is met exactly is a tie, which rounding decides.
constexpr double kOvershootLeast = 1e-6;

/// The weights of p at which the dual crosses the edge to q inside: 0 < d < ℓ.
struct WeightRange {
  double low, high;
};
WeightRange weights_that_cross(const Space& space, const WeightedPoint& p, const WeightedPoint& q) {
  if (space.is_plane()) {
    const double l2 = squared_length(q.position() - p.position());
    return {q.w - l2, q.w + l2};
  }
  // With p̂ the direction of p: |P| > p̂·Q, and |P| p̂·Q < |Q|².
  const double along_q = dot(as_vector(p), as_vector(q)) / length(as_vector(p)), r2 = space.radius() * space.radius();
  const double highest = squared_length(as_vector(q)) / along_q;
  return {along_q * along_q - r2, highest * highest - r2};
}

}  // namespace

void VertexStep::begin_sweep(int sweep, Unknowns unknowns) {
  const Policy& policy = settings.policy;
  unknowns_ = unknowns;
  has_moved_ = false;
  collapses_ = policy.collapse_from && sweep >= *policy.collapse_from;
  removes_ = policy.removal != Removal::none && sweep >= policy.removal_from;
  const double excess = (policy.overshoot - 1) * std::pow(policy.overshoot_factor, sweep);
  overshoot_ = 1 + (policy.overshoot >= 1 ? std::max(kOvershootLeast, excess) : std::min(-kOvershootLeast, excess));
}

/// Lines 10 to 16 of Algorithm 1.
bool VertexStep::improve(VertexId v, const Part& part) {
  if (!is_confined(mesh, v, part)) return false;
  part_ = part;
  escapes_ = false;
  const bool may_go = limits.mobility[v] == Mobility::free;
  if (collapses_ && may_go && removal_.collapse(v)) return true;
  optimize_point(v);
  if (removes_ && may_go && !escapes_ && !mesh.is_isolated(v)) {
    gather(v);
    removal_.remove_if_better(v, star_->patch());
  }
  TEMPER_ASSERT_SLOW(escapes_ || mesh.is_isolated(v) || is_confined(mesh, v, part));
  return !escapes_;
}

bool VertexStep::suits_batches() const {
  const bool only_steps = !collapses_ && !removes_ && !limits.band.on();
  return only_steps && (star_->keeps_edges_regular || makes_newton_steps());
}

/// Says whether Newton steps lower a barrier, with no limit on flips.
bool VertexStep::makes_newton_steps() const {
  return state.energy.barrier && settings.policy.makes_newton_steps() && state.flip_limit == FlipLimit::unlimited;
}

/// Lines 13 and 14 of Algorithm 1.
void VertexStep::optimize_point(VertexId v) {
  waiting_.reset();
  if (gather(v)) make_steps();
  if (!waiting_) return;
  waiting_->to = mesh.point(v);
  mesh.set_point(v, waiting_->from);
  deferred_.push_back(*waiting_);
}

void VertexStep::make_steps() {
  const Solver solver = settings.policy.solver;
  const Dofs all = freedom_in(unknowns_);
  if (all.n == 0) return;
  if (solver == Solver::newton) return newton_search(all);
  const bool golden = solver == Solver::golden;
  const auto search = [&](const Dofs& of) { golden ? golden_search(of) : newton_search(of); };
  const Dofs positions = freedom_in(Unknowns::positions);
  for (int i = 0; i < (golden ? kPositionSearches : 1) && all.moves(); ++i) {
    search(positions);
    if (escapes_ || mesh.is_isolated(vertex_)) return;  // isolated: hidden, and removed
    gather(vertex_);
  }
  if (all.weighs()) search(freedom_in(Unknowns::weights));
}

/// Takes the star of v as it is now. Returns false if v must stay.
bool VertexStep::gather(VertexId v) {
  vertex_ = v;
  origin_ = mesh.point(v);
  edge_ = limits.divided_edge(v);
  guard_.begin_step();
  return star_->gather(v);
}

/// A barrier is +∞ if some |Δw| ≥ ℓ², from weights of the input or an unpriced flip. If some weight satisfies all
/// spokes, v takes the nearest such weight; the rest of the patch is left to the neighbors. Returns true if the patch
/// is finite then.
bool VertexStep::enter_domain() {
  if (unknowns_ == Unknowns::positions || star_->keeps_edges_regular) return false;
  const Patch& patch = star_->patch();
  double low = -kInfinity, high = kInfinity;
  for (std::size_t i = 0; i < patch.link.size(); ++i) {
    const WeightRange crossed = weights_that_cross(patch.space, origin_, patch.q(i));
    low = std::max(low, crossed.low);
    high = std::min(high, crossed.high);
  }
  if (!(low < high)) return false;
  constexpr double kInside = 0.1;  // of the interval, so that the barrier is not at its steepest
  const double w = std::clamp(patch.space.weight(origin_), low + kInside * (high - low), high - kInside * (high - low));
  const WeightedPoint p = patch.space.with_weight(origin_, w);
  if (!place(p, star_->value(p), false) || mesh.is_isolated(vertex_)) return false;
  gather(vertex_);
  return std::isfinite(star_->value(origin_));
}

/// Returns the part of the step that a search may use.
double VertexStep::farthest(const Step& step) const {
  return settings.policy.refuses_inversion() ? inversion_limit(star_->patch(), origin_, step) : 1;
}

/// Returns t, cut to what the flip limit allows along `step`.
double VertexStep::flip_limited(const Step& step, double t) const {
  if (state.flip_limit == FlipLimit::unlimited) return t;
  const bool after = state.flip_limit == FlipLimit::after;
  const double factor = after ? overshoot_ : state.flip_limit == FlipLimit::before ? kBeforeFlip : 1;
  return std::min(t, factor * flip_threshold_up_to(mesh, vertex_, step, 2 * t / factor));  // 2: for the rounding
}

WeightedPoint VertexStep::moved(const Step& step, double t) const {
  const WeightedPoint p = along(mesh.space(), origin_, step, t);
  if (!mesh.space().is_plane()) return p;
  if (step[0] == 0 && step[1] == 0) return {origin_.x, origin_.y, p.w};  // bit for bit: −0 + 0 is +0
  const Vec2 x = edge_ != nullptr ? edge_->nearest(p.position(), units) : units.snap(p.position());
  return {x.x, x.y, p.w};
}

/// Returns a t before the flip, if that does not pay or hides a vertex. At a tie, one small step may still pay.
double VertexStep::short_of_flip(const Step& step, double t) const {
  const double threshold = flip_threshold(mesh, vertex_, step);
  if (threshold >= t) return 0;  // only rounding stands between the two
  return threshold > kTie * t ? kBeforeFlip * threshold : 1e-3 * t;
}

/// Makes one Newton step: over-relaxed, then plain, then halved until the energy falls. If the size band blocks the
/// position, only the weight changes.
void VertexStep::newton_search(const Dofs& of) {
  VertexDerivatives d = star_->derivatives(origin_);
  energy_ = d.value;
  if (!d.feasible) {
    if (!enter_domain()) return;
    d = star_->derivatives(origin_);
  }
  energy_ = d.value;
  NewtonStep newton = newton_step(d, of, star_->radius(origin_));
  if (!(newton.predicted > kNoGain * std::abs(energy_))) return;
  const double relaxation = state.relaxation;
  for (double& s : newton.step) s *= relaxation;
  bool leaves_band = false;
  const auto attempt = [&](double& t, double shorter, bool) {
    const StepResult result = try_step(newton.step, t);
    const bool blocked = result == StepResult::blocked_by_flip;
    const bool done = result == StepResult::accepted || result == StepResult::escaped;
    t = blocked ? short_of_flip(newton.step, t) : shorter * t;
    const bool goes_on = !done && t > 0;
    leaves_band = goes_on && (leaves_band || result == StepResult::out_of_band);
    return goes_on;
  };
  damped_search(relaxation, star_->trials, flip_limited(newton.step, farthest(newton.step)), true, attempt);
  if (leaves_band && of.weighs()) newton_search(freedom_in(Unknowns::weights));
}

/// The paper's Algorithm 5: a finite-difference gradient, then golden section downhill within the patch radius.
void VertexStep::golden_search(const Dofs& dofs) {
  energy_ = star_->value(origin_);
  if (!std::isfinite(energy_)) {
    if (!enter_domain()) return;
    energy_ = star_->value(origin_);
  }
  const Patch& patch = star_->patch();
  const Policy& o = settings.policy;
  const double r = patch_radius(patch, origin_, o.search_radius);
  const double reach = dofs.moves() ? r : o.weight_search_radius * (r * r);
  const auto direction = steepest_descent(patch, state.model, origin_, dofs, reach);
  if (!direction) return;
  const double limit = flip_limited(*direction, farthest(*direction));
  if (!(limit > 0)) return;
  double t = line_minimum(patch, state.model, origin_, *direction, limit);
  StepResult result = try_step(*direction, t);
  for (int trial = 1; result == StepResult::out_of_band && trial < kTrials; ++trial) {
    t *= 0.5;
    result = try_step(*direction, t);
  }
  if (result == StepResult::blocked_by_flip) {
    const double threshold = flip_threshold(mesh, vertex_, *direction);
    if (threshold < t) try_step(*direction, kBeforeFlip * threshold);
  }
}

VertexStep::StepResult VertexStep::try_step(const Step& step, double t) {
  const WeightedPoint p = moved(step, t);
  const double energy = star_->value(p);
  if (!(energy < energy_)) return StepResult::not_lower;
  if (!settings.policy.allows_inversion() && !star_->is_valid(p)) return StepResult::inverted;
  if (!keeps_size(p)) return StepResult::out_of_band;
  if (place(p, energy, state.energy.barrier)) return StepResult::accepted;
  return escapes_ ? StepResult::escaped : StepResult::blocked_by_flip;
}

/// Puts the vertex at p, where its patch has the given energy, and makes the flips that this needs. Returns false and
/// leaves all as it was if a vertex would be hidden or flips leave the part. If the step must pay, it also fails when
/// flips cost more than it gains.
bool VertexStep::place(const WeightedPoint& p, double energy, bool must_pay) {
  const bool only_weight = mesh.space().same_place(p, origin_);
  if (only_weight ? settings.policy.defers_weights() : settings.policy.defers_positions()) {
    if (!waiting_) waiting_ = Deferred{vertex_, origin_, origin_, energy_, energy};
    waiting_->after = energy;
    mesh.set_point(vertex_, p);
    return true;
  }
  const bool may_break_edges = keeps_connectivity() && !star_->keeps_edges_regular;
  if (may_break_edges) note_regular_edges();
  mesh.set_point(vertex_, p);
  if (!keeps_connectivity() && settings.policy.flips_at_once()) {
    SizeBand* const band = limits.band.on() ? &limits.band : nullptr;
    Guard* const guard = guard_.on() ? &guard_ : nullptr;
    if (!only_weight) guard_.moved(vertex_);
    const auto settled = flipper_.settle({vertex_, origin_, energy_, energy, must_pay, band, guard, part_});
    escapes_ = settled == Flipper::Settled::escaped;
    const bool done = settled == Flipper::Settled::done;
    if (done && !only_weight) limits.band.moved(vertex_);
    if (!done && !only_weight) guard_.moved(vertex_);
    has_moved_ = has_moved_ || done;
    return done;
  }
  const bool fits = !may_break_edges ||
                    std::all_of(regular_.begin(), regular_.end(), [this](HalfedgeId e) { return is_regular(mesh, e); });
  if (fits && !only_weight) {
    limits.band.moved(vertex_);
    guard_.moved(vertex_);
  }
  has_moved_ = has_moved_ || fits;
  if (fits) {
    recorder.placed(vertex_, origin_, p, energy_, energy);
  } else {
    mesh.set_point(vertex_, origin_);
  }
  return fits;
}

/// Says whether band and guard allow p. Call it before place(), which gives them the new place of the vertex.
bool VertexStep::keeps_size(const WeightedPoint& p) {
  const bool only_weight = mesh.space().same_place(p, origin_);
  if (only_weight) return true;
  return (!limits.band.on() || limits.band.allows(star_->patch(), p.position())) &&
         (!guard_.on() || guard_.allows_move(vertex_, p));
}

/// Thresholds are computed in doubles, but an exact test decides whether an edge would flip.
bool VertexStep::keeps_connectivity() const {
  return settings.policy.keeps_connectivity() || state.flip_limit == FlipLimit::before;
}

void VertexStep::nudge(VertexId v, Vec2 by) {
  if (limits.mobility[v] != Mobility::free) return;
  part_ = {};
  gather(v);
  energy_ = star_->value(origin_);
  const WeightedPoint there = moved({by.x, by.y, 0}, 1);
  if (star_->is_valid(there) && keeps_size(there)) place(there, star_->value(there), false);
  if (!waiting_) return;
  recorder.placed(v, waiting_->from, mesh.point(v), waiting_->before, waiting_->after);  // v stays there
  waiting_.reset();
}

void VertexStep::shake(double amount, Rng& rng) {
  for (const VertexId v : mesh.vertices()) {
    const double shortest = std::sqrt(squared_shortest_edge(mesh, v));
    nudge(v, amount * shortest * Vec2{rng.uniform(-1, 1), rng.uniform(-1, 1)});
  }
}

/// If triangles must not turn over, a position is tested again when its neighbors have moved since the search.
void VertexStep::end_sweep() {
  for (const auto& [v, old, to, before, after] : deferred_) {
    if (mesh.is_isolated(v)) continue;
    const Space& space = mesh.space();
    const WeightedPoint from = mesh.point(v);
    const double w = space.weight(space.weight(to) != space.weight(old) ? to : from);
    WeightedPoint p = space.with_weight(space.same_place(to, old) ? from : to, w);
    if (!space.same_place(p, from) && !settings.policy.allows_inversion()) {
      gather(v);
      if (!star_->is_valid(p)) p = space.with_weight(from, w);
    }
    if (p == from) continue;
    mesh.set_point(v, p);
    recorder.placed(v, from, p, before, after);
  }
  deferred_.clear();
}

/// Notes the regular edges that may flip. If connectivity is kept, they must stay regular; others may wait.
void VertexStep::note_regular_edges() {
  regular_.clear();
  for (const HalfedgeId h : mesh.star(vertex_)) {
    for (const HalfedgeId e : {h, Mesh::next(h)}) {
      if (!mesh.is_constrained(e) && is_regular(mesh, e)) regular_.push_back(e);
    }
  }
}

}  // namespace temper
