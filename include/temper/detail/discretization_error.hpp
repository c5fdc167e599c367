// The errors of a solver on a mesh and their derivatives, which Objective::solver_error lowers. It is an interface,
// because solvers of systems of equations need a library. temper::errors has a model (make_discretization_error).
#pragma once

#include <array>
#include <vector>

#include "temper/detail/executor.hpp"
#include "temper/mesh.hpp"

namespace temper {

/// The solver for which a mesh is meant. It sets the factors of Objective::accuracy (scheme_weights()).
enum class Scheme {
  all,     ///< A compromise for all, with margins about as large as from E_BP
  vertex,  ///< Unknowns at the vertices, as in discrete exterior calculus
  cell,    ///< Unknowns at the orthocenters, as in two-point flux finite volumes
  stars,   ///< The diagonal Hodge stars
};

/// A piece of the boundary with a given value: of u (Dirichlet), or of the flux K ∂u/∂n into the domain (Neumann).
struct BoundaryValue {
  std::vector<std::array<VertexId, 2>> edges;  ///< Boundary edges, each by its ends in either order
  double value = 0;
  bool is_flux = false;
};

/// −div(K ∇u) = f in the plane. Boundary edges of no piece have no flux. Where a value of u meets a flux, the
/// vertex has the value of u. Where two values of u meet, it has that of the later piece.
struct DiffusionProblem {
  std::vector<double> coefficient = {};  ///< K > 0 of each triangle; empty: 1
  std::vector<double> source = {};       ///< f at each vertex, linear on triangles; empty: 0
  std::vector<BoundaryValue> boundary = {};
};

/// For a mesh of triangles or tetrahedra, whose vertices are points of this type.
template <class AnyMesh, class Point>
class DiscretizationErrorOf {
 public:
  using Gradient = IdVector<VertexId, Point>;

  virtual ~DiscretizationErrorOf() = default;

  /// Says whether errors() has derivatives. Without them it only chooses between meshes.
  [[nodiscard]] virtual bool has_gradient() const { return true; }
  /// Returns the mean squared error of each selected scheme, without unit. Meshes of one domain can be compared in any
  /// units and order. Empty if the matrix of a scheme is not positive definite. The matrices are positive definite if
  /// all triangles or tetrahedra are well-centered.
  ///
  /// `gradients`, unless null, gets the derivatives of each error by the coordinates and the weight of every vertex.
  /// In the plane the derivatives by the places of boundary vertices are left out, because these do not move.
  /// Precondition then: has_gradient().
  [[nodiscard]] virtual std::vector<double> errors(const AnyMesh& mesh, std::vector<Gradient>* gradients = nullptr,
                                                   Executor* executor = nullptr) const = 0;
};
using DiscretizationError = DiscretizationErrorOf<Mesh, WeightedPoint>;

}  // namespace temper
