#include "optimize/settings.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/text.hpp"
#include "geometry/triangle_kernel.hpp"

namespace temper {
namespace {

// γ/ℓ by default: measured on public meshes; larger ones leave triangles bad, smaller ones start too stiff.
constexpr double kGammaStart = 0.5, kGammaFactor = 0.7, kGammaFloor = 0.003;
// −h°/ℓ by default: this much beyond the worst h/ℓ of the mesh, so that every term is finite from the start.
constexpr double kShiftMargin = 1.25;

InputError invalid(const std::string& message) { return {ErrorCode::invalid_option, {}, message}; }

/// The least h/ℓ, 0.5 at most, over all edges of all triangles.
double least_relative_height(const Mesh& mesh) {
  double least = kGammaStart;
  for (const TriangleId t : mesh.triangles()) {
    const auto [p, q, r] = mesh.corners(t);
    for (const EdgeShape& e : triangle_shape(mesh.point(p), mesh.point(q), mesh.point(r)).edges) {
      least = std::min(least, e.g / e.l2);
    }
  }
  return least;
}

Softening in_frame(Softening s, const Frame& frame) {
  if (s.scale == LengthScale::absolute) s.value /= frame.scale;
  return s;
}

std::optional<InputError> check(const OptimizeOptions& o, const Mesh& mesh) {
  if (o.star < 0 || o.star > 2) return invalid("star is " + std::to_string(o.star) + "; expected 0, 1 or 2");
  if (o.gamma && !(o.gamma->value > 0 && std::isfinite(o.gamma->value))) {
    return invalid("gamma is " + to_text(o.gamma->value) + "; expected a positive number");
  }
  if (o.h0 && !(o.h0->value >= 0 && std::isfinite(o.h0->value))) {
    return invalid("h0 is " + to_text(o.h0->value) + "; expected −h° ≥ 0");
  }
  if (!(o.relaxation > 0 && o.relaxation < 2)) {
    return invalid("relaxation is " + to_text(o.relaxation) + "; expected a number between 0 and 2");
  }
  if (!(o.overshoot >= 1 && std::isfinite(o.overshoot))) {
    return invalid("overshoot is " + to_text(o.overshoot) + "; expected at least 1");
  }
  if (!(o.tolerance >= 0)) return invalid("tolerance is " + to_text(o.tolerance) + "; expected at least 0");
  if (!(o.time_limit >= 0)) return invalid("time limit is " + to_text(o.time_limit) + "; expected at least 0");
  if (o.max_sweeps < 0) return invalid("max sweeps is " + std::to_string(o.max_sweeps) + "; expected at least 0");
  if (o.weights_from < 0) return invalid("weights from is " + std::to_string(o.weights_from) + "; expected at least 0");
  if (o.anchor && *o.anchor >= mesh.n_vertices()) {
    return invalid("anchor is vertex " + std::to_string(*o.anchor) + ", but the mesh has " +
                   std::to_string(mesh.n_vertices()) + " vertices");
  }
  return std::nullopt;
}

}  // namespace

Softening SofteningSchedule::at(int sweep) const {
  return {std::max(floor, start.value * std::pow(factor, sweep)), start.scale};
}

EnergyModel in_user_units(EnergyModel model, const Frame& frame) {
  for (Softening* s : {&model.gamma, &model.h0}) {
    if (s->scale == LengthScale::absolute) s->value *= frame.scale;
  }
  return model;
}

Softening next_h0(const Mesh& mesh, Softening present) {
  const double beyond_worst = -kShiftMargin * least_relative_height(mesh);
  return {std::min(present.value, std::max({kGammaFloor, kGammaFactor * present.value, beyond_worst})),
          LengthScale::relative};
}

Expected<Settings> make_settings(const OptimizeOptions& options, const Mesh& mesh, const Frame& frame) {
  const auto energy = find_energy(options.energy);
  if (!energy) return energy.error();
  if (auto error = check(options, mesh)) return *std::move(error);

  Settings s;
  s.energy = *energy;
  s.options = options;
  const double least = least_relative_height(mesh);
  if (options.gamma) {
    s.gamma = {in_frame(*options.gamma, frame), 1, 0};
  } else if (least > 0) {
    s.gamma = {{kGammaFloor, LengthScale::relative}, 1, kGammaFloor};  // already inside: no need to soften first
  } else {
    s.gamma = {{kGammaStart, LengthScale::relative}, kGammaFactor, kGammaFloor};
  }
  s.h0_follows_mesh = !options.h0;
  const Softening h0 = options.h0 ? in_frame(*options.h0, frame)
                                  : Softening{std::max(kGammaFloor, -kShiftMargin * least), LengthScale::relative};
  s.model = {energy->kind, options.star, options.boundary, s.gamma.at(0), h0};
  // A barrier prices every flip, so it needs no limit; HOT is continuous at a flip and may be led past one, a little.
  s.flip_limit = options.flip_limit.value_or(energy->barrier ? FlipLimit::unlimited : FlipLimit::after);
  if (!options.flips) s.flip_limit = FlipLimit::before;
  return s;
}

}  // namespace temper
