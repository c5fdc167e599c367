// One Gauss-Seidel sweep over the vertices of a mesh with fixed connectivity.
#pragma once

#include <vector>

#include "temper/tets/optimize.hpp"
#include "tets/energy/star.hpp"
#include "tets/optimize/newton_step.hpp"

namespace temper::tets {

/// What of each vertex may change. Positions stay on the boundary, between regions, and at tags of any kind.
[[nodiscard]] IdVector<VertexId, Mobility> mobilities(const TetMesh& mesh, const OptimizeOptions& options = {});

/// Parameters of one sweep.
struct SweepParameters {
  double gamma = 1;
  double relaxation = 1;  ///< factor of Newton steps; a longer step is taken only if the energy falls
};

/// Takes one Newton step of p among the faces of its link: over-relaxed, then plain, then halved, until the energy
/// falls. Otherwise p stays as it was. All tetrahedra stay positive, exactly.
[[nodiscard]] WeightedPoint improved(const TetMesh& mesh, std::span<const HalffaceId> link, const WeightedPoint& p,
                                     Mobility mobility, const SweepParameters& parameters);

class Sweeper {
 public:
  Sweeper(TetMesh& mesh, const IdVector<VertexId, Mobility>& mobility) : mesh_(mesh), mobility_(mobility) {}

  /// Improves v by one step. No tetrahedron becomes flat or negative, by the exact predicate.
  void improve(VertexId v, const SweepParameters& parameters);

 private:
  TetMesh& mesh_;
  const IdVector<VertexId, Mobility>& mobility_;
  std::vector<HalffaceId> link_;  // of the present vertex
};

}  // namespace temper::tets
