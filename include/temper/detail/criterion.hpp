// The criterion of a target: what its solver needs of a mesh. Exact arithmetic decides it.
//
// The dual of an edge has a signed length: the sum of the heights h of the orthocenters on its two sides. This sum over
// the length of the edge is the coefficient of the edge. On the boundary the dual is the one height there. Between two
// regions each height is a part of its own, because solvers multiply it by the coefficient of its region.
//
//          c
//        / | \          dual of ab:  h_c + h_d, from one orthocenter to the other
//       a--+--b         parts:       h_c and h_d, if c and d are in different regions
//        \ | /          coefficient: (h_c + h_d)/ℓ
//          d
//
// temper/tets/criterion.hpp has the same for tetrahedra. There a coefficient and a distance are no longer one number.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "temper/detail/discretization_error.hpp"
#include "temper/mesh.hpp"

namespace temper {

class Executor;

enum class Criterion : std::uint8_t {
  well_centered,  ///< All triangles or tetrahedra are well-centered
  coefficients,   ///< No coefficient of an edge is negative, also of each region alone. Zero is good
  distances,      ///< Distances between centers are positive, also from the boundary and from interfaces. Zero is bad
};

/// A row of the table of criteria.
struct CriterionInfo {
  Criterion criterion;
  std::string_view name;       ///< "coefficients": stable across versions
  std::string_view sentence;   ///< Sentence that is true of a good mesh
  std::string_view needed_by;  ///< Solvers that need it
};
/// One row for each Criterion, in the same order.
[[nodiscard]] std::span<const CriterionInfo> criteria_table();
[[nodiscard]] std::string_view name(Criterion criterion);
[[nodiscard]] std::span<const std::string_view> words_of(Criterion);
/// The criterion of a scheme: coefficients for unknowns at vertices, distances for unknowns in cells, or well_centered.
[[nodiscard]] Criterion criterion_of(Scheme scheme);

/// The kinds of duals.
enum class DualKind : std::uint8_t {
  inside,    ///< Dual of an element inside the mesh, with all cells around it
  boundary,  ///< Dual of an element on the boundary
  region,    ///< Part of a dual in one of several regions around the element
};
[[nodiscard]] std::string_view name(DualKind kind);
[[nodiscard]] std::span<const std::string_view> words_of(DualKind);

/// An edge whose dual the criterion does not allow.
struct ViolatedEdge {
  HalfedgeId edge;  ///< The halfedge that represents the edge; for a part, the halfedge on its side
  DualKind kind = DualKind::inside;
  double dual_over_l = 0;  ///< Signed length of the dual, or of its part, over the length of the edge
};

/// The violated edges by number of halfedge, each with its dual first and then its parts. They are the same for
/// coefficients and distances, except for duals of length zero. Diagonals of quadrilaterals have no dual.
/// Preconditions: the criterion is not well_centered, all triangles are counter-clockwise. O(n).
[[nodiscard]] std::vector<ViolatedEdge> violated_edges(const Mesh& mesh, Criterion criterion,
                                                       Executor* executor = nullptr);
/// The triangles on both sides of violated edges, or those that are not well-centered. Ascending. Triangles that are
/// not counter-clockwise are among them. O(n).
[[nodiscard]] std::vector<TriangleId> cells_at_violations(const Mesh& mesh, Criterion criterion,
                                                          Executor* executor = nullptr);
/// Says whether a mesh meets a criterion. All triangles must be counter-clockwise, too. O(n).
[[nodiscard]] bool meets(const Mesh& mesh, Criterion criterion, Executor* executor = nullptr);

}  // namespace temper
