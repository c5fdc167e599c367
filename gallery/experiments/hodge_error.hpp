// HOT from its definition (eq. 1), by transport of measures, and the error of the diagonal Hodge stars that it bounds
// (§2.2), on the inner simplices of regular meshes.
//
//   ★0: a vertex and its power cell     ★1: an edge and its dual edge     ★2: a triangle and its orthocenter
//
// With μ the uniform measures on a simplex σ and on its dual, the energy is Σ |*σ| |σ| W_2(μ_σ, μ_*σ)². A form's
// density g has the error | mean of g on σ − mean of g on *σ |; for |∇g| ≤ 1 it is at most W_1 ≤ W_2, so that
// Σ |*σ| |σ| error² is at most the energy.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "gallery.hpp"
#include "temper/mesh.hpp"

namespace temper::gallery {

/// Regular meshes with weights, without hidden vertices: random points, an annulus, a sheared grid.
inline constexpr std::size_t kWeightedMeshes = 3;
[[nodiscard]] std::vector<Mesh> weighted_meshes(Effort effort);

struct StarComparison {
  std::size_t simplices = 0;
  double worst = 0;     ///< relative difference of eq. 1 and eq. 2 at one simplex
  double coupling = 0;  ///< ★1: relative spread of the transport cost over couplings of the two measures
};
[[nodiscard]] StarComparison compare_definition(const std::vector<Mesh>& meshes, int star);

struct ErrorBound {
  std::size_t cases = 0;        ///< densities × meshes
  double worst = 0, least = 0;  ///< of Σ |*σ| |σ| error² over the energy
};
/// Random waves of slope 1 at most, with up to so many periods over a length of 1.
[[nodiscard]] ErrorBound error_over_bound(const std::vector<Mesh>& meshes, int star, std::size_t densities);

}  // namespace temper::gallery
