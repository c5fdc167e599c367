// The linear constraints on weights that an edge implies, in every well-centered triangulation that has it:
//
//   - its two crossings, 0 < d < ℓ
//   - for each vertex X that sees the whole edge pq: the height of pqX over pq is positive, be it a triangle or not
//
// And without any edge: for all vertices that see each other, |w_p − w_q| < |pq|², the crossings of pq. These and the
// heights hold because the lifted function is convex along segments in the domain (docs/explanation/connectivities.md).
// For heights alone, rows of crossings are left out.
#pragma once

#include <cstddef>
#include <vector>

#include "feasibility/constraints.hpp"
#include "feasibility/margin_simplex.hpp"
#include "feasibility/sight.hpp"

namespace temper {

/// The rows of edges, made when they are first needed. Rows of crossings between vertices of no edge have no slope:
/// only an edge has a margin.
class EdgeRows {
 public:
  using Range = MarginSimplex::Range;

  EdgeRows(const Mesh& mesh, const Sight& sight, Constraints constraints);

  [[nodiscard]] std::size_t n_weights() const { return mesh_.n_vertices() - 1; }
  [[nodiscard]] const std::vector<MarginRow>& all() const { return rows_; }
  [[nodiscard]] Range of_pairs() const { return pairs_; }
  [[nodiscard]] Range of_edge(VertexId a, VertexId b);
  /// Says whether the constraint of a row needs its edge. A positive crossing does not, unlike a crossing with a
  /// margin.
  [[nodiscard]] bool needs_edge(std::size_t row) const {
    return constraints_[row].kind == WeightConstraint::Kind::height;
  }
  /// The constraint of a row, with the multiplier of its polynomial (temper/feasibility.hpp).
  [[nodiscard]] Certificate::Term term(std::size_t row, double multiplier) const {
    return {constraints_[row], multiplier / (norms_[row] * demand_.scale_of_polynomial(constraints_[row]))};
  }
  [[nodiscard]] double weight(const MarginSimplex& program, VertexId v) const {
    return unit_ * program.weight(column_of(v));
  }

 private:
  /// The first weight is zero.
  [[nodiscard]] static int column_of(VertexId v) { return static_cast<int>(v.index) - 1; }
  void add(const WeightConstraint& constraint, double slope);

  const Mesh& mesh_;
  const Sight& sight_;
  TriangleDemand demand_;
  double unit_ = 1;  ///< of weights: the square of the size of the mesh
  std::vector<MarginRow> rows_;
  std::vector<WeightConstraint> constraints_;
  std::vector<double> norms_;  ///< what rows were divided by, so that their largest coefficient is one
  Range pairs_;
  std::vector<Range> edges_;  ///< by the two numbers of the vertices
};

}  // namespace temper
