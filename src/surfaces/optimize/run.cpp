// The steps of a run, and their order.
#include "surfaces/optimize/run.hpp"

#include <algorithm>
#include <cmath>

#include "base/sort_unique.hpp"
#include "feasibility/demand.hpp"
#include "mesh/exact_range.hpp"
#include "optimize/run/judge.hpp"
#include "surfaces/mesh/surface_editor.hpp"
#include "surfaces/optimize/flips.hpp"

namespace temper::surfaces {
namespace {

constexpr double kFirstGamma = 1, kGammaFactor = 0.72;
constexpr double kSteepGamma = 0.4;  // factor from one descent of weights alone to the next
// Edges of triangles that are not well-centered may turn more than creases by this angle [degrees]. With 0, two more
// public meshes (bunny, screwdriver) keep bad triangles.
constexpr double kMoreAtBad = 20;

}  // namespace

Draft draft_of(const SurfaceMesh& mesh, const IdVector<VertexId, Track>& tracks, const Lines* lines,
               bool with_weights) {
  Draft draft;
  draft.tracks = tracks;
  draft.lines = lines;
  for (const VertexId v : mesh.vertices()) {
    draft.points.push_back(mesh.point(v));
    draft.weighs.push_back(with_weights && !mesh.connectivity().is_frozen(v) ? 1 : 0);
  }
  for (const TriangleId t : mesh.triangles()) draft.triangles.push_back(mesh.connectivity().corners(t));
  return draft;
}

Draft weights_of(const SurfaceMesh& mesh) {
  return draft_of(mesh, IdVector<VertexId, Track>(mesh.n_vertices(), kHeld), nullptr, true);
}

SurfaceMesh scaled(SurfaceMesh mesh, double factor) {
  for (const VertexId v : mesh.vertices()) {
    mesh.set_position(v, factor * mesh.position(v));
    mesh.set_weight(v, factor * factor * mesh.weight(v));
  }
  return mesh;
}

double energy_of(const SurfaceMesh& mesh, double gamma) {
  Draft draft = weights_of(mesh);
  return DraftEnergy(draft, gamma).value().lowered;
}

SurfaceMesh Run::result(const State& state) const {
  SurfaceMesh mesh = scaled(state.mesh, unit);
  Mesh& connectivity = SurfaceEditor(mesh).connectivity();
  for (const auto& [a, b] : state.creases) connectivity.set_constrained(connectivity.find_halfedge(a, b), false);
  for (const VertexId v : mesh.vertices())
    mesh.set_weight(v, kCoordinatesInSpace.squared().without_tiny(mesh.weight(v)));
  return mesh;
}

Vec3 Run::without_tiny(Vec3 p) const {
  const ExactRange range = {kCoordinatesInSpace.low / unit, kCoordinatesInSpace.high / unit};
  return {range.without_tiny(p.x), range.without_tiny(p.y), range.without_tiny(p.z)};
}

double Run::seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); }

bool Run::must_stop() const {
  if (stopped_early(report.stopped)) return true;
  const auto from = options.started.value_or(start);
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - from;
  if (options.time_limit > 0 && passed.count() > options.time_limit) report.stopped = Stopped::time_limit;
  if (options.must_stop && options.must_stop()) report.stopped = Stopped::canceled;
  return stopped_early(report.stopped);
}

std::vector<VertexId> Run::too_far(const State& state, Nearness::Known& known) const {
  std::vector<VertexId> far = nearness.too_far(state.mesh, known);
  const std::vector<VertexId> of_lines = state.lines->too_far(state.mesh, state.tracks, nearness.most());
  far.insert(far.end(), of_lines.begin(), of_lines.end());
  sort_unique(far);
  return far;
}

void Run::record(SweepRecord measured) const {
  measured.sweep = report.sweeps;
  measured.seconds = seconds();
  report.history.push_back(measured);
  if (options.observer && options.observer({measured, 0, 2 * kRounds}) == Continue::no)
    report.stopped = Stopped::canceled;
}

void Run::offer(const State& found) {
  if (!options.best_so_far) return;
  if (!shown || found.bad <= shown->bad) shown = found;
  options.best_so_far([this](const std::function<void(const BestSoFar&)>& use) {
    use({result(*shown), shown->repairs > 0 ? shown->origins : IdVector<VertexId, VertexId>()});
  });
}

bool Run::take(State& state, Draft& draft, const IdVector<VertexId, WeightedPoint>& first,
               Nearness::Known& known) const {
  bool is_rounded = false;
  for (WeightedPoint& p : draft.points) {
    const Vec3 at = without_tiny(p.position());
    is_rounded = is_rounded || at != p.position();
    p = {at.x, at.y, at.z, p.w};
  }
  if (is_rounded) go_back(draft, first, limit);
  constexpr int kTries = 8;
  for (int i = 0; i < kTries; ++i) {
    for (const VertexId v : state.mesh.vertices()) {
      state.mesh.set_position(v, draft.points[v].position());
      state.mesh.set_weight(v, draft.points[v].w);
    }
    const std::vector<VertexId> far = too_far(state, known);
    if (far.empty()) return true;
    for (const VertexId v : far) draft.points[v] = {first[v].x, first[v].y, first[v].z, draft.points[v].w};
    go_back(draft, first, limit);
  }
  return false;
}

