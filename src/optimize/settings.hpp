// Options, checked and completed: what the driver and the vertex step read.
#pragma once

#include <cmath>
#include <optional>

#include "energy/accuracy_energy.hpp"
#include "optimize/frame.hpp"
#include "temper/optimize.hpp"

namespace temper {

/// The domain of the accuracy energy of a working copy: sizes at its vertices, floors of its triangles.
struct AccuracyDomain {
  VertexSizes sizes;
  AccuracyFloors floors;

  /// Raises the floors to what the mesh has now. True when that changes the barrier.
  bool raise_floors(const Mesh& mesh, const AccuracyModel& model, Executor* executor);
};

struct Settings {
  EnergyInfo energy;           ///< of the sweep under way
  EnergyModel model;           ///< the same, in the frame's units
  EnergyModel collapse_model;  ///< E_c
  AccuracyModel accuracy;      ///< of the second phase of Objective::accuracy; without unit
  /// Set while that energy is what sweeps lower; else it is that of `model`.
  const AccuracyDomain* accuracy_domain = nullptr;
  double relaxation = 1;  ///< of the sweep under way
  FlipLimit flip_limit = FlipLimit::unlimited;
  OptimizeOptions options;
  OptimizeHooks hooks;
  std::optional<SizeField> size_field;  ///< that a size band is around, in the user's units; absent without one
};

/// Makes sweeps lower that energy.
void set_energy(Settings& settings, EnergyKind kind);

/// Flips wait for the end of the inner iterations, so that edges may meanwhile not be regular.
[[nodiscard]] inline bool defers_flips(const OptimizeOptions& o) { return o.flips == Flips::deferred; }

/// A barrier prices every flip, so it needs no limit; HOT is continuous at a flip and may be led past one, a little.
[[nodiscard]] inline FlipLimit flip_limit_of(const OptimizeOptions& o, const EnergyInfo& energy) {
  if (o.flips == Flips::none) return FlipLimit::before;
  return o.paper.flip_limit.value_or(energy.barrier ? FlipLimit::unlimited : FlipLimit::after);
}

/// The unknowns that a sweep moves, counted from 0: weights from i_w on.
[[nodiscard]] inline Unknowns unknowns_of_sweep(const Settings& s, int sweep) {
  const OptimizeOptions& o = s.options;
  if (s.energy.positions_alone) return Unknowns::positions;
  return o.unknowns == Unknowns::positions_and_weights && sweep < o.paper.weights_from ? Unknowns::positions
                                                                                       : o.unknowns;
}

/// Says whether steps are Newton's, of a barrier, as far as they pay, with flips at once.
[[nodiscard]] inline bool makes_newton_steps(const Settings& s) {
  return s.energy.barrier && s.options.paper.solver == Solver::newton && s.options.flips == Flips::immediate &&
         s.flip_limit == FlipLimit::unlimited && s.options.paper.inversion == Inversion::refuse &&
         s.options.paper.position_updates == Updates::immediate;
}

/// Says whether something waits for the end of the sweep.
[[nodiscard]] inline bool defers_updates(const OptimizeOptions& o) {
  return o.paper.weight_updates == Updates::deferred || o.paper.position_updates == Updates::deferred;
}

/// The energy of the first sweeps, where it is another one.
[[nodiscard]] inline std::optional<EnergyKind> first_energy_of(const OptimizeOptions& o) {
  return o.paper.switch_at > 0 ? o.paper.first_energy : std::nullopt;
}

/// Says whether sweeps remove or insert vertices.
[[nodiscard]] inline bool changes_vertices(const OptimizeOptions& o) {
  return o.paper.collapse_from || o.paper.removal != Removal::none || o.paper.insertion_from;
}

/// The user's energy of one unit in the frame, of what sweeps lower.
[[nodiscard]] inline double energy_unit(const Settings& s, const Frame& frame) {
  constexpr double kAccuracyExponent = 2;
  return std::pow(frame.scale, s.accuracy_domain != nullptr ? kAccuracyExponent : s.energy.length_exponent);
}

/// The model with absolute γ and h° in the user's units of length.
[[nodiscard]] EnergyModel in_user_units(EnergyModel model, const Frame& frame);

/// Errors: values out of range, or that contradict each other.
[[nodiscard]] Expected<Settings> make_settings(const OptimizeOptions& options, const Mesh& mesh, const Frame& frame,
                                               const OptimizeHooks& hooks = {});

}  // namespace temper
