// The two model problems, −Δu = f with u given on the boundary. On a closed mesh of the sphere there is none: u is
// known but for a constant, so one unknown is given, and the mean of the error is taken from it.
#pragma once

#include <vector>

#include "errors/solve.hpp"
#include "errors/stars.hpp"
#include "temper/detail/error.hpp"
#include "temper/mesh.hpp"

namespace temper::error_detail {

/// A scheme as a matrix, and what it does to each field in turn: made once, given the fields, solved once.
struct SchemeErrors {
  ErrorSystem system;
  std::vector<ErrorNorms> fields;
};

/// Vertex-centered: d0ᵀ ★1 d0 u = ★0 f at inner vertices, f at the vertex; u given at those of the boundary.
[[nodiscard]] SchemeErrors poisson_errors(const Setting& setting, const std::vector<Field>& fields, bool condition);

/// Takes the weighted mean from errors of a mesh without boundary, in place.
void forget_constant(const std::vector<double>& weights, std::vector<double>& errors);

/// The two-point flux: its matrix once, then a right side a field.
class FluxScheme {
 public:
  explicit FluxScheme(const Setting& setting);
  /// `means` of the field: they hold ∫ f of each triangle.
  void add_field(const Field& field, const IdVector<EdgeId, EdgeMeans>& means);
  [[nodiscard]] SchemeErrors solve(bool condition);

 private:
  void merge();
  void number();
  void assemble();
  [[nodiscard]] bool coincident(const DecEdge& edge) const;
  [[nodiscard]] std::size_t group(TriangleId t) const { return groups_[t.index]; }

  const Setting& setting_;
  std::vector<std::size_t> groups_;    // triangle → the group of coinciding orthocenters that it is in
  std::vector<std::size_t> unknowns_;  // group → its unknown, or kGiven
  std::vector<Place> given_at_;        // group → the boundary point that gives its value
  LinearSystem linear_;
  std::vector<Field> fields_;
  ErrorSystem system_;
};

struct Measured {
  std::vector<FieldErrors> fields;
  ErrorSystem poisson, flux;
  LocalErrors local;  ///< root mean square over the fields
};
[[nodiscard]] Measured measure(const Setting& setting, const std::vector<Field>& fields, bool condition);

/// The orders of convergence of each field, by least squares. See ErrorReport::orders.
[[nodiscard]] std::vector<FieldErrors> convergence_orders(const std::vector<ErrorLevel>& levels);

/// Divides every triangle into four. Weights are w/2 at the vertices and linear between, (w_i + w_j)/4 at the
/// midpoints. So each child at a corner is similar to its parent, orthocenter and all, and an edge's halves have half
/// of its dual length. No weights would do that for the fourth, turned child as well: those that the three fix have the
/// opposite sign there. Inside of a triangle these weights are linear, and the four are Delaunay among themselves
/// unless the parent is obtuse; then edges are not regular any more, and flips restore that where the parent mesh was
/// regular.
[[nodiscard]] Expected<Mesh> refined(const Mesh& mesh);

}  // namespace temper::error_detail
