// Options, checked and completed. Settings are constant once they are made; what changes from sweep to sweep is the
// SweepState.
#pragma once

#include <memory>
#include <optional>

#include "energy/accuracy_energy.hpp"
#include "optimize/working/working_units.hpp"
#include "temper/feasibility.hpp"
#include "temper/optimize.hpp"

namespace temper {

/// The paper's switches of a run, and the questions about them that the driver and the steps ask.
struct Policy : PaperSwitches {
  Flips flips = Flips::immediate;

  Policy() = default;
  explicit Policy(const OptimizeOptions& options);

  [[nodiscard]] bool flips_at_once() const { return flips == Flips::immediate; }
  /// They wait for the end of the inner iterations.
  [[nodiscard]] bool defers_flips() const { return flips == Flips::deferred; }
  [[nodiscard]] bool keeps_connectivity() const { return flips == Flips::none; }

  [[nodiscard]] bool allows_inversion() const { return inversion == Inversion::allow; }
  /// Steps end before a triangle turns over.
  [[nodiscard]] bool refuses_inversion() const { return inversion == Inversion::refuse; }

  /// A step that hides a vertex is undone.
  [[nodiscard]] bool undoes_hidden() const { return hidden == HiddenPolicy::undo; }
  /// Hidden vertices stay in the mesh, so edges around them may be not regular.
  [[nodiscard]] bool keeps_hidden() const { return hidden == HiddenPolicy::keep; }
  [[nodiscard]] bool removes_hidden() const { return hidden == HiddenPolicy::remove; }
  /// Sweeps remove or insert vertices.
  [[nodiscard]] bool changes_vertices() const { return collapse_from || removal != Removal::none || insertion_from; }

  [[nodiscard]] bool defers_positions() const { return position_updates == Updates::deferred; }
  [[nodiscard]] bool defers_weights() const { return weight_updates == Updates::deferred; }
  [[nodiscard]] bool defers_updates() const { return defers_positions() || defers_weights(); }

  /// Newton steps, each seen at once, without triangles turned over.
  [[nodiscard]] bool makes_newton_steps() const {
    return solver == Solver::newton && flips_at_once() && refuses_inversion() && !defers_positions();
  }
  /// Every sweep leaves all edges regular that may be flipped.
  [[nodiscard]] bool keeps_regular() const { return flips_at_once() && !keeps_hidden(); }
  /// A mesh with every triangle counter-clockwise and every free edge regular comes out of each sweep.
  [[nodiscard]] FlipLimit flip_limit_for(const EnergyInfo& energy) const;
};

/// Over-relaxation once γ has settled.
inline constexpr double kRelaxation = 1.7;

struct Settings {
  OptimizeOptions options;
  OptimizeHooks hooks;
  Objective objective = Objective::accuracy;  ///< that this run lowers
  Policy policy;                              ///< the paper's switches
  EnergyModel model;                          ///< of options.energy, in the units's units, as sweeps begin
  EnergyModel collapse_model;                 ///< E_c
  AccuracyModel accuracy;                     ///< of the accuracy objective; without unit
  std::shared_ptr<const DiscretizationError>
      errors{};                             ///< errors of the solver: lowered, or the judge of meshes; or null
  bool lacks_discretization_error = false;  ///< the build has none, and the run would have used it
  std::shared_ptr<LpSolver> lp{};           ///< for repairs, or null
  std::optional<SizeField> size_field{};    ///< of the size band, in the user's units; absent without a band

  [[nodiscard]] const EnergyInfo& energy() const { return energy_info(model.kind); }
  [[nodiscard]] Executor* executor() const { return hooks.executor; }
};

/// What the sweep under way lowers, and how far its steps go.
struct SweepState {
  EnergyInfo energy;      ///< that of `model`
  EnergyModel model;      ///< in the units's units, with γ and h° of the sweep
  double relaxation = 1;  ///< over-relaxation of Newton steps
  FlipLimit flip_limit = FlipLimit::unlimited;
  const AccuracyDomain* accuracy_domain = nullptr;  ///< if sweeps lower the accuracy objective: where it is finite

  /// Of the first sweep for options.energy.
  explicit SweepState(const Settings& settings);
  /// Lowers that energy from now on.
  void set_energy(EnergyKind kind, const Policy& policy);
  /// The user's energy of one unit in the units.
  [[nodiscard]] double energy_unit(const WorkingUnits& units) const;
};

/// The unknowns that a sweep moves, counted from 0: weights from i_w on.
[[nodiscard]] Unknowns unknowns_of_sweep(const Settings& settings, const EnergyInfo& energy, int sweep);

/// The model with absolute γ and h° in the user's units of length.
[[nodiscard]] EnergyModel in_user_units(EnergyModel model, const WorkingUnits& units);

/// Errors: values out of range, or that contradict each other.
[[nodiscard]] Expected<Settings> make_settings(const OptimizeOptions& options, const Mesh& mesh,
                                               const WorkingUnits& units, const OptimizeHooks& hooks = {});

}  // namespace temper
