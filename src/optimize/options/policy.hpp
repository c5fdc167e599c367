// The paper's switches, compiled once for a run: absent values have their value, and each question that the driver and
// the steps ask has its answer.
#pragma once

#include "temper/optimize.hpp"

namespace temper {

struct Policy : PaperSwitches {
  // What flips do.
  bool flips_at_once = true;         ///< Flips::immediate
  bool defers_flips = false;         ///< they wait for the end of the inner iterations
  bool keeps_connectivity = false;   ///< Flips::none

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

}  // namespace temper
