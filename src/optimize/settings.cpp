#include "optimize/settings.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "base/text.hpp"
#include "optimize/schedule.hpp"

namespace temper {
namespace {

constexpr double kMostMargin = 0.25;       // of h/ℓ an equilateral triangle has 0.289, and no other one as much
constexpr double kLeastBoundaryRatio = 2;  // a cut in the middle leaves edges of half the length

InputError invalid(const std::string& message) { return {ErrorCode::invalid_option, {}, message}; }

Softening in_frame(Softening s, const Frame& frame) {
  if (s.scale == LengthScale::absolute) s.value /= frame.scale;
  return s;
}

/// Switches that contradict each other.
std::optional<InputError> check_combinations(const OptimizeOptions& o) {
  if (o.paper.weight_updates == WeightUpdates::deferred && o.paper.solver == Solver::newton) {
    return invalid("deferred weight updates need positions and weights in turn; expected solver alternating or golden");
  }
  if (o.paper.weight_updates == WeightUpdates::deferred && o.flips == Flips::none) {
    return invalid("deferred weight updates cannot keep edges regular; expected flips to be allowed");
  }
  if (o.paper.inversion == Inversion::allow && !defers_flips(o)) {
    return invalid("inverted triangles are allowed, but edges cannot be flipped among them; expected deferred flips");
  }
  if (o.paper.inversion == Inversion::allow && o.boundary == BoundaryVertices::slide) {
    return invalid(
        "boundary vertices slide, but where triangles may be inverted nothing keeps them from passing a "
        "corner; expected inversions to be refused");
  }
  if (o.flips == Flips::none && o.boundary == BoundaryVertices::split) {
    return invalid("boundary edges are to be split, but the connectivity is to stay; expected flips to be allowed");
  }
  if (o.paper.inversion == Inversion::allow && o.size_band) {
    return invalid("inverted triangles are allowed, but they have no size; expected no size band");
  }
  return std::nullopt;
}

std::optional<InputError> check_accuracy(const OptimizeOptions& o, const EnergyInfo& energy) {
  if (o.objective != Objective::accuracy) return std::nullopt;
  if (!energy.barrier) {
    return invalid("objective accuracy begins with an energy that makes triangles well-centered, which " +
                   std::string(energy.name) + " does not; expected BP, BHs or BH");
  }
  if (o.paper.inversion == Inversion::allow) {
    return invalid(
        "inverted triangles are allowed, but objective accuracy needs well-centered ones; expected "
        "inversions to be refused");
  }
  const AccuracyOptions& a = o.accuracy;
  for (const auto& [what, weight] :
       {std::pair("offset weight", a.offset_weight), std::pair("boundary offset weight", a.boundary_offset_weight)}) {
    if (!(weight >= 0 && std::isfinite(weight))) {
      return invalid(std::string(what) + " is " + to_text(weight) + "; expected at least 0");
    }
  }
  if (!(a.margin > 0 && a.margin < kMostMargin)) {
    return invalid("margin is " + to_text(a.margin) + "; expected a number between 0 and 0.25");
  }
  if (!(a.barrier > 0 && std::isfinite(a.barrier))) {
    return invalid("barrier is " + to_text(a.barrier) + "; expected a positive number");
  }
  if (a.sweeps < 0) return invalid("accuracy sweeps is " + std::to_string(a.sweeps) + "; expected at least 0");
  if (!(a.tolerance >= 0)) return invalid("accuracy tolerance is " + to_text(a.tolerance) + "; expected at least 0");
  return std::nullopt;
}

AccuracyModel accuracy_model(const AccuracyOptions& a, Star star) {
  struct Factors {
    double alpha, beta;
  };
  constexpr Factors kFactors[] = {{1.0 / 4, 1.0 / 12}, {1.0 / 3, 1.0 / 3}, {1.0 / 12, 1.0 / 4}, {2.0 / 3, 2.0 / 3}};
  const auto [alpha, beta] = kFactors[static_cast<std::size_t>(star)];
  AccuracyModel model = AccuracyModel::of(alpha, beta, a.offset_weight, a.boundary_offset_weight);
  model.margin = a.margin;
  model.barrier = a.barrier;
  return model;
}

std::optional<InputError> check(const OptimizeOptions& o, const Mesh& mesh) {
  if (o.paper.gamma && !(o.paper.gamma->value > 0 && std::isfinite(o.paper.gamma->value))) {
    return invalid("gamma is " + to_text(o.paper.gamma->value) + "; expected a positive number");
  }
  if (o.paper.h0 && !(o.paper.h0->value >= 0 && std::isfinite(o.paper.h0->value))) {
    return invalid("h0 is " + to_text(o.paper.h0->value) + "; expected −h° ≥ 0");
  }
  if (o.paper.relaxation && !(*o.paper.relaxation > 0 && *o.paper.relaxation < 2)) {
    return invalid("relaxation is " + to_text(*o.paper.relaxation) + "; expected a number between 0 and 2");
  }
  if (!(o.paper.overshoot >= 1 && std::isfinite(o.paper.overshoot))) {
    return invalid("overshoot is " + to_text(o.paper.overshoot) + "; expected at least 1");
  }
  if (!(o.paper.tolerance >= 0)) return invalid("tolerance is " + to_text(o.paper.tolerance) + "; expected at least 0");
  if (!(o.time_limit >= 0)) return invalid("time limit is " + to_text(o.time_limit) + "; expected at least 0");
  if (o.max_sweeps < 0) return invalid("max sweeps is " + std::to_string(o.max_sweeps) + "; expected at least 0");
  if (o.paper.weights_from < 0)
    return invalid("weights from is " + std::to_string(o.paper.weights_from) + "; expected at least 0");
  if (o.repair_trials < 0) {
    return invalid("repair trials is " + std::to_string(o.repair_trials) + "; expected at least 0");
  }
  if (o.paper.inner < 0) return invalid("inner is " + std::to_string(o.paper.inner) + "; expected at least 0");
  if (o.paper.outer < 0) return invalid("outer is " + std::to_string(o.paper.outer) + "; expected at least 0");
  if (o.paper.collapse_from && *o.paper.collapse_from < 0) {
    return invalid("collapse from is " + std::to_string(*o.paper.collapse_from) + "; expected at least 0");
  }
  if (!(o.paper.collapse_ratio > 0 && o.paper.collapse_ratio < 1)) {
    return invalid("collapse ratio is " + to_text(o.paper.collapse_ratio) + "; expected a number between 0 and 1");
  }
  if (!(o.paper.removal_margin >= 0 && std::isfinite(o.paper.removal_margin))) {
    return invalid("removal margin is " + to_text(o.paper.removal_margin) + "; expected at least 0");
  }
  if (!(o.boundary_ratio >= kLeastBoundaryRatio && std::isfinite(o.boundary_ratio))) {
    return invalid("boundary ratio is " + to_text(o.boundary_ratio) + "; expected at least 2");
  }
  if (o.paper.removal_from < 0)
    return invalid("removal from is " + std::to_string(o.paper.removal_from) + "; expected at least 0");
  if (o.star == Star::all && o.objective == Objective::energy) {
    return invalid("star is all, which is of objective accuracy; of an energy expected 0, 1 or 2");
  }
  if (auto error = check_combinations(o)) return error;
  if (o.size_band && !(*o.size_band >= 1)) {
    return invalid("size band is " + to_text(*o.size_band) + "; expected a factor of at least 1");
  }
  if (o.paper.anchor.valid() && o.paper.anchor.index >= mesh.n_vertices()) {
    return invalid("anchor is vertex " + std::to_string(o.paper.anchor.index) + ", but the mesh has " +
                   std::to_string(mesh.n_vertices()) + " vertices");
  }
  return std::nullopt;
}

}  // namespace

OptimizeOptions paper_method() {
  OptimizeOptions o;
  o.paper.gamma = Softening{1, LengthScale::absolute};
  o.paper.solver = Solver::golden;
  o.flips = Flips::deferred;
  o.paper.inner = 0;
  o.paper.flip_limit = FlipLimit::unlimited;
  o.paper.inversion = Inversion::allow;
  o.paper.hidden = HiddenPolicy::keep;
  o.paper.order = SweepOrder::input;
  o.paper.anchor = VertexId(0);
  o.paper.collapse_from = 0;
  o.paper.removal = Removal::patch;
  o.paper.removal_measure = RemovalMeasure::sum;
  o.paper.removal_margin = 0;
  o.paper.removal_from = 0;
  o.repair = Repair::none;
  o.paper.stopping = StoppingRule::paper;
  o.paper.tolerance = 1e-6;
  return o;
}

EnergyModel in_user_units(EnergyModel model, const Frame& frame) {
  for (Softening* s : {&model.gamma, &model.h0}) {
    if (s->scale == LengthScale::absolute) s->value *= frame.scale;
  }
  return model;
}

Expected<Settings> make_settings(const OptimizeOptions& options, const Mesh& mesh, const Frame& frame,
                                 const OptimizeHooks& hooks) {
  const EnergyInfo& energy = energy_info(options.energy);
  if (auto error = check(options, mesh)) return *std::move(error);
  if (auto error = check_accuracy(options, energy)) return *std::move(error);

  const EnergyInfo& collapse_energy = energy_info(options.paper.collapse_energy);
  if (collapse_energy.barrier) {
    return invalid("collapse energy is " + std::string(collapse_energy.name) +
                   ", a barrier, which keeps edges from collapsing; expected F, T or dT");
  }

  const Star star = options.objective == Objective::accuracy ? Star::one : options.star;
  Settings s;
  s.collapse_model.kind = collapse_energy.kind;
  s.collapse_model.star = star;
  s.collapse_model.boundary = options.paper.boundary_treatment;
  s.energy = energy;
  s.options = options;
  s.hooks = hooks;
  s.accuracy = accuracy_model(options.accuracy, options.star);
  s.relaxation = options.paper.relaxation.value_or(kRelaxation);
  s.model.kind = energy.kind;
  s.model.star = star;
  s.model.boundary = options.paper.boundary_treatment;
  if (options.paper.gamma) s.model.gamma = in_frame(*options.paper.gamma, frame);
  if (options.paper.h0) s.model.h0 = in_frame(*options.paper.h0, frame);
  // A barrier prices every flip, so it needs no limit; HOT is continuous at a flip and may be led past one, a little.
  s.flip_limit = options.paper.flip_limit.value_or(energy.barrier ? FlipLimit::unlimited : FlipLimit::after);
  if (options.flips == Flips::none) s.flip_limit = FlipLimit::before;
  return s;
}

}  // namespace temper
