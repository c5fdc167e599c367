// The errors of a solver on a mesh, and their derivatives: what Objective::solver_error lowers. An interface, since
// whoever solves systems of equations needs a library for it: temper::errors has a model (make_discretization_error).
#pragma once

#include <vector>

#include "temper/detail/executor.hpp"
#include "temper/mesh.hpp"

namespace temper {

/// For whose errors a mesh is meant: what Objective::accuracy weighs its terms by (scheme_weights()).
enum class Scheme {
  all,     ///< for each something, and margins about as large as those of E_BP
  vertex,  ///< unknowns at the vertices, as in discrete exterior calculus
  cell,    ///< unknowns at the orthocenters, as in two-point flux finite volumes
  stars,   ///< the diagonal Hodge stars
};

class DiscretizationError {
 public:
  using Gradient = IdVector<VertexId, WeightedPoint>;

  virtual ~DiscretizationError() = default;

  /// The mean squared error of each scheme that counts, of no unit: meshes of one domain compare, in whatever units and
  /// order. Empty where a scheme's matrix is not positive definite, as it is where all triangles are well-centered.
  [[nodiscard]] virtual std::vector<double> errors(const Mesh& mesh, Executor* executor = nullptr) const = 0;

  /// The same, and of each the derivatives by x, y and w of every vertex, those by the places of vertices on the
  /// boundary left out: they do not move.
  [[nodiscard]] virtual std::vector<double> errors(const Mesh& mesh, std::vector<Gradient>& gradients,
                                                   Executor* executor = nullptr) const = 0;
};

}  // namespace temper
