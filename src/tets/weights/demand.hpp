// Constraints on the weights of tetrahedra.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "feasibility/demand.hpp"
#include "feasibility/seams.hpp"
#include "temper/tets/tensor.hpp"
#include "tets/weights/surface.hpp"

namespace temper::tets {

/// The heights over faces are linear in the weights: h/ℓ = n · Σ λ_v n_v / (4 ℓ A V) (temper/tets/weights.hpp).
class TetDemand final : public Demand {
 public:
  TetDemand(const TetMesh& mesh, Constraints constraints);
  /// With the equations of interfaces.
  TetDemand(const MetricMesh& pieces, Constraints constraints);

  [[nodiscard]] std::size_t n_vertices() const override { return mesh_.n_vertices(); }
  [[nodiscard]] std::size_t n_cells() const override { return mesh_.n_tetrahedra(); }
  [[nodiscard]] double weight(VertexId v) const override { return mesh_.weight(v); }
  void add_corners(CellId cell, std::vector<VertexId>& corners) const override;
  void add_cells_around(VertexId v, std::vector<CellId>& cells) const override;
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

 private:
  [[nodiscard]] std::span<const TetId> star(VertexId v) const {
    return {star_.data() + star_start_[v.index], star_.data() + star_start_[v.index + 1]};
  }
  [[nodiscard]] WeightConstraint over_face(HalffaceId h) const;
  /// Precondition: h is inside the mesh.
  [[nodiscard]] WeightConstraint dual(HalffaceId h) const;
  [[nodiscard]] LinearForm form_over_face(VertexId p, VertexId q, VertexId r, VertexId s) const;
  [[nodiscard]] LinearForm dual_form(const WeightConstraint& constraint) const;
  /// Of an edge between two flat faces.
  [[nodiscard]] LinearForm surface_form(const WeightConstraint& constraint) const;
  void add_surface_rows(std::span<const CellId> cells, bool rim, std::vector<WeightConstraint>& all) const;

  const TetMesh& mesh_;
  SurfaceRows surface_;                    ///< of coefficients
  std::vector<std::uint32_t> star_start_;  ///< of the tetrahedra around each vertex
  std::vector<TetId> star_;
  const MetricMesh* pieces_ = nullptr;  ///< none: there are no interfaces
  Seams seams_;
};

/// The equations of the edges of interfaces, each once: pq is the copy of rs with lower numbers.
[[nodiscard]] std::vector<WeightConstraint> equations_of_seams(const MetricMesh& pieces);

}  // namespace temper::tets
