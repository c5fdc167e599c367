#include "feasibility/constraints.hpp"

#include <algorithm>

namespace temper {

LinearForm linear_form(const Mesh& mesh, const WeightConstraint& constraint) {
  const auto [kind, p, q, r] = constraint;
  const Vec2 pq = mesh.position(q) - mesh.position(p);
  const double l2 = squared_length(pq);
  if (kind == WeightConstraint::Kind::split) return {2, {p, q, {}}, {0.5 / l2, -0.5 / l2, 0}, 0.5};
  const Vec2 pr = mesh.position(r) - mesh.position(p);
  const Vec2 qr = mesh.position(r) - mesh.position(q);
  const double scale = 0.5 / cross(pq, pr);
  return {3, {p, q, r}, {-scale * dot(pq, qr) / l2, scale * dot(pq, pr) / l2, -scale}, scale * dot(pr, qr)};
}

WeightConstraint height_constraint(const Mesh& mesh, HalfedgeId h) {
  return {WeightConstraint::Kind::height, mesh.origin(h), mesh.target(h), mesh.opposite(h)};
}

WeightConstraint split_constraint(VertexId from, VertexId to) {
  return {WeightConstraint::Kind::split, from, to, VertexId()};
}

std::vector<HalfedgeId> edges_of(const Mesh& mesh, std::span<const TriangleId> triangles) {
  std::vector<HalfedgeId> edges;
  for (const TriangleId t : triangles) {
    for (int k = 0; k < 3; ++k) {
      const HalfedgeId h = Mesh::halfedge(t, k);
      const bool seen_from_twin = !mesh.is_edge_representative(h) &&
                                  std::binary_search(triangles.begin(), triangles.end(), Mesh::triangle(mesh.twin(h)));
      if (!seen_from_twin) edges.push_back(h);
    }
  }
  return edges;
}

std::vector<VertexId> vertices_of(const Mesh& mesh, std::span<const TriangleId> triangles) {
  std::vector<VertexId> vertices;
  vertices.reserve(3 * triangles.size());
  for (const TriangleId t : triangles) {
    for (const VertexId v : mesh.corners(t)) vertices.push_back(v);
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

std::vector<WeightConstraint> constraints_of(const Mesh& mesh, std::span<const TriangleId> triangles,
                                             Conditions conditions) {
  std::vector<WeightConstraint> constraints;
  for (const TriangleId t : triangles) {
    for (int k = 0; k < 3; ++k) constraints.push_back(height_constraint(mesh, Mesh::halfedge(t, k)));
  }
  if (conditions == Conditions::heights_only) return constraints;
  for (const HalfedgeId h : edges_of(mesh, triangles)) {
    constraints.push_back(split_constraint(mesh.origin(h), mesh.target(h)));
    constraints.push_back(split_constraint(mesh.target(h), mesh.origin(h)));
  }
  return constraints;
}

}  // namespace temper
