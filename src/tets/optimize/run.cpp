#include "tets/optimize/run.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>

#include "base/text.hpp"
#include "optimize/run/changes.hpp"
#include "optimize/run/end_of_run.hpp"
#include "tets/mesh/tables.hpp"
#include "tets/optimize/hot_sweeps.hpp"
#include "tets/optimize/mobility.hpp"
#include "tets/optimize/violations.hpp"
#include "tets/quality/measure.hpp"

namespace temper::tets {

/// Counts what differs from the input. `numbers`: as in EndOfRun, none is empty.
static ChangeCounts changes_from(const TetMesh& input, const TetMesh& mesh,
                                 const IdVector<VertexId, VertexId>& numbers) {
  ChangeCounts counts = changed_vertices(
      input, mesh, numbers, [&](VertexId v, VertexId was) { return !(mesh.position(v) == input.position(was)); });
  const EdgeTable before(input, nullptr), after(mesh, nullptr);
  for (const VertexId v : mesh.vertices()) {
    for (const VertexId u : after.greater(v)) {
      const bool is_old = std::max(numbers[v], numbers[u]).index < input.n_vertices();
      counts.edges_changed += is_old && before.find(numbers[v], numbers[u]) ? 0 : 1;
    }
  }
  return counts;
}

namespace {

// No dihedral angle becomes less than about 0.8 of the least one: 1 − cosine falls to this part of it at most. A
// smaller angle is told.
constexpr double kAngleKept = 0.7, kLeastAngleKept = 0.8;
// Of a cosine whose corners are in another order.
constexpr double kRounding = 1e-12;

/// The model of errors, if this run and mesh have one.
const DiscretizationError* model_of(const TetMesh& mesh, const OptimizeOptions& options, const OptimizeHooks& hooks) {
  const bool may_have =
      options.change == Change::all && mesh.n_vertices() <= static_cast<std::size_t>(options.tets.most_error_vertices);
  return may_have ? hooks.solvers.error.get() : nullptr;
}

std::string smaller_angle_note(double before, double after) {
  return "the least dihedral angle fell from " + rounded(before) + " to " + rounded(after) +
         " degrees, where the target could not be met otherwise. Next: `guard_angle=" +
         rounded(kLeastAngleKept * before, 3) + "` keeps it above this angle";
}

}  // namespace

Run::Run(TetMesh& mesh, const OptimizeOptions& options, const OptimizeHooks& hooks, std::span<const VertexId> frozen)
    : RunOf(options, hooks),
      result_(mesh),
      has_frozen_(!frozen.empty()),
      errors_({model_of(mesh, options, hooks), {}, options.scheme == Scheme::vertex}),
      criterion_(lowers_hot(options) ? Criterion::well_centered : criterion_of(options.scheme)),
      hot_(kHotEnergies[static_cast<std::size_t>(options.star)]),
      draft_(mesh, mobilities(mesh, options, frozen)),
      cosine_before_(largest_dihedral_cosine(mesh, hooks.executor)),
      most_cosine_(limit_of_angles()) {
  best_.kept.emplace(std::move(mesh), draft_.mobility);
  begin_sweeps();
  objective_before_ = objective_of(draft_.mesh);
  if (errors_.model != nullptr) errors_.unit = errors_.model->errors(draft_.mesh);
  record();
  if (changes_least() || ((errors_.model != nullptr || lowers_hot(options_)) && best_bad_ == 0)) input_ = draft_;
}

double Run::limit_of_angles() const {
  if (!guards_angles()) return 1 - kAngleKept * (1 - cosine_before_);
  return std::max(std::cos(std::numbers::pi / 180 * options_.guard.angle), cosine_before_) + kRounding;
}

double Run::objective_of(const TetMesh& mesh) const {
  return lowers_hot(options_) ? hot_energy(mesh, hot_, hooks_.executor)
                              : state_of(mesh, kLastGamma, hooks_.executor).energy;
}

double Run::error_ratio_of(const TetMesh& mesh) const {
  if (errors_.unit.empty()) return 0;
  const std::vector<double> errors = errors_.model->errors(mesh);
  return errors.empty() ? HUGE_VAL : errors_.mean_ratio(errors);
}

bool Run::is_stopped(double fraction) {
  ask(fraction, [](Progress&) {});
  return stopped_early();
}

void Run::record(bool takes_equal) {
  const auto [energy, bad] = state_of(draft_, criterion_, gamma_, hooks_.executor);
  keep_if_best(static_cast<double>(bad), takes_equal);
  best_bad_ = static_cast<std::size_t>(best_.measure);
  if (!stopped_early()) RunOf::record({.energy = energy, .bad = bad, .length_parameter = gamma_});
}

void Run::end_round(bool takes_equal) {
  gamma_ = kLastGamma;
  if (!stopped_early()) ++report.sweeps;
  record(takes_equal);
}

void Run::record(Objective objective, double energy) {
  RunOf::record({.energy = energy, .bad = best_bad_, .objective = objective});
}

void Run::keep_if_best(double measure, bool takes_equal) {
  if (!best_.is_beaten_by(measure, takes_equal)) return;
  if (guards_angles() && largest_dihedral_cosine(draft_.mesh, hooks_.executor) > most_cosine_) return;
  best_.kept = draft_;  // in its memory
  best_.measure = measure;
  if (!report.history.empty())
    offer([this](const std::function<void(const BestSoFar&)>& use) {
      use({best_.kept->mesh, origins_of(*best_.kept)});
    });
}

/// Says whether a good input has a smaller error of some kind than the best mesh.
bool Run::is_input_better() const {
  if (input_.mesh.n_vertices() == 0 || errors_.unit.empty() || stopped_early()) return false;
  const std::vector<double> errors = errors_.model->errors(best_.kept->mesh);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (errors[i] > errors_.unit[i]) return true;
  }
  return errors.empty();
}

