// The two model problems, −Δu = f with u given on the boundary. A closed mesh of the sphere has no boundary: u is known
// up to a constant. So one unknown is given, and the mean of the error is subtracted.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "base/median.hpp"
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

/// The matrix d0ᵀ ★1 d0 at the vertices, for the operators of triangles or tetrahedra.
template <class Dec>
[[nodiscard]] PointSystem vertex_system(const Dec& dec, const std::vector<bool>& given) {
  PointSystem points(given);
  for (std::size_t e = 0; e < dec.edges.size(); ++e) {
    points.connect(dec.edges[EdgeId(e)].from.index, dec.edges[EdgeId(e)].to.index, dec.star1[EdgeId(e)]);
  }
  return points;
}
/// Describes the coefficients of this matrix. `is_boundary`: of an edge.
template <class Dec, class IsBoundary>
void describe_coefficients(const Dec& dec, const PointSystem& points, const IsBoundary& is_boundary,
                           ErrorSystem& system) {
  std::vector<double> inside;
  for (std::size_t e = 0; e < dec.edges.size(); ++e) {
    const auto& edge = dec.edges[EdgeId(e)];
    const double star1 = dec.star1[EdgeId(e)];
    if (!is_boundary(edge)) inside.push_back(std::abs(star1));
    if (star1 < 0 && !(points.is_given(edge.from.index) && points.is_given(edge.to.index))) ++system.negative;
  }
  system.largest_over_median = largest_over_median(std::move(inside));
}
/// Takes a flux away from one place and adds it to another. Two loops, since compilers do not know that places differ.
inline void move(const Lanes& flux, Lanes& from, Lanes& to) {
  for (std::size_t i = 0; i < kLanes; ++i) from[i] -= flux[i];
  for (std::size_t i = 0; i < kLanes; ++i) to[i] += flux[i];
}
/// The residuals ★0 f − d0ᵀ ★1 d0 u of fields u with −Δu = f.
template <class Dec, class Fields>
[[nodiscard]] std::vector<Lanes> vertex_residuals(const Dec& dec, const Fields& fields, const std::vector<Lanes>& u) {
  std::vector<Lanes> residuals(u.size());
  for (std::size_t v = 0; v < u.size(); ++v) {
    const Lanes f = fields.source(u[v]);
    for (std::size_t i = 0; i < kLanes; ++i) residuals[v][i] = dec.star0[VertexId(v)] * f[i];
  }
  for (std::size_t e = 0; e < dec.edges.size(); ++e) {
    const auto [from, to] = std::pair(dec.edges[EdgeId(e)].from.index, dec.edges[EdgeId(e)].to.index);
    Lanes flux;
    for (std::size_t i = 0; i < kLanes; ++i) flux[i] = dec.star1[EdgeId(e)] * (u[from][i] - u[to][i]);
    move(flux, residuals[from], residuals[to]);
  }
  return residuals;
}
/// The matrix of the two-point flux at the orthocenters. Boundary edges lead outside.
[[nodiscard]] PointSystem cell_system(const DecComplex& dec, const IdVector<EdgeId, double>& flux);
/// Describes a system by its solution. Precondition: its negative coefficients are counted.
void describe(const LinearSystem& linear, const LinearSolution& solution, ErrorSystem& system);

/// Vertex-centered: d0ᵀ ★1 d0 u = ★0 f at inner vertices, f at the vertex. u is given at boundary vertices.
[[nodiscard]] SchemeErrors poisson_errors(const Setting& setting, const std::vector<Field>& fields, bool condition);

/// Subtracts the weighted mean from errors of a mesh without boundary, in place.
void forget_constant(const std::vector<double>& weights, std::vector<double>& errors);

/// A dual edge between the orthocenters of two cells, or from one to the boundary.
struct CellLink {
  static constexpr std::size_t kOutside = static_cast<std::size_t>(-1);

  std::size_t cell, other;  ///< other: kOutside on the boundary
  double transmissibility;
  double dual_length;
  double size;  ///< of the face, as a length
  Place foot;   ///< in the frame, where the dual edge ends on the boundary

  [[nodiscard]] bool is_boundary() const { return other == kOutside; }
  [[nodiscard]] bool is_coincident() const;
};

/// The two-point flux between orthocenters: its matrix once, then one right side per field.
class FluxScheme {
 public:
  /// One place per cell: its orthocenter, in the frame. A closed mesh has no boundary.
  FluxScheme(std::vector<CellLink> links, std::vector<Place> orthocenters, bool is_closed);
  /// `inflows`: −∫ ∇u · n over the face of each link, n out of its cell. Those of a cell sum to ∫ f.
  void add_field(const Field& field, const std::vector<double>& inflows);
  /// `weights`: the size of each cell, and their sum.
  [[nodiscard]] SchemeErrors solve(const std::vector<double>& weights, double all, bool condition);

 private:
  void merge();
  [[nodiscard]] std::vector<bool> given_groups();
  void assemble();
  [[nodiscard]] std::vector<double> given_values(const Field& field) const;  // of groups that have one

  std::vector<CellLink> links_;
  std::vector<Place> orthocenters_;
  bool is_closed_;
  std::vector<std::size_t> groups_;  // cell → the group of coinciding orthocenters that it is in, by its first
  std::vector<Place> given_at_;      // group → the boundary point that gives its value
  PointSystem points_;               // groups
  std::vector<std::vector<double>> right_sides_;
  std::vector<Field> fields_;
  ErrorSystem system_;
};
[[nodiscard]] FluxScheme flux_scheme(const Setting& setting);
/// The inflow over each edge, from the means of the field.
[[nodiscard]] std::vector<double> inflows(const Setting& setting, const IdVector<EdgeId, EdgeMeans>& means);

struct Measured {
  std::vector<FieldErrors> fields;
  ErrorSystem poisson, flux;
  LocalErrors local;  ///< root mean square over the fields
};
[[nodiscard]] Measured measure(const Setting& setting, const std::vector<Field>& fields, bool condition);

/// The ratio of errors, field by field. Error: other fields, or not the same frame.
[[nodiscard]] Expected<std::vector<FieldErrors>> field_ratios(std::span<const FieldErrors> after,
                                                              std::span<const FieldErrors> before, bool same_frame);

/// The orders of convergence of each field, by least squares. See ErrorReport::orders.
[[nodiscard]] std::vector<FieldErrors> convergence_orders(const std::vector<ErrorLevel>& levels);

/// Divides every triangle into four. Weights are w/2 at the vertices and linear between them: (w_i + w_j)/4 at the
/// midpoints. So each child at a corner is similar to its parent, with its orthocenter, and half an edge has half its
/// dual length. The fourth, turned child would need weights of the opposite sign, so it is not similar. Inside a
/// triangle these weights are linear, and the four are Delaunay among themselves unless the parent is obtuse. Then
/// edges are no longer regular, and flips restore that if the parent mesh was regular.
[[nodiscard]] Expected<Mesh> refined(const Mesh& mesh);

}  // namespace temper::error_detail
