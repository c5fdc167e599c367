#include "optimize/step/vertex_step.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/predicates_inline.hpp"
#include "optimize/step/cavity.hpp"
#include "optimize/step/line_search.hpp"
#include "optimize/step/newton_constants.hpp"
#include "optimize/step/removal.hpp"
#include "regularity/power_tests.hpp"
#include "temper/regularity.hpp"

namespace temper {
namespace {

// Short of a flip by this factor when the flip does not pay.
constexpr double kBeforeFlip = 0.99;
// A threshold below this part of the step is a tie: stopping short of it would be standing still.
constexpr double kTie = 1e-6;
// The vertices of a smaller mesh are improved one by one: there is little to gain, and eight do not find each other.
constexpr std::size_t kLeastForBatches = 1000;
// HOT has no barrier: nothing may come nearer to a neighbour than this part of the patch radius.
constexpr double kShortestEdge = 1e-7;
constexpr double kOvershootShrink = 0.1, kOvershootLeast = 1e-6;

}  // namespace

void VertexStep::begin_sweep(int sweep) {
  const OptimizeOptions& o = settings_.options;
  unknowns_ = unknowns_of_sweep(o, sweep);
  collapses_ = o.collapse_from && sweep >= *o.collapse_from;
  removes_ = o.removal == Removal::patch && sweep >= o.removal_from;
  overshoot_ = 1 + std::max(kOvershootLeast, (o.overshoot - 1) * std::pow(kOvershootShrink, sweep));
}

/// Lines 10 to 16 of Algorithm 1.
bool VertexStep::improve(VertexId v, const Part& part) {
  if (!is_confined(mesh_, v, part)) return false;
  part_ = part;
  escapes_ = false;
  if (collapses_ && collapse(v)) return true;
  optimize_point(v);
  if (removes_ && !escapes_) remove_if_better(v);
  return !escapes_;
}

void VertexStep::improve(std::span<const VertexId> vertices, const Part& part, std::vector<VertexId>& left) {
  if (mesh_.n_vertices() >= kLeastForBatches && can_batch()) {
    batches_.improve(vertices, unknowns_, part, left);
    return;
  }
  for (const VertexId v : vertices) {
    if (!mesh_.is_isolated(v) && !improve(v, part)) left.push_back(v);
  }
}

/// Whether steps are what batches make.
bool VertexStep::can_batch() const { return makes_newton_steps(settings_) && !collapses_ && !removes_ && !band_.on(); }

/// Algorithm 2: where E_c would put v onto a neighbour, the mesh is better without v.
bool VertexStep::collapse(VertexId v) {
  if (!may_go(v)) return false;
  const EnergyModel& model = settings_.collapse_model;
  gather_patch(mesh_, v, needs_outer(model.kind), patch_);
  const OptimizeOptions& o = settings_.options;
  if (!nearly_collapses(patch_, model, mesh_.point(v), o.collapse_ratio, o.inversion)) return false;
  plan_ = plan_removal(mesh_, v, std::move(plan_));
  if (plan_.status != RemovalStatus::possible) return false;
  if (!defers_flips(settings_.options) && !is_regular(mesh_, plan_)) return false;
  flipper_.remove(EventKind::collapse, plan_, patch_energy(patch_, model, mesh_.point(v)),
                  cavity_energy(mesh_, model, plan_));
  return true;
}

/// Line 15 of Algorithm 1: E(P∖p) < E(P).
void VertexStep::remove_if_better(VertexId v) {
  if (!may_go(v) || mesh_.is_isolated(v)) return;
  plan_ = plan_removal(mesh_, v, std::move(plan_));
  if (plan_.status != RemovalStatus::possible) return;
  gather(v);
  const OptimizeOptions& o = settings_.options;
  const PatchComparison e = compare_patch(mesh_, patch_, settings_.model, plan_, o.removal_measure);
  if (!e.better_without(o.removal_margin)) return;
  if (!defers_flips(settings_.options) && !is_regular(mesh_, plan_)) return;
  flipper_.remove(EventKind::removal, plan_, e.with, e.without);
}

/// Lines 13 and 14 of Algorithm 1.
void VertexStep::optimize_point(VertexId v) {
  const Freedom all = freedom(mesh_, v, mobility_[v], unknowns_);
  const Freedom positions = position_part(all);
  const bool has_weight = all.n > positions.n;
  gather(v);
  switch (settings_.options.solver) {
    case Solver::newton:
      if (all.n > 0) newton_search(all);
      break;
    case Solver::alternating:
      if (positions.n > 0) {
        newton_search(positions);
        if (escapes_ || mesh_.is_isolated(v)) return;  // isolated: hidden, and removed
        gather(v);
      }
      if (has_weight) newton_search(weight_only());
      break;
    case Solver::golden:
      for (int i = 0; i < kPositionSearches && positions.n > 0; ++i) {
        golden_search(positions);
        if (escapes_ || mesh_.is_isolated(v)) return;
        gather(v);
      }
      if (has_weight) golden_search(weight_only());
      break;
  }
}

/// The patch of v as it is now.
void VertexStep::gather(VertexId v) {
  vertex_ = v;
  origin_ = mesh_.point(v);
  gather_patch(mesh_, v, needs_outer(settings_.model.kind), patch_);
}

/// A barrier is +∞ where some |Δw| ≥ ℓ² (weights of the input, or an unpriced flip). Puts the weight to the nearest
/// value that satisfies the spokes, if there is one; what is left of the patch is up to the neighbours. True when
/// the patch is finite then.
bool VertexStep::enter_domain() {
  if (unknowns_ == Unknowns::positions) return false;
  double low = -kInfinity, high = kInfinity;
  for (std::size_t i = 0; i < patch_.link.size(); ++i) {
    const WeightedPoint q = patch_.q(i);
    const double l2 = squared_length(q.position() - origin_.position());
    low = std::max(low, q.w - l2);
    high = std::min(high, q.w + l2);
  }
  if (!(low < high)) return false;
  constexpr double kInside = 0.1;  // of the interval, so that the barrier is not at its steepest
  const double w = std::clamp(origin_.w, low + kInside * (high - low), high - kInside * (high - low));
  const WeightedPoint p{origin_.x, origin_.y, w};
  if (!place(p, patch_energy(patch_, settings_.model, p), false) || mesh_.is_isolated(vertex_)) return false;
  gather(vertex_);
  return std::isfinite(patch_energy(patch_, settings_.model, origin_));
}

/// How far along step a search may go.
double VertexStep::farthest(const Step& step) const {
  return settings_.options.inversion == Inversion::allow ? 1 : inversion_limit(patch_, origin_, step);
}

/// t, cut to what the flip limit allows along step.
double VertexStep::flip_limited(const Step& step, double t) const {
  double factor = kInfinity;
  switch (settings_.flip_limit) {
    case FlipLimit::unlimited:
      return t;
    case FlipLimit::before:
      factor = kBeforeFlip;
      break;
    case FlipLimit::at:
      factor = 1;
      break;
    case FlipLimit::after:
      factor = overshoot_;
      break;
  }
  const double threshold = flip_threshold(mesh_, vertex_, step);
  return threshold < kNoThreshold ? std::min(t, factor * threshold) : t;
}

WeightedPoint VertexStep::moved(const Step& step, double t) const {
  const WeightedPoint p = along(origin_, step, t);
  if (step[0] == 0 && step[1] == 0) return p;
  const Vec2 x = frame_.snap(p.position());
  return {x.x, x.y, p.w};
}

/// One Newton step: over-relaxed, then plain, then halved until the energy falls. Where the size band holds the
/// position, the weight alone.
void VertexStep::newton_search(const Freedom& freedom) {
  VertexDerivatives d = patch_derivatives(patch_, settings_.model, origin_);
  energy_ = d.value;
  if (!d.feasible) {
    if (!enter_domain()) return;
    d = patch_derivatives(patch_, settings_.model, origin_);
  }
  energy_ = d.value;
  NewtonStep newton = newton_step(d, freedom, patch_radius(patch_, origin_));
  if (!(newton.predicted > kNoGain * std::abs(energy_))) return;
  const double relaxation = settings_.relaxation;
  for (double& s : newton.step) s *= relaxation;
  double t = flip_limited(newton.step, farthest(newton.step));
  bool leaves_band = false;
  for (int trial = 0; trial < kTrials; ++trial) {
    switch (try_step(newton.step, t)) {
      case Outcome::accepted:
      case Outcome::escaped:
        return;
      case Outcome::blocked_by_flip: {
        // The flip does not pay, or hides a vertex: stop short of it. At a tie, one small step may still pay.
        const double threshold = flip_threshold(mesh_, vertex_, newton.step);
        if (threshold >= t) return;  // only rounding stands between the two
        t = threshold > kTie * t ? kBeforeFlip * threshold : 1e-3 * t;
        break;
      }
      case Outcome::out_of_band:
        leaves_band = true;
        [[fallthrough]];
      case Outcome::not_lower:
      case Outcome::inverted:
        t *= trial == 0 && relaxation > 1 ? 1 / relaxation : 0.5;
        break;
    }
  }
  if (leaves_band && freedom.n > position_part(freedom).n) newton_search(weight_only());
}

/// The paper's Algorithm 5: a finite-difference gradient, then golden section downhill within the patch radius.
void VertexStep::golden_search(const Freedom& freedom) {
  energy_ = patch_energy(patch_, settings_.model, origin_);
  if (!std::isfinite(energy_)) {
    if (!enter_domain()) return;
    energy_ = patch_energy(patch_, settings_.model, origin_);
  }
  const double r = patch_radius(patch_, origin_);
  const auto direction = steepest_descent(patch_, settings_.model, origin_, freedom, freedom.moves() ? r : r * r);
  if (!direction) return;
  const double limit = flip_limited(*direction, farthest(*direction));
  if (!(limit > 0)) return;
  double t = line_minimum(patch_, settings_.model, origin_, *direction, limit);
  Outcome outcome = try_step(*direction, t);
  for (int trial = 1; outcome == Outcome::out_of_band && trial < kTrials; ++trial) {
    t *= 0.5;
    outcome = try_step(*direction, t);
  }
  if (outcome == Outcome::blocked_by_flip) {
    const double threshold = flip_threshold(mesh_, vertex_, *direction);
    if (threshold < t) try_step(*direction, kBeforeFlip * threshold);
  }
}

VertexStep::Outcome VertexStep::try_step(const Step& step, double t) {
  const WeightedPoint p = moved(step, t);
  const double energy = patch_energy(patch_, settings_.model, p);
  if (!(energy < energy_)) return Outcome::not_lower;
  if (settings_.options.inversion == Inversion::refuse && !stays_oriented(p)) return Outcome::inverted;
  if (!keeps_size(p)) return Outcome::out_of_band;
  if (place(p, energy, settings_.energy.barrier)) return Outcome::accepted;
  return escapes_ ? Outcome::escaped : Outcome::blocked_by_flip;
}

/// The vertex at p, where its patch has that energy, with what flips that needs; or where it was, and false: when a
/// vertex would be hidden, or flips cost more than the step gains and it must pay, or they escape from the part.
bool VertexStep::place(const WeightedPoint& p, double energy, bool must_pay) {
  const bool only_weight = p.x == origin_.x && p.y == origin_.y;
  if (only_weight && settings_.options.weight_updates == WeightUpdates::deferred) {
    deferred_.push_back({vertex_, p.w, energy_, energy});
    return true;
  }
  if (keeps_connectivity()) note_regular_edges();
  mesh_.set_point(vertex_, p);
  if (flips_at_once()) {
    SizeBand* const band = band_.on() ? &band_ : nullptr;
    const auto settled = flipper_.settle({vertex_, origin_, energy_, energy, must_pay, band, part_});
    escapes_ = settled == Flipper::Settled::escaped;
    if (settled == Flipper::Settled::done && !only_weight) band_.moved(vertex_);
    return settled == Flipper::Settled::done;
  }
  const bool fits = !keeps_connectivity() || regular_edges_still_are();
  if (fits && !only_weight) band_.moved(vertex_);
  if (fits) {
    recorder_.placed(vertex_, origin_, p, energy_, energy);
  } else {
    mesh_.set_point(vertex_, origin_);
  }
  return fits;
}

/// To be asked before place(), which tells the band where its vertex went.
bool VertexStep::keeps_size(const WeightedPoint& p) {
  const bool only_weight = p.x == origin_.x && p.y == origin_.y;
  return only_weight || !band_.on() || band_.allows(patch_, p.position());
}

/// Thresholds are computed in doubles; that no edge flips is decided exactly.
bool VertexStep::keeps_connectivity() const {
  return !settings_.options.flips || settings_.flip_limit == FlipLimit::before;
}

void VertexStep::nudge(VertexId v, Vec2 p) {
  if (!may_go(v)) return;
  part_ = {};
  gather(v);
  energy_ = patch_energy(patch_, settings_.model, origin_);
  const WeightedPoint there{p.x, p.y, origin_.w};
  if (stays_oriented(there) && keeps_size(there)) place(there, patch_energy(patch_, settings_.model, there), false);
}

void VertexStep::shake(double amount, Rng& rng) {
  for (const VertexId v : mesh_.vertices()) {
    const Vec2 p = mesh_.position(v);
    double shortest2 = kInfinity;
    for (const HalfedgeId h : mesh_.star(v)) {
      shortest2 = std::min(shortest2, squared_length(mesh_.position(mesh_.target(h)) - p));
    }
    const Vec2 away = amount * std::sqrt(shortest2) * Vec2{rng.uniform(-1, 1), rng.uniform(-1, 1)};
    nudge(v, frame_.snap(p + away));
  }
}

void VertexStep::end_sweep() {
  for (const auto& [v, w, before, after] : deferred_) {
    if (mesh_.is_isolated(v)) continue;
    const WeightedPoint from = mesh_.point(v);
    mesh_.set_weight(v, w);
    recorder_.placed(v, from, mesh_.point(v), before, after);
  }
  deferred_.clear();
}

bool VertexStep::flips_at_once() const {
  return !keeps_connectivity() && settings_.options.flip_timing == FlipTiming::immediate;
}

bool VertexStep::stays_oriented(const WeightedPoint& p) const {
  const double nearest = settings_.energy.barrier ? 0 : kShortestEdge * patch_radius(patch_, origin_);
  for (std::size_t i = 0; i < patch_.size(); ++i) {
    const Vec2 q = patch_.q(i).position();
    if (inlined::orient2d(p.position(), q, patch_.r(i).position()) != Sign::positive) return false;
    if (squared_length(q - p.position()) < nearest * nearest) return false;
  }
  return true;
}

/// With its connectivity kept an edge that is regular must stay so; one that is not may wait.
void VertexStep::note_regular_edges() {
  was_regular_.clear();
  for (const HalfedgeId h : mesh_.star(vertex_)) {
    for (const HalfedgeId e : {h, Mesh::next(h)}) was_regular_.push_back(is_regular(mesh_, e) ? 1 : 0);
  }
}

bool VertexStep::regular_edges_still_are() const {
  auto was = was_regular_.begin();
  for (const HalfedgeId h : mesh_.star(vertex_)) {
    for (const HalfedgeId e : {h, Mesh::next(h)}) {
      if (*was++ != 0 && !mesh_.is_constrained(e) && !is_regular(mesh_, e)) return false;
    }
  }
  return true;
}

}  // namespace temper
