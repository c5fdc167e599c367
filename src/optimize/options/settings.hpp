// Options, checked and completed. Settings are constant once they are made; what changes from sweep to sweep is the
// SweepState.
#pragma once

#include <memory>
#include <optional>

#include "energy/accuracy_energy.hpp"
#include "optimize/working/frame.hpp"
#include "temper/feasibility.hpp"
#include "temper/optimize.hpp"

namespace temper {

// The paper's switches, compiled once for a run: absent values have their value, and each question that the driver and
// the steps ask has its answer.

struct Policy : PaperSwitches {
  // What flips do.
  bool flips_at_once = true;        ///< Flips::immediate
  bool defers_flips = false;        ///< they wait for the end of the inner iterations
  bool keeps_connectivity = false;  ///< Flips::none

  // What may become of vertices and triangles.
  bool allows_inversion = false;  ///< triangles may turn over
  bool refuses_inversion = true;  ///< steps end before a triangle turns over
  bool undoes_hidden = true;      ///< a step that hides a vertex is undone
  bool keeps_hidden = false;      ///< hidden vertices stay in the mesh, so edges around them may be not regular
  bool removes_hidden = false;
  bool changes_vertices = false;  ///< sweeps remove or insert vertices

  // When updates are seen.
  bool defers_positions = false, defers_weights = false;
  [[nodiscard]] bool defers_updates() const { return defers_positions || defers_weights; }

  /// Newton steps, each seen at once, without triangles turned over.
  bool makes_newton_steps = true;
  /// Every sweep leaves all edges regular that may be flipped.
  [[nodiscard]] bool keeps_regular() const { return flips_at_once && !keeps_hidden; }
  /// A mesh with every triangle counter-clockwise and every free edge regular comes out of each sweep.
  [[nodiscard]] FlipLimit flip_limit_for(const EnergyInfo& energy) const;

  Policy() = default;
  explicit Policy(const OptimizeOptions& options);
};

/// Over-relaxation once γ has settled.
inline constexpr double kRelaxation = 1.7;

struct Settings {
  OptimizeOptions options;
  OptimizeHooks hooks;
  Objective objective = Objective::accuracy;   ///< that this run lowers
  Policy policy;                               ///< the paper's switches
  EnergyModel model;                           ///< of options.energy, in the frame's units, as sweeps begin
  EnergyModel collapse_model;                  ///< E_c
  AccuracyModel accuracy;                      ///< of the accuracy objective; without unit
  std::shared_ptr<const ErrorModel> errors{};  ///< errors of the solver: lowered, or the judge of meshes; or null
  bool lacks_error_model = false;              ///< the build has none, and the run would have used it
  std::shared_ptr<LpSolver> lp{};              ///< for repairs, or null
  std::optional<SizeField> size_field{};       ///< of the size band, in the user's units; absent without a band

  [[nodiscard]] const EnergyInfo& energy() const { return energy_info(model.kind); }
  [[nodiscard]] Executor* executor() const { return hooks.executor; }
};

/// What the sweep under way lowers, and how far its steps go.
struct SweepState {
  EnergyInfo energy;      ///< that of `model`
  EnergyModel model;      ///< in the frame's units, with γ and h° of the sweep
  double relaxation = 1;  ///< over-relaxation of Newton steps
  FlipLimit flip_limit = FlipLimit::unlimited;
  const AccuracyDomain* accuracy_domain = nullptr;  ///< if sweeps lower the accuracy objective: where it is finite

  /// Of the first sweep for options.energy.
  explicit SweepState(const Settings& settings);
  /// Lowers that energy from now on.
  void set_energy(EnergyKind kind, const Policy& policy);
  /// The user's energy of one unit in the frame.
  [[nodiscard]] double energy_unit(const Frame& frame) const;
};

/// The unknowns that a sweep moves, counted from 0: weights from i_w on.
[[nodiscard]] Unknowns unknowns_of_sweep(const Settings& settings, const EnergyInfo& energy, int sweep);

/// The model with absolute γ and h° in the user's units of length.
[[nodiscard]] EnergyModel in_user_units(EnergyModel model, const Frame& frame);

/// Errors: values out of range, or that contradict each other.
[[nodiscard]] Expected<Settings> make_settings(const OptimizeOptions& options, const Mesh& mesh, const Frame& frame,
                                               const OptimizeHooks& hooks = {});

}  // namespace temper
