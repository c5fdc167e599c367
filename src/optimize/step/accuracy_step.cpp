#include "optimize/step/accuracy_step.hpp"

#include <cmath>

#include "optimize/schedule.hpp"
#include "optimize/step/line_search.hpp"
#include "optimize/step/newton.hpp"
#include "optimize/step/newton_constants.hpp"

namespace temper {
namespace {

// A barrier is near more often than not, so that more trials pay than in an E_BP step.
constexpr int kAccuracyTrials = 12;

}  // namespace

void AccuracyStep::improve(VertexId v) {
  Freedom all = freedom(mesh_, v, limits_.mobility[v], settings_.options.unknowns);
  if (v == ground_.anchor) all = position_part(all);
  if (all.n == 0 || !patch_.gather(mesh_, ground_.sizes, ground_.floors, settings_.accuracy, v)) return;
  const bool has_weight = all.n > position_part(all).n;
  if (search(v, all) == Found::only_outside_of_band && has_weight) search(v, weight_only());
}

AccuracyStep::Found AccuracyStep::search(VertexId v, const Freedom& freedom) {
  const WeightedPoint from = mesh_.point(v);
  const double before = patch_.value(from);
  if (!(before < kInfinity)) return Found::none;  // at its floor but for rounding: the neighbours may free it
  NewtonStep newton = newton_step(patch_.derivatives(), freedom, patch_.shortest_spoke(from));
  if (!(newton.predicted > kNoGain * std::abs(before))) return Found::none;
  const double relaxation = settings_.options.relaxation.value_or(kRelaxation);
  for (double& s : newton.step) s *= relaxation;
  Found found = Found::none;
  double t = 1;
  for (int trial = 0; trial < kAccuracyTrials; ++trial) {
    const WeightedPoint to = moved(from, newton.step, t);
    const double after = patch_.value(to);
    t *= trial == 0 && relaxation > 1 ? 1 / relaxation : 0.5;
    if (!(after < before) || !patch_.is_well_centered(to)) continue;
    if (!keeps_size(v, from, to)) {
      found = Found::only_outside_of_band;
      continue;
    }
    mesh_.set_point(v, to);
    if (to.x != from.x || to.y != from.y) limits_.band.moved(v);
    recorder_.placed(v, from, to, before, after);
    return Found::step;
  }
  return found;
}

WeightedPoint AccuracyStep::moved(const WeightedPoint& from, const Step& step, double t) const {
  const WeightedPoint to = along(from, step, t);
  if (step[0] == 0 && step[1] == 0) return to;
  const Vec2 p = frame_.snap(to.position());
  return {p.x, p.y, to.w};
}

bool AccuracyStep::keeps_size(VertexId v, const WeightedPoint& from, const WeightedPoint& to) {
  if (!limits_.band.on() || (to.x == from.x && to.y == from.y)) return true;
  gather_patch(mesh_, v, false, star_);
  return limits_.band.allows(star_, to.position());
}

}  // namespace temper
