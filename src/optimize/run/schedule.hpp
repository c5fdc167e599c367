// The schedule of length_parameter: γ of E_BP and h° of E_BHs from sweep to sweep, as data.
//
// A small γ from the start pins every vertex to the few triangles that are bad, and prices out the flips that
// would cure them; a large one does not see h < 0. So γ starts large and shrinks. Quickly at first, one sweep a
// level, until nothing is bad: enough for most meshes. Nearly all flips happen then, and decide which minimum is
// reached; steps that go far find a better one, by 1 % of the energy on random points. What is still bad then is tried
// again from the input: where ties cannot move, with weights that choose their diagonals (ties.hpp); then with a larger
// γ, levels that are left only when their energy has settled, and a small jitter against symmetric grids, whose
// positions are stationary.
#pragma once

#include <optional>
#include <span>

#include "optimize/options/settings.hpp"

namespace temper {

/// Where the boundary and lines are cut before a restart, if the options ask for cuts.
enum class BoundarySplitting : std::uint8_t {
  graded,     ///< where long edges meet short ones, and where a dual has no place to cross
  none,       ///< nowhere
  where_bad,  ///< where the best mesh so far has bad triangles; the restart goes on with that mesh
};

/// One way from the input to a well-centered mesh.
struct Restart {
  double start = 0;         ///< first γ/ℓ
  double factor = 1;        ///< from level to level
  double relaxation = 0;    ///< while γ shrinks
  int level_sweeps = 1;     ///< most sweeps at one level
  double level_fall = 0;    ///< a level is left when the energy falls by less than this part of itself
  bool until_good = false;  ///< the last level follows as soon as no triangle is bad
  double jitter = 0;        ///< of free vertices before the first sweep, relative to their shortest edge
  double fewer = 1;         ///< it is given up when bad triangles do not become fewer than this part of them for long
  double tie_weight = 0;    ///< added before it to the heavier ends of ties, relative to their shortest edge squared
  std::optional<EnergyKind> first_energy = {};              ///< of its first sweeps
  BoundarySplitting splitting = BoundarySplitting::graded;  ///< before it
};

/// The restart for a mesh that is well-centered already, or as good as can be: the sharpest γ at once.
extern const Restart kPolish;

/// The restart for a mesh that is good but for a few places.
extern const Restart kNearlyGood;

/// The restarts for this mesh and these options, in order; at least one. A user's γ, or an energy without one, leaves
/// a single restart, and so does a mesh that is well-centered already.
[[nodiscard]] std::span<const Restart> restarts(const Settings& settings, const Mesh& mesh);

/// γ and h° of the sweeps of one restart.
class GammaSchedule {
 public:
  GammaSchedule() = default;
  GammaSchedule(const Restart& restart, const EnergyInfo& energy, const Policy& policy)
      : restart_(restart),
        gamma_shrinks_(energy.softened_by_gamma && !policy.gamma),
        h0_shrinks_(energy.softened_by_h0 && !policy.h0) {}

  /// The first sweep's.
  void start(const Mesh& mesh, EnergyModel& model);
  /// To be called after a sweep that lowered the energy by `fall` times itself and left `bad` triangles. True when the
  /// model changed: energies before and after do not compare.
  bool advance(const Mesh& mesh, double fall, std::size_t bad, EnergyModel& model);
  /// Over-relaxation of the next sweep, where the options name none.
  [[nodiscard]] double relaxation() const { return settled_ ? kRelaxation : restart_.relaxation; }
  /// Says whether advance will change the model no more: only then can a run converge.
  [[nodiscard]] bool settled() const { return settled_; }
  /// Says whether the energy before the next sweep will be asked for.
  [[nodiscard]] bool compares_energies() const { return settled_ || (gamma_shrinks_ && restart_.level_sweeps > 1); }

 private:
  Restart restart_;
  bool gamma_shrinks_ = false, h0_shrinks_ = false;
  bool settled_ = true;
  int sweeps_at_level_ = 0;
};

}  // namespace temper
