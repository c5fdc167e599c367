// Options, checked and completed. Settings never change; SweepState has what changes from sweep to sweep.
#pragma once

#include <memory>
#include <optional>

#include "energy/accuracy_energy.hpp"
#include "optimize/working/working_units.hpp"
#include "temper/detail/cell_kinds.hpp"
#include "temper/detail/criterion.hpp"
#include "temper/feasibility.hpp"
#include "temper/optimize.hpp"

namespace temper {

struct GuardLimits;

/// The paper's switches of a run, and what follows from them for the driver and the steps.
struct Policy : PaperSwitches {
  Flips flips = Flips::immediate;

  Policy() = default;
  explicit Policy(const OptimizeOptions& options);

  [[nodiscard]] bool flips_at_once() const { return flips == Flips::immediate; }
  /// Flips wait for the end of the inner iterations.
  [[nodiscard]] bool defers_flips() const { return flips == Flips::deferred; }
  [[nodiscard]] bool keeps_connectivity() const { return flips == Flips::none; }

  [[nodiscard]] bool allows_inversion() const { return inversion == Inversion::allow; }
  /// Steps end before a triangle turns over.
  [[nodiscard]] bool refuses_inversion() const { return inversion == Inversion::refuse; }

  /// A step that hides a vertex is undone.
  [[nodiscard]] bool undoes_hidden() const { return hidden == HiddenPolicy::undo; }
  /// Hidden vertices stay in the mesh, so edges around them may not be regular.
  [[nodiscard]] bool keeps_hidden() const { return hidden == HiddenPolicy::keep; }
  [[nodiscard]] bool removes_hidden() const { return hidden == HiddenPolicy::remove; }
  /// Sweeps remove or insert vertices.
  [[nodiscard]] bool changes_vertices() const { return collapse_from || removal != Removal::none || insertion_from; }

  [[nodiscard]] bool defers_positions() const { return position_updates == Updates::deferred; }
  [[nodiscard]] bool defers_weights() const { return weight_updates == Updates::deferred; }
  [[nodiscard]] bool defers_updates() const { return defers_positions() || defers_weights(); }

  /// Newton steps take effect at once and turn no triangle over.
  [[nodiscard]] bool makes_newton_steps() const {
    return solver == Solver::newton && flips_at_once() && refuses_inversion() && !defers_positions();
  }
  /// After every sweep, all edges that may be flipped are regular.
  [[nodiscard]] bool keeps_regular() const { return flips_at_once() && !keeps_hidden(); }
  /// Returns how far a step may go past a flip when sweeps lower this energy.
  [[nodiscard]] FlipLimit flip_limit_for(const EnergyInfo& energy) const;
};

/// Over-relaxation once γ has settled.
inline constexpr double kRelaxation = 1.7;

/// A sweep of the barrier that gains less than this part of the energy leaves the rest to the accuracy phase, whose own
/// barrier goes on with thin triangles. With 1e-3 they stay thinner, by a fifth on osteonT1.
inline constexpr double kGainOfLastSweep = 1e-4;

/// Says whether a run on a small mesh of the plane may lower the error of the solver.
[[nodiscard]] bool may_lower_solver_error(const OptimizeOptions& o);

/// Returns the largest number of steps for the error of the solver. The user's own problem has one right-hand side: it
/// needs more steps, and each takes less time.
[[nodiscard]] inline int most_solver_error_steps(const OptimizeOptions& o) {
  return o.solver_error.steps * (o.problem ? 10 : 1);
}

struct Settings {
  OptimizeOptions options;
  OptimizeHooks hooks;
  Objective objective = Objective::accuracy;  ///< of this run
  Policy policy;                              ///< the paper's switches
  EnergyModel model;                          ///< of options.energy at the first sweep, in working units
  EnergyModel collapse_model;                 ///< E_c
  AccuracyModel accuracy;                     ///< of the accuracy objective; has no unit
  std::shared_ptr<const DiscretizationError>
      errors{};  ///< errors of the solver, to be lowered or to compare meshes; or null
  /// The criterion that ends the run: the target's, if the least may change, or if the mesh keeps faces. Sites around
  /// faces stay, and triangles next to them may have no room to become well-centered.
  Criterion criterion = Criterion::well_centered;
  bool in_metric = false;                      ///< the mesh is in the plane of a tensor's metric
  bool lacks_discretization_error = false;     ///< the run would use `errors`, but the build has none
  std::shared_ptr<LpSolver> lp{};              ///< for repairs, or null
  std::shared_ptr<const GuardLimits> guard{};  ///< of steps and of the judge, or null
  bool in_copy = false;                        ///< sweeps work on a copy of a few triangles (repair/local_copy.hpp)
  double worst_violation = kInfinity;          ///< of the input's triangles (judge.hpp): no result has a worse one
  std::optional<SizeField> size_field{};       ///< of the size band, in the user's units; absent without a band

  [[nodiscard]] const EnergyInfo& energy() const { return energy_info(model.kind); }
  [[nodiscard]] Executor* executor() const { return hooks.executor; }
  [[nodiscard]] bool changes_least() const { return options.change == Change::least; }
  /// Says whether violations of the criterion count before triangles that are not well-centered.
  [[nodiscard]] bool counts_violations() const { return changes_least() || criterion != Criterion::well_centered; }
};

/// The energy that the present sweep lowers, and how far its steps go.
struct SweepState {
  EnergyInfo energy;      ///< the kind of `model`
  EnergyModel model;      ///< in working units, with γ and h° of the sweep
  double relaxation = 1;  ///< over-relaxation of Newton steps
  FlipLimit flip_limit = FlipLimit::unlimited;
  const AccuracyDomain* accuracy_domain = nullptr;  ///< domain of the accuracy objective, if sweeps lower it

  /// The state of the first sweep for options.energy.
  explicit SweepState(const Settings& settings);
  /// Makes later sweeps lower this energy.
  void set_energy(EnergyKind kind, const Policy& policy);
  /// Returns one working unit of energy in the user's units.
  [[nodiscard]] double energy_unit(const WorkingUnits& units) const;
};

/// Returns the unknowns of a sweep, counted from 0; weights are unknowns from sweep i_w on.
[[nodiscard]] Unknowns unknowns_of_sweep(const Settings& settings, const EnergyInfo& energy, int sweep);

/// Returns the factors of the accuracy energy for a scheme.
[[nodiscard]] AccuracyModel accuracy_model(const AccuracyOptions& options, Scheme scheme, Star star);

/// Returns the model with absolute γ and h° in the user's units of length.
[[nodiscard]] EnergyModel in_user_units(EnergyModel model, const WorkingUnits& units);

/// Returns an error if values are out of range or contradict each other, for a mesh of these cells.
[[nodiscard]] Expected<void> check_together(const OptimizeOptions& options, CellKinds cells);

/// It fails if values are out of range or contradict each other.
[[nodiscard]] Expected<Settings> make_settings(const OptimizeOptions& options, const Mesh& mesh,
                                               const WorkingUnits& units, const OptimizeHooks& hooks = {});

}  // namespace temper
