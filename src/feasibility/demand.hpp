// Constraints on the weights of a mesh, as linear programs see them: cells with corners, edges, and linear forms of the
// potentials (potential.hpp). Triangles (constraints.hpp) and tetrahedra (tets/weights) are two kinds of cells.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "feasibility/potential.hpp"
#include "temper/detail/criterion.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/detail/ids.hpp"
#include "temper/detail/space.hpp"
#include "temper/feasibility.hpp"

namespace temper {

struct LinearForm {
  int size = 0;  ///< the number of vertices of its constraint
  std::array<VertexId, 5> vertices;
  std::array<double, 5> coefficients = {};
  double constant = 0;
  double slope =
      0;  ///< m = 1 − slope · the mean of the first two potentials; the coefficients sum to −slope · constant
};

/// The form that is ≥ 0 if and only if the value of this one is ≥ margin.
[[nodiscard]] LinearForm beyond_margin(LinearForm form, double margin);

/// m for the potentials potential(v): one in the plane.
template <class Potential>
double scale_of(const LinearForm& form, const Potential& potential) {
  return 1 - 0.5 * form.slope * (potential(form.vertices[0]) + potential(form.vertices[1]));
}
/// The linear function, by differences, so that a large potential common to all costs no digits.
template <class Potential>
double numerator_of(const LinearForm& form, const Potential& potential) {
  const double first = potential(form.vertices[0]);
  double value = form.constant * (1 - form.slope * first);
  for (int k = 1; k < form.size; ++k) value += form.coefficients[k] * (potential(form.vertices[k]) - first);
  return value;
}
/// h/ℓ, d/ℓ or dual length/ℓ.
template <class Potential>
double value_of(const LinearForm& form, const Potential& potential) {
  return numerator_of(form, potential) / scale_of(form, potential);
}

/// The crossing of an edge, from its squared length or its vector.
inline LinearForm crossing_form(const WeightConstraint& c, double l2) {
  return {2, {c.p, c.q}, {0.5 / l2, -0.5 / l2}, 0.5};
}
template <class Vector>
LinearForm crossing_form(const WeightConstraint& c, const Vector& pq) {
  return crossing_form(c, squared_length(pq));
}
/// The equation of the interface edge pq, which is rs on the other side, from its vectors.
template <class Vector>
LinearForm equal_crossing_form(const WeightConstraint& c, const Vector& pq, const Vector& rs) {
  const double here = 0.5 / squared_length(pq), there = 0.5 / squared_length(rs);
  return {4, {c.p, c.q, c.r, c.s}, {here, -here, -there, there}, 0};
}
/// The height over the edge pq of the triangle pqr, from |pq|², the products pq·pr, qp·qr and rp·rq, and twice the
/// area.
inline LinearForm height_form(const WeightConstraint& c, double l2, const std::array<double, 3>& at,
                              double twice_area) {
  const double scale = 0.5 / twice_area;
  return {3, {c.p, c.q, c.r}, {scale * at[1] / l2, scale * at[0] / l2, -scale}, scale * at[2]};
}
template <class Vector>
LinearForm height_form(const WeightConstraint& c, const Vector& pq, const Vector& pr, const Vector& qr,
                       double twice_area) {
  return height_form(c, squared_length(pq), {dot(pq, pr), -dot(pq, qr), dot(pr, qr)}, twice_area);
}
/// The dual length of an edge, from the heights over it in pqr and in qps.
inline LinearForm dual_form(const WeightConstraint& c, const LinearForm& left, const LinearForm& right) {
  const auto &a = left.coefficients, &b = right.coefficients;
  return {4, {c.p, c.q, c.r, c.s}, {a[0] + b[1], a[1] + b[0], a[2], b[2]}, left.constant + right.constant};
}

/// Returns the constraints on weights that a criterion is.
[[nodiscard]] inline Constraints constraints_of(Criterion criterion) {
  if (criterion == Criterion::well_centered) return Constraints::well_centered;
  return criterion == Criterion::coefficients ? Constraints::coefficients : Constraints::distances;
}

/// Says whether a constraint is an equation, whose multiplier may have either sign.
[[nodiscard]] inline bool is_equation(const WeightConstraint& c) {
  return c.kind == WeightConstraint::Kind::equal_crossing;
}

/// The crossing of an edge from either end.
[[nodiscard]] WeightConstraint split_constraint(VertexId from, VertexId to);

/// A triangle or a tetrahedron, by its number in the mesh.
using CellId = Id<struct CellTag>;
using VertexWeights = IdVector<VertexId, double>;

struct WeightEdge {
  VertexId p, q;
  double squared_length = 0;
};

/// Constraints on a mesh. Lists of cells are sorted, and have each cell once.
class Demand {
 public:
  Demand(const Demand&) = delete;
  Demand& operator=(const Demand&) = delete;
  virtual ~Demand() = default;

