#include "optimize/settings.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "optimize/schedule.hpp"
#include "temper/optimize_table.hpp"

namespace temper {
namespace {

InputError invalid(const std::string& message) { return {ErrorCode::invalid_option, {}, message}; }

Softening in_frame(Softening s, const Frame& frame) {
  if (s.scale == LengthScale::absolute) s.value /= frame.scale;
  return s;
}

/// Options that contradict each other.
std::optional<InputError> check_combinations(const OptimizeOptions& o) {
  const PaperSwitches& p = o.paper;
  if (o.star == Star::all && o.objective == Objective::energy) {
    return invalid("`star=all` is for `objective=accuracy`; of an energy expected 0, 1 or 2");
  }
  if (p.weight_updates == WeightUpdates::deferred && p.solver == Solver::newton) {
    return invalid(
        "deferred weight updates need positions and weights in turn; expected `solver=alternating` or `solver=golden`");
  }
  if (p.weight_updates == WeightUpdates::deferred && o.flips == Flips::none) {
    return invalid(
        "`weight_updates=deferred` keeps edges regular by flips alone; expected `flips=immediate` or `flips=deferred`");
  }
  if (p.inversion == Inversion::allow && !defers_flips(o)) {
    return invalid(
        "`inversion=allow` needs `flips=deferred`, since edges cannot be flipped among inverted triangles; or "
        "`inversion=refuse`");
  }
  if (p.inversion == Inversion::allow && o.boundary == BoundaryVertices::slide) {
    return invalid(
        "`boundary=slide` needs `inversion=refuse`: where triangles may be inverted nothing keeps vertices from "
        "passing a "
        "corner");
  }
  if (o.flips == Flips::none && o.boundary == BoundaryVertices::split) {
    return invalid(
        "`boundary=split` changes the connectivity, which `flips=none` keeps; expected `flips=immediate` or "
        "`flips=deferred`");
  }
  if (p.inversion == Inversion::allow && o.size_band) {
    return invalid("`size_band` needs `inversion=refuse`: inverted triangles have no size");
  }
  return std::nullopt;
}

/// What the accuracy objective cannot do with.
std::optional<InputError> check_accuracy(const OptimizeOptions& o) {
  if (o.objective != Objective::accuracy) return std::nullopt;
  const EnergyInfo& energy = energy_info(o.energy);
  if (!energy.barrier) {
    return invalid("`objective=accuracy` begins with an energy that makes triangles well-centered, which " +
                   std::string(energy.name) + " does not; expected `energy=BP`, `energy=BHs` or `energy=BH`");
  }
  if (o.paper.inversion == Inversion::allow) {
    return invalid("`objective=accuracy` needs `inversion=refuse`: its second phase is for well-centered triangles");
  }
  return std::nullopt;
}

std::optional<InputError> check_anchor(VertexId anchor, const Mesh& mesh) {
  if (!anchor.valid() || anchor.index < mesh.n_vertices()) return std::nullopt;
  return invalid("`anchor` is vertex " + std::to_string(anchor.index) + ", but the mesh has " +
                 std::to_string(mesh.n_vertices()) + " vertices");
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
  if (auto right = check_options(options); !right) return right.error();
  if (auto error = check_combinations(options)) return *std::move(error);
  if (auto error = check_accuracy(options)) return *std::move(error);
  if (auto error = check_anchor(options.paper.anchor, mesh)) return *std::move(error);

  const EnergyInfo& energy = energy_info(options.energy);
  const Star star = options.objective == Objective::accuracy ? Star::one : options.star;
  Settings s;
  s.collapse_model.kind = options.paper.collapse_energy;
  s.collapse_model.star = star;
  s.collapse_model.boundary_treatment = options.paper.boundary_treatment;
  s.energy = energy;
  s.options = options;
  s.hooks = hooks;
  s.accuracy = accuracy_model(options.accuracy, options.star);
  s.relaxation = options.paper.relaxation.value_or(kRelaxation);
  s.model.kind = energy.kind;
  s.model.star = star;
  s.model.boundary_treatment = options.paper.boundary_treatment;
  if (options.paper.gamma) s.model.gamma = in_frame(*options.paper.gamma, frame);
  if (options.paper.h0) s.model.h0 = in_frame(*options.paper.h0, frame);
  s.flip_limit = flip_limit_of(options);
  return s;
}

}  // namespace temper
