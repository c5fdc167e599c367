// Options, checked and completed: what the driver and the vertex step read.
#pragma once

#include "optimize/frame.hpp"
#include "temper/optimize.hpp"

namespace temper {

/// How γ shrinks: start, times `factor` a sweep, down to `floor`.
struct SofteningSchedule {
  Softening start;
  double factor = 1;
  double floor = 0;

  [[nodiscard]] Softening at(int sweep) const;
};

struct Settings {
  EnergyInfo energy;
  EnergyModel model;  ///< of the sweep under way, in the frame's units
  SofteningSchedule gamma;
  bool h0_follows_mesh = false;  ///< no h° given: it shrinks with the worst height of the mesh
  FlipLimit flip_limit = FlipLimit::unlimited;
  OptimizeOptions options;
};

/// The model with absolute γ and h° in the user's units of length.
[[nodiscard]] EnergyModel in_user_units(EnergyModel model, const Frame& frame);

/// −h°/ℓ for the next sweep of E_BHs: shrunk towards 0, but beyond the worst h/ℓ of the mesh as it is now.
[[nodiscard]] Softening next_h0(const Mesh& mesh, Softening present);

/// Errors: unknown energy, star, values out of range.
[[nodiscard]] Expected<Settings> make_settings(const OptimizeOptions& options, const Mesh& mesh, const Frame& frame);

}  // namespace temper
