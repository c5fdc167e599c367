// Rounds that lower the accuracy energy of a mesh without bad cells.
#include <algorithm>

#include "optimize/options/settings.hpp"
#include "surfaces/optimize/draft_energy.hpp"
#include "surfaces/optimize/run.hpp"

namespace temper::surfaces {
namespace {

constexpr double kSmallPart = 1e-3;  // a round that lowers the energy by less than this part is the last

double margin_of(const SurfaceMesh& mesh, TriangleId t) {
  const TriangleQuality quality = triangle_quality(mesh, t);
  return std::min(quality.min_h_over_l, quality.min_d_over_l);
}

double least_margin_of(const SurfaceMesh& mesh) {
  double least = 1;
  for (const TriangleId t : mesh.triangles()) least = std::min(least, margin_of(mesh, t));
  return least;
}

std::size_t n_below(const SurfaceMesh& mesh, double margin) {
  std::size_t n = 0;
  for (const TriangleId t : mesh.triangles()) n += margin_of(mesh, t) < margin ? 1 : 0;
  return n;
}

double accuracy_energy_of(const SurfaceMesh& mesh, const AccuracyModel& model) {
  Draft draft = weights_of(mesh);
  return DraftEnergy(draft, model).value().lowered;
}

}  // namespace

std::optional<State> Run::lowered(const State& state, const AccuracyModel& model, int steps, double least_margin,
                                  Nearness::Known& known) const {
  const auto stop = [this] { return must_stop(); };
  Draft draft = draft_of(state.mesh, state.tracks, state.lines, true);
  const IdVector<VertexId, WeightedPoint> first = draft.points;
  DraftEnergy energy(draft, model);
  const double before = energy.value().lowered;
  energy.lower(steps, stop);
  energy.project(nearness.input(), limit);
  State next = state;
  constexpr int kTries = 4;
  for (int i = 0; i < kTries && take(next, draft, first, known); ++i) {
    Draft weights = weights_of(next.mesh);
    for (const VertexId v : next.mesh.vertices()) weights.weighs[v] = draft.weighs[v];
    DraftEnergy(weights, model).lower(kSteps, stop);
    for (const VertexId v : next.mesh.vertices()) next.mesh.set_weight(v, weights.points[v].w);
    std::vector<TriangleId> bad = cells_at_violations(next.mesh, options.criterion);
    for (const TriangleId t : next.mesh.triangles()) {
      if (margin_of(next.mesh, t) < least_margin) bad.push_back(t);
    }
    if (bad.empty()) {
      draft.points = std::move(weights.points);
      next.gain = energy.is_inside() ? 1 - energy.value().lowered / before : 0;
      return next;
    }
    for (const TriangleId t : bad) {
      for (const VertexId v : next.mesh.corners(t)) draft.points[v] = first[v], draft.weighs[v] = 0;
    }
    go_back(draft, first, limit);
  }
  return std::nullopt;
}

State Run::polished(State state) {
  const State given = state;
  state.cost.reset();
  // The margin of the barrier, in margins of the options. With more, projection to the surface takes more back.
  constexpr double kBarrierMargin = 2;
  AccuracyOptions accuracy;
  accuracy.margin = kBarrierMargin * options.margin;
  const AccuracyModel model = accuracy_model(accuracy, options.scheme, Star::one);
  Nearness::Known known;
  double least_margin = least_margin_of(state.mesh);
  if (least_margin < options.margin && n_below(state.mesh, options.margin) <= kFewForPrograms) {
    std::optional<SurfaceMesh> changed = with_margin(state.mesh, WeightGoal::elastic, options.margin);
    if (changed && bad(*changed) == 0 && least_margin_of(*changed) > least_margin) state.mesh = *std::move(changed);
  }
  // Small margins must not get smaller.
  least_margin = std::min(options.margin, least_margin_of(state.mesh));
  int steps = kSteps;
  for (int round = 0; round < kRounds && steps >= 0 && !must_stop(); ++round) {
    std::optional<State> next = lowered(state, model, steps, least_margin, known);
    ++report.sweeps;
    const double gain = next ? next->gain : 0;
    if (gain > 0) state = *std::move(next);
    record({.energy = accuracy_energy_of(state.mesh, model), .bad = state.bad, .objective = Objective::accuracy});
    offer(state);
    if (gain > 0 && gain < kSmallPart) break;
    if (gain <= 0) steps = steps > 0 ? steps / 2 : -1;  // at last the weights alone
  }
  if (judged == nullptr) return state;
  return better(std::move(state), given);
}

}  // namespace temper::surfaces
