#include "feasibility/constraints.hpp"

#include <algorithm>
#include <array>
#include <tuple>

namespace temper {
namespace {

/// h over pq in the triangle pqr and h over qp in qps are one form: the vertices of the second are q, p, s.
LinearForm dual_form(const Mesh& mesh, const WeightConstraint& c) {
  const LinearForm left = linear_form(mesh, {WeightConstraint::Kind::height, c.p, c.q, c.r});
  const LinearForm right = linear_form(mesh, {WeightConstraint::Kind::height, c.q, c.p, c.s});
  const auto& [a, b] = std::tie(left.coefficients, right.coefficients);
  return {4, {c.p, c.q, c.r, c.s}, {a[0] + b[1], a[1] + b[0], a[2], b[2]}, left.constant + right.constant, left.slope};
}

LinearForm plane_form(const Mesh& mesh, const WeightConstraint& constraint) {
  const auto [kind, p, q, r, s] = constraint;
  const Vec2 pq = mesh.position(q) - mesh.position(p);
  const double l2 = squared_length(pq);
  if (kind == WeightConstraint::Kind::crossing) return {2, {p, q}, {0.5 / l2, -0.5 / l2}, 0.5};
  const Vec2 pr = mesh.position(r) - mesh.position(p);
  const Vec2 qr = mesh.position(r) - mesh.position(q);
  const double scale = 0.5 / cross(pq, pr);
  return {3, {p, q, r, {}}, {-scale * dot(pq, qr) / l2, scale * dot(pq, pr) / l2, -scale, 0}, scale * dot(pr, qr)};
}

/// Let a = q − p, b = r − p and n = a × b, so that little cancels. Then (p×q)·n = (p·a)(a·b) − (p·b)|a|² is the sum of
/// the three, and (p×q)·(r×p) = −(p×a)·(p×b).
LinearForm sphere_form(const Mesh& mesh, const WeightConstraint& constraint) {
  const auto [kind, vp, vq, vr, vs] = constraint;
  const double slope = slope_of_scale(mesh.space()), radius = mesh.space().radius();
  const Vec3 p = position_of(mesh, vp), a = position_of(mesh, vq) - p;
  if (kind == WeightConstraint::Kind::crossing) {
    const double at_q = -0.5 / squared_length(a);  // slope · R²/ℓ²
    return {2, {vp, vq}, {-0.5 * slope - at_q, at_q}, 0.5, slope};
  }
  const Vec3 b = position_of(mesh, vr) - p, pa = cross(p, a), pb = cross(p, b);
  const double scale = radius * radius * radius / dot(p, cross(a, b)), pa2 = squared_length(pa);
  const double constant = scale * (dot(p, a) * dot(a, b) - dot(p, b) * squared_length(a)) / pa2;
  const double at_q = slope * scale * dot(pa, pb) / pa2, at_r = -slope * scale;
  return {3, {vp, vq, vr, {}}, {-slope * constant - at_q - at_r, at_q, at_r, 0}, constant, slope};
}

constexpr std::array<ConstraintsInfo, 3> kConditions = {{
    {Constraints::well_centered, "well_centered", "h >= t l and t l <= d <= (1 - t) l",
     "weights make every triangle well-centered", "no weights make every triangle well-centered"},
    {Constraints::heights_only, "heights_only", "h >= t l", "weights bring every orthocenter inside its triangle",
     "no weights bring every orthocenter inside its triangle"},
    {Constraints::regular, "regular", "dual length >= t l", "weights make these edges regular",
     "no weights make these edges regular, if weights differ by less than 2^20 l^2 along edges"},
}};

}  // namespace

std::span<const ConstraintsInfo> constraints_table() { return kConditions; }

std::string_view name(Constraints constraints) { return kConditions[static_cast<std::size_t>(constraints)].name; }

std::string_view name(WeightConstraint::Kind kind) {
  constexpr std::array<std::string_view, 3> kNames = {"height", "crossing", "dual"};
  return kNames[static_cast<std::size_t>(kind)];
}

LinearForm linear_form(const Mesh& mesh, const WeightConstraint& constraint) {
  if (constraint.kind == WeightConstraint::Kind::dual) return dual_form(mesh, constraint);
  return mesh.space().is_plane() ? plane_form(mesh, constraint) : sphere_form(mesh, constraint);
}

LinearForm beyond_margin(LinearForm form, double margin) {
  form.constant -= margin;
  for (int k = 0; k < 2; ++k) form.coefficients[k] += 0.5 * margin * form.slope;
  return form;
}

double squared_distance(const Mesh& mesh, VertexId p, VertexId q) {
  if (mesh.space().is_plane()) return squared_length(mesh.position(q) - mesh.position(p));
  return squared_length(position_of(mesh, q) - position_of(mesh, p));
}

WeightConstraint height_constraint(const Mesh& mesh, HalfedgeId h) {
  return {WeightConstraint::Kind::height, mesh.origin(h), mesh.target(h), mesh.opposite(h)};
}

WeightConstraint split_constraint(VertexId from, VertexId to) {
  return {WeightConstraint::Kind::crossing, from, to, VertexId()};
}

WeightConstraint dual_constraint(const Mesh& mesh, HalfedgeId h) {
  return {WeightConstraint::Kind::dual, mesh.origin(h), mesh.target(h), mesh.opposite(h), mesh.opposite(mesh.twin(h))};
}

Demand::Demand(const Mesh& mesh, Constraints constraints, std::span<const HalfedgeId> edges)
    : constraints_(constraints), in_plane_(mesh.space().is_plane()) {
  if (edges.empty()) return;
  prescribed_ = IdVector<HalfedgeId, std::uint8_t>(mesh.n_halfedges(), 0);
  for (const HalfedgeId h : edges) {
    prescribed_[h] = 1;
    if (!mesh.is_boundary(h)) prescribed_[mesh.twin(h)] = 1;
  }
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
                                             const Demand& demand) {
  std::vector<WeightConstraint> constraints;
  for (const TriangleId t : triangles) {
    for (int k = 0; k < 3 && demand.has_heights(); ++k) {
      constraints.push_back(height_constraint(mesh, Mesh::halfedge(t, k)));
    }
  }
  for (const HalfedgeId h : edges_of(mesh, triangles)) {
    if (demand.has_crossings()) {
      constraints.push_back(split_constraint(mesh.origin(h), mesh.target(h)));
      constraints.push_back(split_constraint(mesh.target(h), mesh.origin(h)));
    }
    if (demand.has_dual(mesh, h) &&
        std::binary_search(triangles.begin(), triangles.end(), Mesh::triangle(mesh.twin(h)))) {
      constraints.push_back(dual_constraint(mesh, h));
    }
  }
  return constraints;
}

}  // namespace temper
