// Heights, crossings and dual lengths as linear functions of the potentials (potential.hpp), over the length of their
// edge.
//
// In the plane, of the weights:
//
//   height  h/ℓ = (D_r + (D_p w_q + D_q w_p)/ℓ² − w_r) / (2 S)      D_p = (q − p)·(r − p), …; S twice the area
//   crossing   d/ℓ = 1/2 + (w_p − w_q)/(2 ℓ²)
//   dual    (h_r + h_s)/ℓ, the sum of the heights over either side
//
// The coefficients of one form sum to zero: a constant on all weights changes nothing.
//
// On the sphere, of σ = R/|P|, where p, q, r are places, D = det(p, q, r), and m = (σ_p + σ_q)/2:
//
//   height  R³/D (σ_r + ((p×q)·(q×r) σ_p + (p×q)·(r×p) σ_q)/|p×q|²) / m      R tan h/ℓ, were all σ one
//   crossing   (R² σ_q − p·q σ_p)/|p − q|² / m                                    1/2; the two of an edge sum to one
//   dual    the sum of the heights over either side / m
//
// All have the signs of h, d and the dual length. They do not change with σ times a number, and tend to the plane's
// values.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "feasibility/demand.hpp"
#include "feasibility/seams.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/feasibility.hpp"
#include "temper/mesh.hpp"

namespace temper {

[[nodiscard]] LinearForm linear_form(const Mesh& mesh, const WeightConstraint& constraint);

/// |p − q|² of places: on the sphere of the chord.
[[nodiscard]] double squared_distance(const Mesh& mesh, VertexId p, VertexId q);
[[nodiscard]] inline double squared_length_of(const Mesh& mesh, HalfedgeId h) {
  return squared_distance(mesh, mesh.origin(h), mesh.target(h));
}

/// The vertex with another weight; unchanged if it has this weight.
[[nodiscard]] inline WeightedPoint point_with_weight(const Mesh& mesh, VertexId v, double w) {
  const WeightedPoint p = mesh.point(v);
  return mesh.space().weight(p) == w ? p : mesh.space().with_weight(p, w);
}

/// Says whether only one triangle has the edge of h, or two of different regions.
[[nodiscard]] inline bool bounds_region(const Mesh& mesh, HalfedgeId h) {
  return mesh.is_boundary(h) || mesh.region(Mesh::triangle(h)) != mesh.region(Mesh::triangle(mesh.twin(h)));
}

/// The height over the edge of h in its triangle, and its dual length.
[[nodiscard]] WeightConstraint height_constraint(const Mesh& mesh, HalfedgeId h);
/// Precondition: h is inside the mesh.
[[nodiscard]] WeightConstraint dual_constraint(const Mesh& mesh, HalfedgeId h);

/// The error of a request that a mesh of triangles cannot have.
[[nodiscard]] std::optional<InputError> expect_request(const Mesh& mesh, const WeightOptions& options,
                                                       const ConvexSolver* convex);

/// Constraints on a mesh of triangles, with their edges. Surfaces override what depends on positions.
class TriangleDemand : public Demand {
 public:
  TriangleDemand(const Mesh& mesh, Constraints constraints, std::span<const HalfedgeId> edges = {});
  /// With the equations of interfaces.
  TriangleDemand(const MetricMesh& pieces, Constraints constraints, std::span<const HalfedgeId> edges = {});

  [[nodiscard]] std::size_t n_vertices() const override { return mesh_.n_vertices(); }
  [[nodiscard]] std::size_t n_cells() const override { return mesh_.n_triangles(); }
  [[nodiscard]] double weight(VertexId v) const override { return mesh_.weight(v); }
  void add_corners(CellId cell, std::vector<VertexId>& corners) const override;
  void add_cells_around(VertexId v, std::vector<CellId>& cells) const override;
  /// Calls use(copy) for v and all its copies on interfaces.
  template <class Use>
  void for_each_copy(VertexId v, const Use& use) const {
    seams_.for_each_copy(v, use);
  }
  void add_vertices_across(VertexId v, std::vector<VertexId>& vertices) const override;
  [[nodiscard]] std::vector<WeightEdge> edges_of(std::span<const CellId> cells) const override;
  [[nodiscard]] std::vector<WeightConstraint> constraints_of(std::span<const CellId> cells, bool rim) const override;
  [[nodiscard]] std::vector<WeightConstraint> equations_of(std::span<const CellId> cells) const override;
  void settle(VertexWeights& weights) const override;
  [[nodiscard]] LinearForm linear_form(const WeightConstraint& constraint) const override;
  [[nodiscard]] double scale_of_polynomial(const WeightConstraint& constraint) const override;
  [[nodiscard]] bool is_kept(CellId cell, const VertexWeights& weights) const override;
  [[nodiscard]] double margin_of(CellId cell, const VertexWeights& weights) const override;
  [[nodiscard]] double angle_deg(const WeightConstraint& constraint) const override;
  [[nodiscard]] CertificateCheck check(const Certificate& certificate) const override;
  [[nodiscard]] std::vector<OffsetTerm> offsets(const WeightOptions& options) const override;
  [[nodiscard]] double reach(VertexId p, VertexId q, std::span<const VertexId> corners) const override;

 protected:
  [[nodiscard]] const Mesh& mesh() const { return mesh_; }
  /// Says whether the height over the edge of h in its triangle counts.
  [[nodiscard]] bool has_height(HalfedgeId h) const {
    return has_heights() || (has_outer_heights() && bounds_region(mesh_, h));
  }
  /// Says whether the dual length of the edge of h counts.
  [[nodiscard]] bool has_dual(HalfedgeId h) const {
    return has_duals() && !mesh_.is_boundary(h) && (prescribed_.empty() || prescribed_[h] != 0);
  }

 private:
  const Mesh& mesh_;
  IdVector<HalfedgeId, std::uint8_t> prescribed_;  ///< none: every edge is
  const MetricMesh* pieces_ = nullptr;             ///< none: there are no interfaces
  Seams seams_;
};

[[nodiscard]] std::vector<CellId> as_cells(std::span<const TriangleId> triangles);
[[nodiscard]] std::vector<TriangleId> as_triangles(std::span<const CellId> cells);

/// The edges of these triangles, each once, by a halfedge that is in one of them. `triangles` is sorted.
[[nodiscard]] std::vector<HalfedgeId> edges_of(const Mesh& mesh, std::span<const TriangleId> triangles);
/// The corners of these triangles, sorted, each once.
[[nodiscard]] std::vector<VertexId> vertices_of(const Mesh& mesh, std::span<const TriangleId> triangles);

}  // namespace temper