  [[nodiscard]] Constraints constraints() const { return constraints_; }
  /// Says whether heights over all sides of cells count.
  [[nodiscard]] bool has_heights() const { return !has_duals(); }
  /// Says whether heights over the boundary and over both sides of interfaces count, next to dual lengths.
  [[nodiscard]] bool has_outer_heights() const {
    return constraints_ == Constraints::coefficients || constraints_ == Constraints::distances;
  }
  [[nodiscard]] bool has_crossings() const { return has_crossings_; }
  [[nodiscard]] bool has_duals() const { return constraints_ == Constraints::regular || has_outer_heights(); }
  /// Says whether weights that attain a margin can be stretched to attain any, up to kMostMargin.
  [[nodiscard]] bool is_stretchable() const { return has_duals() && !has_outer_heights() && !is_curved(); }
  /// Says whether the cells have no common plane or space, in which w = |x|² would make all duals zero.
  [[nodiscard]] bool is_curved() const { return is_curved_; }
  /// Says whether a constraint may be 0.
  [[nodiscard]] bool allows_zero() const { return constraints_ == Constraints::coefficients; }
  [[nodiscard]] bool is_good(Sign sign) const {
    return sign == Sign::positive || (allows_zero() && sign == Sign::zero);
  }
  /// Says whether the margin is about this constraint.
  [[nodiscard]] bool has_margin(const WeightConstraint& c) const { return !allows_zero() || c.kind == inner_dual_; }
  /// The plane, too, if cells are tetrahedra: weights are the potentials.
  [[nodiscard]] const Space& space() const { return space_; }

  // --- the mesh ------------------------------------------------------------------------------------
  [[nodiscard]] virtual std::size_t n_vertices() const = 0;
  [[nodiscard]] virtual std::size_t n_cells() const = 0;
  [[nodiscard]] IdRange<VertexId> vertices() const { return IdRange<VertexId>(n_vertices()); }
  [[nodiscard]] IdRange<CellId> cells() const { return IdRange<CellId>(n_cells()); }
  [[nodiscard]] virtual double weight(VertexId v) const = 0;
  [[nodiscard]] VertexWeights weights() const {
    VertexWeights all;
    all.reserve(n_vertices());
    for (const VertexId v : vertices()) all.push_back(weight(v));
    return all;
  }
  virtual void add_corners(CellId cell, std::vector<VertexId>& corners) const = 0;
  /// Adds the cells around v, and around its copies on other sides of interfaces, in any order; none if it has none.
  virtual void add_cells_around(VertexId v, std::vector<CellId>& cells) const = 0;
  /// Adds the vertices across the outer edges, or faces, of the cells around v, in any order.
  virtual void add_vertices_across(VertexId v, std::vector<VertexId>& vertices) const = 0;
  /// The edges of these cells, each once.
  [[nodiscard]] virtual std::vector<WeightEdge> edges_of(std::span<const CellId> cells) const = 0;

