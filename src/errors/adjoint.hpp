// Derivatives of a number that depends on a mesh through its operators, in the plane. Input are derivatives by
// coefficients, cells and places; output are derivatives by x, y and w of each vertex.
//
// The chain begins at the places p and weights w. Let triangle (i, j, k) have e = p_j − p_i and f = p_k − p_i. Its
// orthocenter is o = p_i + c with
//
//     c · e = (e² + w_i − w_j)/2,   c · f = (f² + w_i − w_k)/2
//
// With a coefficient K on triangles, heights count K h in ★1 and h/K in the transmissibility. K moves with its
// triangle.
//
// An edge with its triangle on the left has  d = ℓ/2 + (w_i − w_j)/(2ℓ),  h = e × c / ℓ. Read backwards, a derivative
// by c is λ_1 e + λ_2 f, and λ are the derivatives by the right sides.
#pragma once

#include <vector>

#include "temper/dec.hpp"
#include "temper/mesh.hpp"

namespace temper::error_detail {

/// The derivatives by the input of a scheme, in the units of the mesh; sized by the mesh, zeros at first.
struct Adjoint {
  explicit Adjoint(const Mesh& mesh, const DecComplex& dec);

  IdVector<VertexId, Vec2> vertex;                   ///< by the place itself, all else kept
  IdVector<VertexId, double> star0;                  ///< by the area of the dual cell
  IdVector<EdgeId, double> star1, transmissibility;  ///< by D/ℓ and ℓ/D
  IdVector<EdgeId, double> crossing;                 ///< by d itself
  IdVector<TriangleId, Vec2> orthocenter;            ///< by its place
  IdVector<TriangleId, double> area;

  void add(const Adjoint& other);
  /// Adds the derivatives of −λᵀ A v by ★1, for unknowns at the vertices.
  void add_star1(const DecComplex& dec, const std::vector<double>& v, const std::vector<double>& lambda);
  /// Adds them by the transmissibility of inner edges, for unknowns at the orthocenters.
  void add_flux(const DecComplex& dec, const std::vector<double>& v, const std::vector<double>& lambda);
};

/// The derivatives by the unknowns of each vertex. O(n).
[[nodiscard]] IdVector<VertexId, WeightedPoint> pulled_back(const Mesh& mesh, const DecComplex& dec, const Adjoint& by);

}  // namespace temper::error_detail
