#include "optimize/vertex_step.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/predicates_inline.hpp"
#include "optimize/golden.hpp"
#include "regularity/flip_threshold.hpp"
#include "regularity/power_tests.hpp"
#include "temper/regularity.hpp"

namespace temper {
namespace {

// A step goes at most this part of the way to the first triangle's inversion.
constexpr double kInversionFraction = 0.9;
// Short of a flip by this factor when the flip does not pay.
constexpr double kBeforeFlip = 0.99;
// A threshold below this part of the step is a tie: stopping short of it would be standing still.
constexpr double kTie = 1e-6;
// Trials a Newton step: over-relaxed, plain, then halved.
constexpr int kTrials = 6;
// A model decrease below this part of the patch energy is rounding, not progress.
constexpr double kNoGain = 1e-15;
// Flips of one vertex step; more than a few are a cascade that rarely pays.
constexpr std::size_t kMostFlips = 64;
// The paper's line search: steps of central differences, and the last bracket, relative to the patch radius.
constexpr double kDifference = 1e-6;
// Golden section cannot tell energies apart below the root of the roundoff.
constexpr double kGoldenTolerance = 1e-8;
constexpr int kPositionSearches = 3;
// HOT has no barrier: nothing may come nearer to a neighbour than this part of the patch radius.
constexpr double kShortestEdge = 1e-7;
constexpr double kOvershootShrink = 0.1, kOvershootLeast = 1e-6;

/// Sums what flips change of the energy.
struct FlipPrice {
  const EnergyModel& model;
  double change = 0;
  void before(const Mesh& mesh, HalfedgeId h) { change -= flip_energy(mesh, model, h); }
  void after(const Mesh& mesh, HalfedgeId h) { change += flip_energy(mesh, model, h); }
};

}  // namespace

void VertexStep::begin_sweep(int sweep) {
  const OptimizeOptions& o = settings_.options;
  unknowns_ = o.unknowns;
  if (sweep < o.weights_from && unknowns_ == Unknowns::positions_and_weights) unknowns_ = Unknowns::positions;
  overshoot_ = 1 + std::max(kOvershootLeast, (o.overshoot - 1) * std::pow(kOvershootShrink, sweep));
  flips_ = 0;
}

void VertexStep::improve(VertexId v) {
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
        gather(v);
      }
      if (has_weight) newton_search(weight_only());
      break;
    case Solver::golden:
      for (int i = 0; i < kPositionSearches && positions.n > 0; ++i) {
        golden_search(positions);
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
  for (const WeightedPoint& q : patch_.link) {
    const double l2 = squared_length(q.position() - origin_.position());
    low = std::max(low, q.w - l2);
    high = std::min(high, q.w + l2);
  }
  if (!(low < high)) return false;
  constexpr double kInside = 0.1;  // of the interval, so that the barrier is not at its steepest
  const double w = std::clamp(origin_.w, low + kInside * (high - low), high - kInside * (high - low));
  if (!place({origin_.x, origin_.y, w}, std::nullopt)) return false;
  gather(vertex_);
  return std::isfinite(patch_energy(patch_, settings_.model, origin_));
}

double VertexStep::radius() const {
  double sum = 0;
  for (const WeightedPoint& q : patch_.link) sum += squared_length(q.position() - origin_.position());
  return std::sqrt(sum / static_cast<double>(patch_.link.size()));
}

/// The largest t ≤ 1 along step that stays clear of inverting a triangle. Signed areas are linear in t.
double VertexStep::inversion_limit(const Step& step) const {
  double limit = 1;
  for (std::size_t i = 0; i < patch_.size(); ++i) {
    const Vec2 a = patch_.q(i).position() - origin_.position(), b = patch_.r(i).position() - origin_.position();
    const double area = cross(a, b);
    const double slope = step[0] * (a.y - b.y) + step[1] * (b.x - a.x);
    if (area + limit * slope < (1 - kInversionFraction) * area) limit = -kInversionFraction * area / slope;
  }
  return limit;
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
  const WeightedPoint p{origin_.x + t * step[0], origin_.y + t * step[1], origin_.w + t * step[2]};
  if (step[0] == 0 && step[1] == 0) return p;
  const Vec2 x = frame_.snap(p.position());
  return {x.x, x.y, p.w};
}

/// One Newton step: over-relaxed, then plain, then halved until the energy falls.
void VertexStep::newton_search(const Freedom& freedom) {
  VertexDerivatives d = patch_derivatives(patch_, settings_.model, origin_);
  if (!d.feasible) {
    if (!enter_domain()) return;
    d = patch_derivatives(patch_, settings_.model, origin_);
  }
  energy_ = d.value;
  NewtonStep newton = newton_step(d, freedom, radius());
  if (!(newton.predicted > kNoGain * std::abs(energy_))) return;
  const double relaxation = settings_.options.relaxation;
  for (double& s : newton.step) s *= relaxation;
  double t = flip_limited(newton.step, inversion_limit(newton.step));
  for (int trial = 0; trial < kTrials; ++trial) {
    switch (try_step(newton.step, t)) {
      case Outcome::accepted:
        return;
      case Outcome::blocked_by_flip: {
        // The flip does not pay, or hides a vertex: stop short of it. At a tie, one small step may still pay.
        const double threshold = flip_threshold(mesh_, vertex_, newton.step);
        if (threshold >= t) return;  // only rounding stands between the two
        t = threshold > kTie * t ? kBeforeFlip * threshold : 1e-3 * t;
        break;
      }
      case Outcome::not_lower:
      case Outcome::inverted:
        t *= trial == 0 && relaxation > 1 ? 1 / relaxation : 0.5;
        break;
    }
  }
}

/// The paper's Algorithm 5: a finite-difference gradient, then golden section downhill within the patch radius.
void VertexStep::golden_search(const Freedom& freedom) {
  energy_ = patch_energy(patch_, settings_.model, origin_);
  if (!std::isfinite(energy_)) {
    if (!enter_domain()) return;
    energy_ = patch_energy(patch_, settings_.model, origin_);
  }
  const double r = radius();
  Step direction = {};
  double norm2 = 0;
  const bool is_weight = !freedom.moves();
  const double unit = is_weight ? r * r : r;
  for (int i = 0; i < freedom.n; ++i) {
    const auto& axis = freedom.axis[static_cast<std::size_t>(i)];
    const auto at = [&](double t) {
      return patch_energy(patch_, settings_.model,
                          {origin_.x + t * axis[0], origin_.y + t * axis[1], origin_.w + t * axis[2]});
    };
    const double h = kDifference * unit;
    const double slope = (at(h) - at(-h)) / (2 * h);
    if (!std::isfinite(slope)) return;
    norm2 += slope * slope;
    for (std::size_t k = 0; k < 3; ++k) direction[k] -= slope * axis[k];
  }
  if (!(norm2 > 0)) return;
  for (double& s : direction) s *= unit / std::sqrt(norm2);
  const double limit = flip_limited(direction, 1);
  if (!(limit > 0)) return;
  const double t = golden_section(
      [&](double s) {
        return patch_energy(patch_, settings_.model,
                            {origin_.x + s * direction[0], origin_.y + s * direction[1], origin_.w + s * direction[2]});
      },
      limit, kGoldenTolerance);
  if (try_step(direction, t) == Outcome::blocked_by_flip) {
    const double threshold = flip_threshold(mesh_, vertex_, direction);
    if (threshold < t) try_step(direction, kBeforeFlip * threshold);
  }
}

VertexStep::Outcome VertexStep::try_step(const Step& step, double t) {
  const WeightedPoint p = moved(step, t);
  const double energy = patch_energy(patch_, settings_.model, p);
  if (!(energy < energy_)) return Outcome::not_lower;
  return commit_if_lower(p, energy);
}

/// Puts the vertex at p and restores regularity; or undoes both, when a triangle would turn over, a vertex be
/// hidden, or the flips cost more than the step gains.
VertexStep::Outcome VertexStep::commit_if_lower(const WeightedPoint& p, double energy) {
  if (!stays_oriented(p)) return Outcome::inverted;
  return place(p, energy - energy_) ? Outcome::accepted : Outcome::blocked_by_flip;
}

/// The vertex at p, with what flips that needs; or where it was, and false.
bool VertexStep::place(const WeightedPoint& p, std::optional<double> change) {
  if (!settings_.options.flips) note_regular_edges();
  mesh_.set_point(vertex_, p);
  const bool fits = settings_.options.flips ? !flips_at_once() || flip_to_regular(change) : regular_edges_still_are();
  if (!fits) mesh_.set_point(vertex_, origin_);
  return fits;
}

bool VertexStep::flips_at_once() const {
  return settings_.options.flips && settings_.options.flip_timing == FlipTiming::immediate;
}

bool VertexStep::stays_oriented(const WeightedPoint& p) const {
  const double nearest = settings_.energy.barrier ? 0 : kShortestEdge * radius();
  for (std::size_t i = 0; i < patch_.size(); ++i) {
    const Vec2 q = patch_.q(i).position();
    if (inlined::orient2d(p.position(), q, patch_.r(i).position()) != Sign::positive) return false;
    if (squared_length(q - p.position()) < nearest * nearest) return false;
  }
  return true;
}

/// With frozen connectivity an edge that is regular must stay so; one that is not may wait.
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

/// Lawson from the edges around the vertex. Undoes its flips and says no when an edge stays stuck (a vertex is
/// hidden), or when, with a barrier, `change` of the patch plus the flips' is not a gain. Without `change`, any price.
bool VertexStep::flip_to_regular(std::optional<double> change) {
  lawson_.clear();
  bool regular = true;
  for (const HalfedgeId h : mesh_.star(vertex_)) {
    for (const HalfedgeId e : {h, Mesh::next(h)}) {
      if (mesh_.is_boundary(e) || mesh_.is_constrained(e)) continue;
      if (PowerTest()(mesh_, inlined::quad(mesh_, e)) == Sign::positive) {
        lawson_.push(e);
        regular = false;
      }
    }
  }
  if (regular) return true;
  const bool priced = settings_.energy.barrier && change.has_value();
  FlipPrice price{settings_.model, change.value_or(0)};
  const LawsonRun run = priced ? lawson_.run(mesh_, price, kMostFlips) : lawson_.run(mesh_, IgnoreFlips(), kMostFlips);
  const bool pays = !priced || price.change < 0;
  if (!run.finished || !pays || !lawson_.stuck(mesh_).empty()) {
    lawson_.rollback(mesh_);
    return false;
  }
  flips_ += run.flips;
  return true;
}

}  // namespace temper
