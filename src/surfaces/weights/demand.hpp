// Constraints on the weights of a surface: the plane's linear forms, with edges as vectors in space.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "feasibility/constraints.hpp"
#include "temper/surfaces.hpp"

namespace temper::surfaces {

/// Connectivity, constraints and their order are the plane's (feasibility/constraints.hpp), and lengths the surface's.
class CurvedDemand : public TriangleDemand {
 public:
  CurvedDemand(const Mesh& mesh, Constraints constraints, std::span<const HalfedgeId> edges)
      : TriangleDemand(mesh, constraints, edges) {
    set_curved();
  }

  [[nodiscard]] std::vector<WeightEdge> edges_of(std::span<const CellId> cells) const override;
  [[nodiscard]] LinearForm linear_form(const WeightConstraint& constraint) const override;
  /// N and M of heights and crossings are as in the plane. Of a dual, with S and T twice the areas of pqr and qps:
  /// N = N_r T + N_s S = 2 (h_r + h_s) ℓ S T, M = 2 ℓ² S T.
  [[nodiscard]] double scale_of_polynomial(const WeightConstraint& constraint) const override;
  /// Precondition: no goal of the caller needs it.
  [[nodiscard]] std::vector<OffsetTerm> offsets(const WeightOptions& options) const override;
  [[nodiscard]] double reach(VertexId p, VertexId q, std::span<const VertexId> corners) const override;

 private:
  [[nodiscard]] virtual double squared_distance(VertexId p, VertexId q) const = 0;
  /// Twice the area of the triangle with the edge pq and the corner r.
  [[nodiscard]] virtual double doubled_area(VertexId p, VertexId q, VertexId r) const = 0;
  [[nodiscard]] virtual LinearForm form_of_height(VertexId p, VertexId q, VertexId r) const = 0;
};

class SurfaceDemand final : public CurvedDemand {
 public:
  SurfaceDemand(const SurfaceMesh& surface, Constraints constraints, std::span<const HalfedgeId> edges = {})
      : CurvedDemand(surface.connectivity(), constraints, edges), surface_(surface) {}

  [[nodiscard]] bool is_kept(CellId cell, const VertexWeights& weights) const override;
  [[nodiscard]] double angle_deg(const WeightConstraint& constraint) const override;
  [[nodiscard]] CertificateCheck check(const Certificate& certificate) const override;

 private:
  [[nodiscard]] Vec3 from_to(VertexId a, VertexId b) const { return surface_.position(b) - surface_.position(a); }
  [[nodiscard]] double squared_distance(VertexId p, VertexId q) const override { return squared_length(from_to(p, q)); }
  [[nodiscard]] double doubled_area(VertexId p, VertexId q, VertexId r) const override {
    return length(cross(from_to(p, q), from_to(p, r)));
  }
  [[nodiscard]] LinearForm form_of_height(VertexId p, VertexId q, VertexId r) const override;

  const SurfaceMesh& surface_;
};

/// The error of a request that a surface cannot have.
[[nodiscard]] std::optional<InputError> expect_surface_request(const Mesh& mesh, const WeightOptions& options,
                                                               const ConvexSolver* convex);

/// The same for triangulations that are known by their squared lengths.
class IntrinsicDemand final : public CurvedDemand {
 public:
  IntrinsicDemand(const IntrinsicMesh& surface, Constraints constraints, std::span<const HalfedgeId> edges = {})
      : CurvedDemand(surface.connectivity(), constraints, edges), surface_(surface) {}

  [[nodiscard]] bool is_kept(CellId cell, const VertexWeights& weights) const override;
  [[nodiscard]] double angle_deg(const WeightConstraint& constraint) const override;
  [[nodiscard]] CertificateCheck check(const Certificate& certificate) const override;

 private:
  /// The triangle of the halfedge from p to q, or of its twin.
  [[nodiscard]] MetricTriangle triangle(VertexId p, VertexId q) const;
  [[nodiscard]] double squared_distance(VertexId p, VertexId q) const override { return triangle(p, q).pq; }
  [[nodiscard]] double doubled_area(VertexId p, VertexId q, VertexId r) const override;
  [[nodiscard]] LinearForm form_of_height(VertexId p, VertexId q, VertexId r) const override;

  const IntrinsicMesh& surface_;
};

}  // namespace temper::surfaces
