// The schedule of length_parameter: γ of E_BP and h° of E_BHs from sweep to sweep, as data.
//
// If γ is small from the start, vertices cannot move away from the few bad triangles, and flips that would cure these
// cost too much. If γ is large, the energy does not see h < 0. So γ starts large and shrinks. At first it shrinks with
// each sweep, until no triangle is bad, which is enough for most meshes. Nearly all flips happen in these sweeps, and
// they decide which minimum is reached. Long steps find a better minimum, by 1 % of the energy on random points. If
// triangles are still bad, more restarts begin from the input. For ties that cannot move, weights choose the diagonals
// (ties.hpp). Then come a larger γ, levels that last until their energy has settled, and a small jitter, since the
// positions of symmetric grids are stationary.
#pragma once

#include <optional>
#include <span>

#include "optimize/options/settings.hpp"

namespace temper {

/// Places at which the boundary and lines are cut before a restart, if the options ask for cuts.
enum class BoundarySplitting : std::uint8_t {
  graded,     ///< long edges next to short ones, and edges that a dual has no room to cross
  none,       ///< nowhere
  where_bad,  ///< bad triangles of the best mesh so far, with which the restart goes on
};

/// One way from the input to a well-centered mesh.
struct Restart {
  double start = 0;         ///< first γ/ℓ
  double factor = 1;        ///< from level to level
  double relaxation = 0;    ///< while γ shrinks
  int level_sweeps = 1;     ///< most sweeps at one level
  double level_fall = 0;    ///< a level ends when the energy falls by less than this part of itself
  bool until_good = false;  ///< go to the last level as soon as no triangle is bad
  double jitter = 0;        ///< of free vertices before the first sweep, relative to their shortest edge
  double fewer = 1;         ///< give up if the bad triangles stay above this part of their number for long
  double tie_weight = 0;    ///< weight added before it to the heavier ends of ties, over their shortest edge squared
  std::optional<EnergyKind> first_energy = {};              ///< energy of its first sweeps
  BoundarySplitting splitting = BoundarySplitting::graded;  ///< before it
};

/// The restart for a mesh that is well-centered already, or cannot get better: it begins with the sharpest γ.
extern const Restart kPolish;

/// The restart for a mesh that is good except in a few places.
extern const Restart kNearlyGood;

/// Returns the restarts for this mesh and these options, in order, at least one. There is one only if the user sets γ,
/// if the energy has none, or if the mesh is well-centered already.
[[nodiscard]] std::span<const Restart> restarts(const Settings& settings, const Mesh& mesh);

/// γ and h° of the sweeps of one restart.
class GammaSchedule {
 public:
  GammaSchedule() = default;
  GammaSchedule(const Restart& restart, const EnergyInfo& energy, const Policy& policy)
      : restart_(restart),
        gamma_shrinks_(energy.softened_by_gamma && !policy.gamma),
        h0_shrinks_(energy.softened_by_h0 && !policy.h0) {}

  /// Sets γ and h° of the first sweep.
  void start(const Mesh& mesh, EnergyModel& model);
  /// Call this after a sweep that lowered the energy by `fall` times itself and left `bad` triangles bad. Returns true
  /// if the model changed: then energies before and after cannot be compared.
  bool advance(const Mesh& mesh, double fall, std::size_t bad, EnergyModel& model);
  /// Returns the over-relaxation of the next sweep, if the options set none.
  [[nodiscard]] double relaxation() const { return settled_ ? kRelaxation : restart_.relaxation; }
  /// Says whether advance() will not change the model again. Only then can a run converge.
  [[nodiscard]] bool settled() const { return settled_; }
  /// Says whether advance() needs the energy before the next sweep.
  [[nodiscard]] bool compares_energies() const { return settled_ || (gamma_shrinks_ && restart_.level_sweeps > 1); }

 private:
  Restart restart_;
  bool gamma_shrinks_ = false, h0_shrinks_ = false;
  bool settled_ = true;
  int sweeps_at_level_ = 0;
};

}  // namespace temper
