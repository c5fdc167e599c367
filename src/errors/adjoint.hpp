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

template <class Values>
void add_all(Values& to, const Values& from) {
  for (std::size_t i = 0; i < to.size(); ++i) to.begin()[i] = to.begin()[i] + from.begin()[i];
}

/// The derivatives by the input of the scheme at the vertices, in the units of the mesh; zeros at first.
template <class Vec>
struct VertexAdjoint {
  IdVector<VertexId, Vec> vertex;    ///< by the place itself, all else kept
  IdVector<VertexId, double> star0;  ///< by the size of the dual cell
  IdVector<EdgeId, double> star1;    ///< by the size of the dual of an edge over its length

  VertexAdjoint(std::size_t vertices, std::size_t edges)
      : vertex(vertices, Vec{}), star0(vertices, 0.0), star1(edges, 0.0) {}
  void add(const VertexAdjoint& other) {
    add_all(vertex, other.vertex);
    add_all(star0, other.star0);
    add_all(star1, other.star1);
  }
};

/// The derivatives by the input of both schemes of triangles; sized by the mesh, zeros at first.
struct Adjoint : VertexAdjoint<Vec2> {
  explicit Adjoint(const Mesh& mesh, const DecComplex& dec);

  IdVector<EdgeId, double> transmissibility;  ///< by ℓ/D
  IdVector<EdgeId, double> crossing;          ///< by d itself
  IdVector<TriangleId, Vec2> orthocenter;     ///< by its place
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