  // --- the constraints -----------------------------------------------------------------------------
  /// The constraints of these cells: all heights, then the crossings and the dual lengths. With `rim` a dual length
  /// counts if one of its two cells is among them; else only if both are.
  [[nodiscard]] virtual std::vector<WeightConstraint> constraints_of(std::span<const CellId> cells,
                                                                     bool rim = false) const = 0;
  /// The equations of interfaces that have both triangles among these cells: their forms are 0.
  [[nodiscard]] virtual std::vector<WeightConstraint> equations_of(std::span<const CellId> /*cells*/) const {
    return {};
  }
  /// Takes off the little that these weights violate the equations of interfaces.
  virtual void settle(VertexWeights& /*weights*/) const {}
  [[nodiscard]] virtual LinearForm linear_form(const WeightConstraint& constraint) const = 0;
  /// N of a constraint (temper/feasibility.hpp) over its value, h/ℓ, d/ℓ or dual length/ℓ.
  [[nodiscard]] virtual double scale_of_polynomial(const WeightConstraint& constraint) const = 0;
  /// Says whether a cell satisfies all its constraints, exactly, with these weights.
  [[nodiscard]] virtual bool is_kept(CellId cell, const VertexWeights& weights) const = 0;
  /// The least value of a cell's constraints with these weights, in doubles; kUnbounded when it has none.
  [[nodiscard]] virtual double margin_of(CellId cell, const VertexWeights& weights) const = 0;
  /// Violation::angle_deg.
  [[nodiscard]] virtual double angle_deg(const WeightConstraint& constraint) const = 0;
  [[nodiscard]] virtual CertificateCheck check(const Certificate& certificate) const = 0;
  /// The squared offsets of all cells (temper/feasibility.hpp).
  [[nodiscard]] virtual std::vector<OffsetTerm> offsets(const WeightOptions& options) const = 0;
  /// A bound of |w_p − w_q| for an edge of a cell with these corners, if weights keep its constraints; on the sphere of
  /// |σ_q/σ_p − 1| and |σ_p/σ_q − 1|.
  [[nodiscard]] virtual double reach(VertexId p, VertexId q, std::span<const VertexId> corners) const = 0;

 protected:
  Demand(const Space& space, Constraints constraints, bool has_crossings, WeightConstraint::Kind inner_dual)
      : space_(space), constraints_(constraints), has_crossings_(has_crossings), inner_dual_(inner_dual) {}

  /// The value of a constraint as it counts in a margin.
  [[nodiscard]] double counted(const WeightConstraint& c, double value) const {
    return has_margin(c) || value < 0 ? value : kUnbounded;
  }
  void set_curved() { is_curved_ = true; }

 private:
  Space space_;
  Constraints constraints_;
  bool has_crossings_;
  WeightConstraint::Kind inner_dual_;
  bool is_curved_ = false;
};

/// The corners of these cells, sorted, each once.
[[nodiscard]] std::vector<VertexId> vertices_of(const Demand& demand, std::span<const CellId> cells);
[[nodiscard]] std::vector<CellId> all_cells(const Demand& demand);
/// Demand::margin_of, of all cells.
[[nodiscard]] double least_margin(const Demand& demand, const VertexWeights& weights);
/// Σ over edges |Δw_i − Δw_j| / (2ℓ).
[[nodiscard]] double weight_change(const Demand& demand, const VertexWeights& from, const VertexWeights& to);

/// Finds weights for a demand of the kind that the options name.
[[nodiscard]] WeightReport find_weights(const Demand& demand, LpSolver& solver, const WeightOptions& options,
                                        ConvexSolver* convex);
/// The error of a goal that cannot keep the equations of interfaces, if there are any.
[[nodiscard]] std::optional<InputError> expect_goal_across_interfaces(const WeightOptions& options,
                                                                      bool has_interfaces);
/// The error of options whose margin is out of range, or whose goal needs the solver that is null.
[[nodiscard]] std::optional<InputError> expect_goal(const WeightOptions& options, const ConvexSolver* convex);

}  // namespace temper
