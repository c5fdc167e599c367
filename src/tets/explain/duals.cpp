// Explanations of duals of tetrahedra.
#include "explain/duals.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/assert.hpp"
#include "temper/tets/explain.hpp"
#include "tets/mesh/tables.hpp"
#include "tets/quality/duals.hpp"

namespace temper::tets {
namespace {

double side_over_length(const TetMesh& mesh, HalffaceId h) {
  return dual_over_length(mesh, h, DualKind::region, height_sign(mesh, h));
}

/// The heights over a face on its sides: on both, or on that of h.
std::string heights(const TetMesh& mesh, HalffaceId h, bool both) {
  std::string text = height_text(side_over_length(mesh, h), mesh.opposite(h));
  if (both && !mesh.is_boundary(h))
    text += ", and " + height_text(side_over_length(mesh, mesh.twin(h)), mesh.opposite(mesh.twin(h)));
  return text;
}

std::string name_of(std::span<const VertexId> vertices) {
  std::string text;
  for (const VertexId v : vertices) text += (text.empty() ? "" : "-") + std::to_string(v.index);
  return text;
}

std::string why(const TetMesh& mesh, const ViolatedFace& violated) {
  const auto describe_worst = [&](HalffaceId h) {
    const TetMeasure m = measure_tetrahedron(mesh.points(TetMesh::tetrahedron(h)));
    const auto e = std::max_element(m.dihedral_deg.begin(), m.dihedral_deg.end()) - m.dihedral_deg.begin();
    const auto& corners = mesh.corners(TetMesh::tetrahedron(h));
    const auto& ends = kEdgeCorners[std::size_t(e)];
    return "; the largest dihedral angle there is " + degrees(m.dihedral_deg[std::size_t(e)]) + " at edge " +
           name_of(std::array{corners[std::size_t(ends[0])], corners[std::size_t(ends[1])]});
  };
  const bool both = violated.kind == DualKind::inside;
  HalffaceId lower = violated.face;
  if (both && side_over_length(mesh, mesh.twin(lower)) < side_over_length(mesh, lower)) lower = mesh.twin(lower);
  return heights(mesh, lower, both) + describe_worst(lower);
}

/// A face around an edge, and its part of the coefficient.
struct EdgeFace {
  HalffaceId face;
  VertexId apex;  ///< third vertex of the face
  double k_over_l = 0, over_l2 = 0;
};

EdgeFace part_of(const TetMesh& mesh, HalffaceId h, const std::array<VertexId, 2>& edge, bool both) {
  EdgeFace part = {h, {}};
  for (const VertexId v : mesh.vertices(h)) {
    if (v != edge[0] && v != edge[1]) part.apex = v;
  }
  const WeightedPoint p = mesh.point(edge[0]), q = mesh.point(edge[1]);
  const double l = length(q.position() - p.position());
  const auto [a, b, c] = points_of(mesh, h);
  double dual = signed_height(a, b, c, mesh.point(mesh.opposite(h)));
  if (both && !mesh.is_boundary(h)) dual += signed_height(a, c, b, mesh.point(mesh.opposite(mesh.twin(h))));
  part.k_over_l = signed_height(p, q, mesh.point(part.apex)) / l;
  part.over_l2 = part.k_over_l * dual / (2 * l);
  return part;
}

std::string why(const TetMesh& mesh, const VertexStars& stars, const ViolatedEdge& violated) {
  EdgeFace worst;
  stars.for_each_around(mesh, violated.vertices, [&](TetId t) {
    if (violated.kind == DualKind::region && mesh.region(t) != violated.region) return;
    for (int f = 0; f < 4; ++f) {
      const HalffaceId h = TetMesh::halfface(t, f);
      if (std::ranges::find(violated.vertices, mesh.opposite(h)) != violated.vertices.end()) continue;
      const bool both = violated.kind != DualKind::region || !mesh.bounds_region(h);
      const EdgeFace part = part_of(mesh, h, violated.vertices, both);
      if (!worst.face.valid() || part.over_l2 < worst.over_l2) worst = part;
    }
  });
  const bool both = violated.kind != DualKind::region || !mesh.bounds_region(worst.face);
  const Vec3 apex = mesh.position(worst.apex), p = mesh.position(violated.vertices[0]) - apex,
             q = mesh.position(violated.vertices[1]) - apex;
  const double angle = std::atan2(length(cross(p, q)), dot(p, q)) * 180 / std::numbers::pi;
  return (violated.kind == DualKind::region ? "in region " + std::to_string(violated.region) + " " : std::string()) +
         "the worst part, " + rounded(worst.over_l2) + ", is at face " + name_of(mesh.vertices(worst.face)) +
         ": height in the face over the edge k/ℓ = " + rounded(worst.k_over_l) + ", where vertex " +
         std::to_string(worst.apex.index) + " has an angle of " + degrees(angle) + "; heights over the face " +
         heights(mesh, worst.face, both);
}

template <class Vertices>
DualReason reason(const TetMesh& mesh, const Vertices& vertices, DualKind kind, double over_l, std::string why) {
  DualReason result = {{vertices.begin(), vertices.end()}, kind, over_l, {}, std::move(why)};
  for (const VertexId v : vertices)
    result.at = result.at + 1.0 / static_cast<double>(vertices.size()) * mesh.position(v);
  return result;
}

}  // namespace

DualExplanation explain_duals(const TetMesh& mesh, Criterion criterion, std::size_t most, Executor* executor) {
  TEMPER_ASSERT(criterion != Criterion::well_centered);
  if (criterion == Criterion::distances) {
    return worst_of(
        criterion, violated_faces(mesh, executor), most, [](const ViolatedFace& v) { return v.dual_over_l; },
        [&](const ViolatedFace& v) {
          return reason(mesh, mesh.vertices(v.face), v.kind, v.dual_over_l, why(mesh, v));
        });
  }
  const VertexStars stars(mesh);
  return worst_of(
      criterion, violated_edges(mesh, executor), most, [](const ViolatedEdge& v) { return v.dual_over_l2; },
      [&](const ViolatedEdge& v) { return reason(mesh, v.vertices, v.kind, v.dual_over_l2, why(mesh, stars, v)); });
}

}  // namespace temper::tets
