// The loops over stars and tetrahedra, in the fastest instruction set that the machine has: eight at once.
//
// Every set computes the same operations in the same order (base/pack.hpp), so results do not depend on the choice.
#pragma once

#include <cstddef>

#include "tets/energy/lanes.hpp"
#include "tets/energy/star_kernel.hpp"
#include "tets/optimize/newton_step.hpp"

namespace temper::tets {

/// Eight faces of a link, as the star's center sees them.
struct alignas(64) LinkLanes {
  LanePoints q, r, s;
  // Of the present step: the shape of each tetrahedron, and the rest of a LinkFace.
  Lane shape;
  std::byte face[sizeof(LinkFace<Lane>)];
};

/// The faces of a link, in blocks of eight. Lanes beyond `faces` repeat others.
struct Link {
  LinkLanes* blocks = nullptr;
  std::size_t faces = 0;
};

/// Parameters of one sweep.
struct SweepParameters {
  double gamma = 1;
  double relaxation = 1;  ///< factor of Newton steps; a longer step is taken only if the energy falls
  /// Largest cosine of a dihedral angle: steps to larger ones are not taken, unless it was larger before.
  double most_cosine = 1;
};

struct StarStep {
  WeightedPoint to;
  bool lower = false;    ///< The energy is lower at `to`
  bool certain = false;  ///< and all tetrahedra are certainly positive there
};

/// Bit i: lane i. A tetrahedron may be neither, by rounding.
struct Certainty {
  unsigned inside = 0;   ///< The orthocenter is certainly inside
  unsigned outside = 0;  ///< It is certainly not
};

struct Kernels {
  /// Value, gradient and Hessian of the energy of a star; the value is +∞ unless all tetrahedra are positive.
  PointDerivatives<double> (*derivatives)(const Link& link, const WeightedPoint& p, double gamma);
  /// A Newton step: over-relaxed, then plain, then halved, until the energy falls and shapes are kept.
  StarStep (*step)(const Link& link, const WeightedPoint& p, const Mobility& mobility,
                   const SweepParameters& parameters);
  /// Says whether no dihedral angle at the center of a star gets a larger cosine than the most, or than there is.
  bool (*keeps_angles)(const Link& link, const WeightedPoint& from, const WeightedPoint& to, double most_cosine);
  /// The energies of tetrahedra, and where their orthocenters are.
  Certainty (*tetrahedra)(const TetLanes& tetrahedra, double gamma, Lane& energies);
};

/// The kernels of the instruction set in use.
[[nodiscard]] const Kernels& kernels();

}  // namespace temper::tets

namespace temper::baseline {
extern const tets::Kernels kTetKernels;
}
namespace temper::avx2 {
extern const tets::Kernels kTetKernels;
}
namespace temper::avx512 {
extern const tets::Kernels kTetKernels;
}
