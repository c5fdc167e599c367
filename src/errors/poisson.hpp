// The two model problems, −Δu = f with u given on the boundary. A closed mesh of the sphere has no boundary: u is known
// up to a constant. So one unknown is given, and the mean of the error is subtracted.
#pragma once

#include <vector>

#include "errors/solve.hpp"
#include "errors/stars.hpp"
#include "temper/detail/error.hpp"
#include "temper/mesh.hpp"

namespace temper::error_detail {

/// A scheme as a matrix, with all its fields: made once, given the fields, solved once.
struct SchemeErrors {
  ErrorSystem system;
  std::vector<ErrorNorms> fields;
};

/// The matrix d0ᵀ ★1 d0 at the vertices.
[[nodiscard]] PointSystem vertex_system(const DecComplex& dec, const std::vector<bool>& given);
/// The matrix of the two-point flux at the orthocenters. Boundary edges lead outside.
[[nodiscard]] PointSystem cell_system(const DecComplex& dec, const IdVector<EdgeId, double>& flux);
/// Describes a system by its solution. Precondition: its negative coefficients are counted.
void describe(const LinearSystem& linear, const LinearSolution& solution, ErrorSystem& system);

/// Vertex-centered: d0ᵀ ★1 d0 u = ★0 f at inner vertices, f at the vertex. u is given at boundary vertices.
[[nodiscard]] SchemeErrors poisson_errors(const Setting& setting, const std::vector<Field>& fields, bool condition);

/// Subtracts the weighted mean from errors of a mesh without boundary, in place.
void forget_constant(const std::vector<double>& weights, std::vector<double>& errors);

/// The two-point flux: its matrix once, then one right side per field.
class FluxScheme {
 public:
  explicit FluxScheme(const Setting& setting);
  /// `means` of the field: they hold ∫ f of each triangle.
  void add_field(const Field& field, const IdVector<EdgeId, EdgeMeans>& means);
  [[nodiscard]] SchemeErrors solve(bool condition);

 private:
  void merge();
  [[nodiscard]] std::vector<bool> given_groups();
  void assemble();
  [[nodiscard]] bool coincident(const DecEdge& edge) const;
  [[nodiscard]] std::size_t group(TriangleId t) const { return groups_[t.index]; }
  [[nodiscard]] std::vector<double> given_values(const Field& field) const;  // of groups that have one

  const Setting& setting_;
  std::vector<std::size_t> groups_;  // triangle → the group of coinciding orthocenters that it is in, by its first
  std::vector<Place> given_at_;      // group → the boundary point that gives its value
  PointSystem points_;               // groups
  std::vector<std::vector<double>> right_sides_;
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

/// Divides every triangle into four. Weights are w/2 at the vertices and linear between them: (w_i + w_j)/4 at the
/// midpoints. So each child at a corner is similar to its parent, with its orthocenter, and half an edge has half its
/// dual length. The fourth, turned child would need weights of the opposite sign, so it is not similar. Inside a
/// triangle these weights are linear, and the four are Delaunay among themselves unless the parent is obtuse. Then
/// edges are no longer regular, and flips restore that if the parent mesh was regular.
[[nodiscard]] Expected<Mesh> refined(const Mesh& mesh);

}  // namespace temper::error_detail