void Run::move_all(State& state, bool with_weights) {
  State best = state;
  double gamma = kFirstGamma;
  Nearness::Known known;
  for (int round = 0; round < kRounds && best.bad > 0 && !must_stop(); ++round) {
    const SurfaceMesh before = state.mesh;
    Draft draft = draft_of(before, state.tracks, state.lines, with_weights);
    const IdVector<VertexId, WeightedPoint> first = draft.points;
    DraftEnergy energy(draft, gamma);
    energy.lower(kSteps, [this] { return must_stop(); });
    energy.project(nearness.input(), limit);
    if (!take(state, draft, first, known)) state.mesh = before;
    std::size_t flips = 0;
    if (options.may_flip) {
      const SurfaceMesh unflipped = state.mesh;
      flips = flip_negative_duals(state.mesh, nearness, limit);
      if (flips > 0 && !too_far(state, known).empty()) {
        state.mesh = unflipped;
        flips = 0;
      }
    }
    report.flips += flips;
    ++report.sweeps;
    state.bad = bad(state.mesh);
    record({.energy = energy_of(state.mesh, gamma), .bad = state.bad, .flips = flips, .length_parameter = gamma});
    if (state.bad <= best.bad) best = state;
    offer(best);
    gamma = std::max(kLastGamma, gamma * kGammaFactor);
  }
  state = std::move(best);
}

State Run::moved(const State& input, State best) {
  for (const bool with_weights : {false, true}) {
    if (best.bad == 0 || must_stop()) break;
    State changed = input;
    move_all(changed, with_weights);
    find_weights(changed);
    offer(changed);
    if (changed.bad < best.bad) best = std::move(changed);
  }
  return best;
}

State Run::best_of_limits(const State& input, State best, TurnLimit first) {
  const State weighted = best;
  TurnLimit second = first;
  second.at_bad += kMoreAtBad;
  for (const TurnLimit& next : {first, second, TurnLimit()}) {
    if (best.bad == 0 || !options.may_move || must_stop()) break;
    limit = next;
    State found = moved(input, weighted);
    if (limit.at_bad > first.at_bad && options.may_insert) repair(found);
    if (found.bad < best.bad) best = std::move(found);
  }
  return best;
}

double Run::cost_of(const State& state) {
  if (judged == nullptr) return energy_of(state.mesh, kLastGamma) / static_cast<double>(state.mesh.n_triangles());
  if (errors_of_input.empty()) errors_of_input = options.squared_errors(*judged, options.scheme);
  const std::vector<double> errors = options.squared_errors(result(state), options.scheme);
  return errors.empty() ? HUGE_VAL : largest_ratio(errors, errors_of_input);
}

State Run::better(State best, State other) {
  if (best.bad != other.bad || best.bad > 0) return other.bad < best.bad ? std::move(other) : std::move(best);
  for (State* const state : {&best, &other}) {
    if (must_stop()) return best;
    if (!state->cost) state->cost = cost_of(*state);
  }
  return !must_stop() && *other.cost < *best.cost ? std::move(other) : std::move(best);
}

State Run::best_of_starts(const State& input, const State& weighted, TurnLimit first) {
  State best = best_of_limits(input, weighted, first);
  limit = first;
  if (best.bad > 0 || input.bad == 0 || !options.may_move) return best;
  if (weighted.bad > 0) return polished(std::move(best));
  best = polished(with_least_change(input, std::move(best)));
  State found = moved(input, input);
  if (found.bad == 0) found = polished(std::move(found));
  return better(std::move(best), std::move(found));
}

State Run::with_least_change(const State& input, State otherwise) const {
  // With a larger margin errors are larger.
  constexpr double kPartOfMargin = 0.1;
  if (judged == nullptr) return otherwise;
  std::optional<SurfaceMesh> changed = with_margin(input.mesh, WeightGoal::change, kPartOfMargin * options.margin);
  if (changed && bad(*changed) == 0) otherwise.mesh = *std::move(changed);
  return otherwise;
}

State Run::best_of_tracks(State input, State weighted, TurnLimit first) {
  State best = best_of_starts(input, weighted, first);
  if (input.bad == 0 || !options.may_slide) return best;
  for (Track& track : input.tracks) track = track == kFree ? kFree : kHeld;
  weighted.tracks = input.tracks;
  return better(std::move(best), best_of_starts(input, weighted, first));
}

void Run::find_weights(State& state) const {
  Draft draft = weights_of(state.mesh);
  for (double gamma = kFirstGamma; gamma > kLastGamma && state.bad > 0 && !must_stop(); gamma *= kSteepGamma) {
    DraftEnergy(draft, gamma).lower(kSteps, [this] { return must_stop(); });
    SurfaceMesh changed = state.mesh;
    for (const VertexId v : changed.vertices()) changed.set_weight(v, draft.points[v].w);
    take_if_better(state, std::move(changed));
  }
  if (state.bad == 0 || state.bad > kFewForPrograms || must_stop()) return;
  std::optional<SurfaceMesh> changed = with_margin(state.mesh, WeightGoal::elastic, options.margin);
  if (changed) take_if_better(state, *std::move(changed));
}

std::optional<SurfaceMesh> Run::with_margin(SurfaceMesh mesh, WeightGoal goal, double margin) const {
  WeightOptions request;
  request.goal = goal;
  request.from_input = true;
  request.margin = margin;
  request.constraints = constraints_of(options.criterion);
  request.must_stop = [this] { return must_stop(); };
  const auto found = surfaces::find_weights(mesh, solver, request);
  if (!found) return std::nullopt;
  for (const VertexId v : mesh.vertices()) mesh.set_weight(v, found->weights[v]);
  return mesh;
}

void Run::take_if_better(State& state, SurfaceMesh changed) const {
  const std::size_t left = bad(changed);
  if (left >= state.bad) return;
  state.mesh = std::move(changed);
  state.bad = left;
}

}  // namespace temper::surfaces
