// One Gauss-Seidel sweep over the vertices of a mesh with fixed connectivity.
#pragma once

#include <vector>

#include "temper/tets/optimize.hpp"
#include "tets/energy/star.hpp"
#include "tets/optimize/newton_step.hpp"

namespace temper::tets {

/// What of each vertex may change. Positions stay on the boundary, between regions, and at tags of any kind.
[[nodiscard]] IdVector<VertexId, Mobility> mobilities(const TetMesh& mesh, const OptimizeOptions& options = {});

class Sweeper {
 public:
  explicit Sweeper(TetMesh& mesh, const OptimizeOptions& options = {})
      : mesh_(mesh), mobility_(mobilities(mesh, options)) {}

  /// Parameters of one sweep.
  struct Parameters {
    double gamma = 1;
    double relaxation = 1;  ///< factor of Newton steps; a longer step is taken only if the energy falls
  };
  /// Improves v: takes a Newton step, over-relaxed, then plain, then halved, until the energy of the star falls. No
  /// tetrahedron becomes flat or negative, by the exact predicate. Otherwise v stays as it was.
  void improve(VertexId v, const Parameters& parameters);

 private:
  [[nodiscard]] double farthest(const WeightedPoint& origin, const WeightedPoint& step) const;
  [[nodiscard]] bool is_valid(const WeightedPoint& p, Mobility mobility) const;

  TetMesh& mesh_;
  IdVector<VertexId, Mobility> mobility_;
  std::vector<HalffaceId> halffaces_;  // of the link of the present vertex
  std::vector<LinkFace<double>> link_;
};

}  // namespace temper::tets
