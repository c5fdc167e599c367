// Runs of Algorithm 1 on the dense horseshoe before any flips (§6.5): one outer iteration, inner iterations until they
// converge, no collapses unless asked for.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "experiments/domain.hpp"
#include "experiments/oscillating_horseshoe.hpp"
#include "experiments/recording.hpp"
#include "temper/mesh.hpp"
#include "temper/optimize.hpp"

namespace temper::gallery {

/// Positions and weights from iteration 0, γ = 1, −h° a quarter more than the worst h of the input. Inversions
/// are allowed, but for barriers, which without a rule against them lose triangles (figure 32).
[[nodiscard]] OptimizeOptions dense_options(std::string_view energy, const VertexOrder& order = {});
/// Positions only, where no step turns a triangle over: a golden section over the whole patch radius that may do so
/// jumps over the narrow minima at collapsed edges.
[[nodiscard]] OptimizeOptions dense_positions(std::string_view energy, const VertexOrder& order = {});

/// The converged mesh before flips.
[[nodiscard]] const Moment& before_flips(const Recording& recording);

/// "E_∂T" of "dT": the total energy of ★1 under that name, γ = 1.
[[nodiscard]] double dense_energy(const Mesh& mesh, std::string_view energy);

/// The picture of figures 16 to 18: duals, weight circles by scale, discs on nearly coincident vertices.
[[nodiscard]] std::string dense_picture(const Mesh& mesh, const std::string& title, const std::string& footer,
                                        double weight_scale = 0, double width = 400);

/// Distances between the places of the same vertices in two meshes.
struct Difference {
  double mean_move = 0;  ///< of interior vertices
  double largest_move = 0;
  double largest_weight = 0;  ///< change of a weight
};
[[nodiscard]] Difference difference(const Mesh& a, const Mesh& b);

/// Orthocenters outside the domain.
struct OutsideCenters {
  std::size_t count = 0;       ///< in no triangle of the mesh
  double distance = 0;         ///< from the boundary, all together
  std::size_t across = 0;      ///< on the other side of a boundary edge of their own triangle
  double across_distance = 0;  ///< from those edges, all together
};
[[nodiscard]] OutsideCenters centers_outside_domain(const Mesh& mesh);

}  // namespace temper::gallery
