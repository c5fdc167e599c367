// Included by one source for each instruction set, compiled for that set: nothing here may use inline functions of
// common headers, see scripts/check_instruction_sets.py.
#pragma once

#include "step_parts.hpp"
// That header ends with the definitions of these two, which the library has already.
#define kPlaneSteps kPlaneStepsOfParts
#define kSphereSteps kSphereStepsOfParts
#include "optimize/batch/star_batch_set.hpp"
#undef kPlaneSteps
#undef kSphereSteps

namespace temper::TEMPER_INSTRUCTION_SET {

extern const bench::StepParts kStepParts;

namespace {

using bench::PartsState;

TEMPER_INLINE void store_sums(const StarSums& sums, Lane (&to)[kStarSums]) {
  const auto& [g, h] = sums.derivatives;
  const Pack packs[kStarSums] = {sums.value, g.x, g.y, g.w, h.xx, h.xy, h.xw, h.yy, h.yw, h.ww};
  for (std::size_t k = 0; k < kStarSums; ++k) packs[k].store(to[k]);
}

TEMPER_INLINE PackStep load_step(const PartsState& state) {
  PackStep step;
  step.x = Pack::load(state.step_x), step.y = Pack::load(state.step_y), step.w = Pack::load(state.step_w);
  return step;
}

TEMPER_INLINE InPlane::Point place(const StarBatch& batch, const PartsState& state) {
  const InPlane::Point p = load<InPlane>(batch.p);
  const PackStep step = load_step(state);
  const Pack t = Pack::load(state.limit);
  return {p.x + t * step.x, p.y + t * step.y, p.w + t * step.w};
}

void part_derivatives(const StepParameters& parameters, const StarBatch& batch, PartsState& state) {
  with_barrier(parameters.formula, [&](const auto& kernel) {
    const Derivatives d = derivatives<InPlane>(kernel, batch, load<InPlane>(batch.p));
    store_sums(d.sums, state.sums);
    d.squared_radius.store(state.squared_radius);
  });
}

void part_newton(const StarBatch& batch, PartsState& state) {
  Derivatives d;
  Pack packs[kStarSums];
  for (std::size_t k = 0; k < kStarSums; ++k) packs[k] = Pack::load(state.sums[k]);
  const auto& [value, x, y, w, xx, xy, xw, yy, yw, ww] = packs;
  d.sums = {value, {{x, y, w}, {xx, xy, xw, yy, yw, ww}}};
  d.squared_radius = Pack::load(state.squared_radius);
  const PackStep step = newton_step(d, load(batch.moves), load(batch.changes_weight));
  step.x.store(state.step_x);
  step.y.store(state.step_y);
  step.w.store(state.step_w);
  step.predicted.store(state.predicted);
}

void part_inversion_limit(const StarBatch& batch, PartsState& state) {
  inversion_limit<InPlane>(batch, load<InPlane>(batch.p), load_step(state)).store(state.limit);
}

void part_trial(const StepParameters& parameters, const StarBatch& batch, PartsState& state) {
  with_barrier(parameters.formula, [&](const auto& kernel) {
    energy_at<InPlane>(kernel, batch, place(batch, state)).value.store(state.trial);
  });
}

void part_regular(const StarBatch& batch, PartsState& state) {
  state.regular = regular_at(batch, place(batch, state)).bits();
}

void star_sums(const EdgeFormula& formula, const bench::StarLanes& stars, Lane (&out)[kStarSums]) {
  with_barrier(formula, [&](const auto& kernel) {
    const InPlane::Point p = load<InPlane>(stars.p);
    const Pack triangles = Pack::load(stars.triangles);
    StarSums sums;
    InPlane::Point q = load<InPlane>(stars.link[0]);
    auto a = spoke_of<InPlane>(kernel, p, q);
    for (std::size_t i = 0; i < stars.most_triangles; ++i) {
      const InPlane::Point r = load<InPlane>(stars.link[i + 1]);
      const auto b = spoke_of<InPlane>(kernel, p, r);
      add_barrier<InPlane>(kernel, a, b, q, r, has_triangle(triangles, i), sums);
      q = r;
      a = b;
    }
    store_sums(sums, out);
  });
}

}  // namespace

const bench::StepParts kStepParts = {part_derivatives, part_newton,  part_inversion_limit,
                                     part_trial,       part_regular, star_sums};

}  // namespace temper::TEMPER_INSTRUCTION_SET