OptimizeReport Run::end() {
  const bool returns_input = is_input_better();
  if (returns_input) best_.kept = input_;
  Draft best = *std::move(best_.kept);
  report.flips = best.flips;
  report.origins = origins_of(best);
  const std::vector<SweepRecord>& history = report.history;
  const std::size_t least_bad = std::ranges::min(history, {}, &SweepRecord::bad).bad;  // whose mesh is the best
  const EndOfRun<TetMesh> compared = {changes_least() ? &input_.mesh : nullptr,
                                      best.mesh,
                                      best.names.vertices,
                                      n_before_,
                                      history.back().objective,
                                      {objective_before_, history[0].bad},
                                      {objective_of(best.mesh), least_bad}};
  complete(report, compared);
  add_notes(best.mesh, returns_input);
  result_ = std::move(best.mesh);
  return take_report();
}

void Run::add_notes(const TetMesh& mesh, bool returns_input) {
  std::vector<std::string>& notes = report.notes;
  if (places_left_ > 0)
    notes.push_back(whole_mesh_note(count_of(places_left_, "tetrahedron", "tetrahedra"), many_are_bad_));
  const bool was_good = !report.history.empty() && report.history[0].bad == 0;
  if (changes_least()) notes.push_back(was_good ? criterion_is_met_note(criterion_) : changes_note(*report.changed));
  if (returns_input)
    notes.emplace_back("the input has all that the target needs, and changes made errors larger: it comes back");
  const auto angle = [](double cosine) { return 180 / std::numbers::pi * std::acos(cosine); };
  const double before = angle(cosine_before_), after = angle(largest_dihedral_cosine(mesh, hooks_.executor));
  if (after < kLeastAngleKept * before) notes.push_back(smaller_angle_note(before, after));
}

Origins Run::origins_of(const Draft& draft) const {
  const auto is_of_input = [this](VertexId name) { return name.index < n_before_; };
  const auto& names = draft.names.vertices;
  if (names.size() == n_before_ && std::all_of(names.begin(), names.end(), is_of_input)) return {};
  Origins origins = {names, draft.names.faces, draft.names.lines};
  for (VertexId& v : origins.vertices) {
    if (!is_of_input(v)) v = {};
  }
  return origins;
}

}  // namespace temper::tets
