#include "feasibility/constraints.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "base/sort_unique.hpp"
#include "temper/detail/geometry.hpp"

namespace temper {
namespace {

/// h over pq in the triangle pqr and h over qp in qps are one form: the vertices of the second are q, p, s.
LinearForm dual_form(const Mesh& mesh, const WeightConstraint& c) {
  const LinearForm left = linear_form(mesh, {WeightConstraint::Kind::height, c.p, c.q, c.r});
  const LinearForm right = linear_form(mesh, {WeightConstraint::Kind::height, c.q, c.p, c.s});
  const auto& [a, b] = std::tie(left.coefficients, right.coefficients);
  return {4, {c.p, c.q, c.r, c.s}, {a[0] + b[1], a[1] + b[0], a[2], b[2]}, left.constant + right.constant, left.slope};
}

/// The vector from p to the image of v near p.
Vec2 from_to(const Mesh& mesh, VertexId p, VertexId v) {
  const WeightedPoint at = mesh.point(p);
  return mesh.point(v, at).position() - at.position();
}

LinearForm plane_form(const Mesh& mesh, const WeightConstraint& c) {
  const Vec2 pq = from_to(mesh, c.p, c.q);
  if (c.kind == WeightConstraint::Kind::crossing) return crossing_form(c, pq);
  if (c.kind == WeightConstraint::Kind::equal_crossing) return equal_crossing_form(c, pq, from_to(mesh, c.r, c.s));
  const Vec2 pr = from_to(mesh, c.p, c.r);
  return height_form(c, pq, pr, pr - pq, cross(pq, pr));
}

/// Let a = q − p, b = r − p and n = a × b, so that little cancels. Then (p×q)·n = (p·a)(a·b) − (p·b)|a|² is the sum of
/// the three, and (p×q)·(r×p) = −(p×a)·(p×b).
LinearForm sphere_form(const Mesh& mesh, const WeightConstraint& constraint) {
  const auto [kind, vp, vq, vr, vs, vt] = constraint;
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

constexpr double kDegrees = 57.29577951308232;

constexpr std::array<ConstraintsInfo, 5> kConditions = {{
    {Constraints::well_centered, "well_centered", "h >= t l and t l <= d <= (1 - t) l",
     "weights make every triangle well-centered", "no weights make every triangle well-centered"},
    {Constraints::heights_only, "heights_only", "h >= t l", "weights bring every orthocenter inside its triangle",
     "no weights bring every orthocenter inside its triangle"},
    {Constraints::regular, "regular", "dual length >= t l", "weights make these edges regular",
     "no weights make these edges regular, if weights differ by less than 2^20 l^2 along edges"},
    {Constraints::coefficients, "coefficients",
     "dual length >= t l inside, h >= 0 over the boundary and over both sides of interfaces",
     "weights make no coefficient of an edge negative",
     "no weights make all coefficients of edges positive or zero, if weights differ by less than 2^20 l^2 along edges"},
    {Constraints::distances, "distances",
     "dual length >= t l inside, h >= t l over the boundary and over both sides of interfaces",
     "weights make all distances between centers positive",
     "no weights make all distances between centers positive, if weights differ by less than 2^20 l^2 along edges"},
}};

double scale_on_sphere(const Mesh& mesh, const WeightConstraint& c) {
  const Vec3 p = position_of(mesh, c.p), a = position_of(mesh, c.q) - p;
  const double cube = mesh.space().radius() * squared_length(p);
  const auto volume = [&](VertexId v) { return std::abs(dot(p, cross(a, position_of(mesh, v) - p))); };
  switch (c.kind) {
    case WeightConstraint::Kind::height:
      return squared_length(cross(p, a)) * volume(c.r) / cube;
    case WeightConstraint::Kind::dual:
      return volume(c.r) * volume(c.s) / cube;
    default:
      return squared_length(a);
  }
}

}  // namespace

std::span<const ConstraintsInfo> constraints_table() { return kConditions; }

std::string_view name(Constraints constraints) {
  if (constraints == Constraints::completely_well_centered) return "completely_well_centered";
  return kConditions[static_cast<std::size_t>(constraints)].name;
}

std::string_view name(WeightConstraint::Kind kind) {
  constexpr std::array<std::string_view, 6> kNames = {"height",           "crossing",     "dual",
                                                      "height_over_face", "dual_of_face", "equal_crossing"};
  return kNames[static_cast<std::size_t>(kind)];
}

LinearForm linear_form(const Mesh& mesh, const WeightConstraint& constraint) {
  if (constraint.kind == WeightConstraint::Kind::dual) return dual_form(mesh, constraint);
  return mesh.space().is_plane() ? plane_form(mesh, constraint) : sphere_form(mesh, constraint);
}

double squared_distance(const Mesh& mesh, VertexId p, VertexId q) {
  if (mesh.space().is_plane()) return squared_length(from_to(mesh, p, q));
  return squared_length(position_of(mesh, q) - position_of(mesh, p));
}

WeightConstraint height_constraint(const Mesh& mesh, HalfedgeId h) {
  return {WeightConstraint::Kind::height, mesh.origin(h), mesh.target(h), mesh.opposite(h)};
}

WeightConstraint dual_constraint(const Mesh& mesh, HalfedgeId h) {
  return {WeightConstraint::Kind::dual, mesh.origin(h), mesh.target(h), mesh.opposite(h), mesh.opposite(mesh.twin(h))};
}

TriangleDemand::TriangleDemand(const Mesh& mesh, Constraints constraints, std::span<const HalfedgeId> edges)
    : Demand(mesh.space(), constraints, constraints == Constraints::well_centered, WeightConstraint::Kind::dual),
      mesh_(mesh) {
  if (edges.empty()) return;
  prescribed_ = IdVector<HalfedgeId, std::uint8_t>(mesh.n_halfedges(), 0);
  for (const HalfedgeId h : edges) {
    prescribed_[h] = 1;
    if (!mesh.is_boundary(h)) prescribed_[mesh.twin(h)] = 1;
  }
}

TriangleDemand::TriangleDemand(const MetricMesh& pieces, Constraints constraints, std::span<const HalfedgeId> edges)
    : TriangleDemand(pieces.mesh, constraints, edges) {
  if (!pieces.is_cut()) return;
  pieces_ = &pieces;
  std::vector<std::array<VertexId, 2>> copies;
  for (const VertexId v : vertices()) {
    if (pieces.first_copy(v) != v) copies.push_back({pieces.first_copy(v), v});
  }
  std::vector<WeightConstraint> equations;
  for (const auto& [one, other] : seams_of(pieces)) {
    equations.push_back({WeightConstraint::Kind::equal_crossing, mesh_.origin(one), mesh_.target(one),
                         mesh_.target(other), mesh_.origin(other)});
  }
  seams_ = Seams(n_vertices(), copies, std::move(equations));
}

void TriangleDemand::add_corners(CellId cell, std::vector<VertexId>& corners) const {
  for (const VertexId v : mesh_.corners(TriangleId(cell.index))) corners.push_back(v);
}

void TriangleDemand::add_cells_around(VertexId v, std::vector<CellId>& cells) const {
  seams_.for_each_copy(v, [&](VertexId copy) {
    if (mesh_.is_isolated(copy)) return;
    for (const HalfedgeId h : mesh_.star(copy)) cells.emplace_back(Mesh::triangle(h).index);
  });
}

void TriangleDemand::add_vertices_across(VertexId v, std::vector<VertexId>& vertices) const {
  if (mesh_.is_isolated(v)) return;
  for (const HalfedgeId h : mesh_.star(v)) {
    const HalfedgeId outer = Mesh::next(h);
    if (!mesh_.is_boundary(outer)) vertices.push_back(mesh_.opposite(mesh_.twin(outer)));
  }
}

std::vector<WeightEdge> TriangleDemand::edges_of(std::span<const CellId> cells) const {
  std::vector<WeightEdge> edges;
  for (const HalfedgeId h : temper::edges_of(mesh_, as_triangles(cells)))
    edges.push_back({mesh_.origin(h), mesh_.target(h), squared_length_of(mesh_, h)});
  return edges;
}

std::vector<WeightConstraint> TriangleDemand::constraints_of(std::span<const CellId> cells, bool rim) const {
  const std::vector<TriangleId> triangles = as_triangles(cells);
  std::vector<WeightConstraint> constraints;
  for (const TriangleId t : triangles) {
    for (int k = 0; k < 3; ++k) {
      const HalfedgeId h = Mesh::halfedge(t, k);
      if (has_height(h)) constraints.push_back(height_constraint(mesh_, h));
    }
  }
  for (const HalfedgeId h : temper::edges_of(mesh_, triangles)) {
    if (has_crossings()) {
      constraints.push_back(split_constraint(mesh_.origin(h), mesh_.target(h)));
      constraints.push_back(split_constraint(mesh_.target(h), mesh_.origin(h)));
    }
    if (has_dual(h) && (rim || std::binary_search(triangles.begin(), triangles.end(), Mesh::triangle(mesh_.twin(h))))) {
      constraints.push_back(dual_constraint(mesh_, h));
    }
  }
  return constraints;
}

std::vector<WeightConstraint> TriangleDemand::equations_of(std::span<const CellId> cells) const {
  if (seams_.empty()) return {};
  return seams_.equations_among(vertices_of(*this, cells));
}

void TriangleDemand::settle(VertexWeights& weights) const {
  seams_.settle(weights, [this](const WeightConstraint& c) { return linear_form(c); });
}

LinearForm TriangleDemand::linear_form(const WeightConstraint& constraint) const {
  return temper::linear_form(mesh_, constraint);
}

double TriangleDemand::scale_of_polynomial(const WeightConstraint& c) const {
  if (!space().is_plane()) return scale_on_sphere(mesh_, c);
  const Vec2 pq = from_to(mesh_, c.p, c.q);
  const auto area = [&](VertexId v) { return cross(pq, from_to(mesh_, c.p, v)); };
  switch (c.kind) {
    case WeightConstraint::Kind::height:
      return 2 * squared_length(pq) * area(c.r);
    case WeightConstraint::Kind::dual:
      return -2 * area(c.r) * area(c.s);
    case WeightConstraint::Kind::equal_crossing:
      return 2 * squared_length(pq) * squared_length(from_to(mesh_, c.r, c.s));
    default:
      return 2 * squared_length(pq);
  }
}

bool TriangleDemand::is_kept(CellId cell, const VertexWeights& weights) const {
  const TriangleId t(cell.index);
  const auto [a, b, c] = mesh_.corners(t);
  const WeightedPoint near = mesh_.point(a);
  const auto at = [&](VertexId v) { return space().image(point_with_weight(mesh_, v, weights[v]), near); };
  if (has_crossings()) return is_well_centered(space(), at(a), at(b), at(c));
  for (int k = 0; k < 3; ++k) {
    const HalfedgeId h = Mesh::halfedge(t, k);
    const WeightedPoint p = at(mesh_.origin(h)), q = at(mesh_.target(h)), r = at(mesh_.opposite(h));
    if (has_height(h) && !is_good(signed_height_sign(space(), p, q, r))) return false;
    if (!has_dual(h)) continue;
    if (!is_good(-power_test(space(), p, q, r, space().image(at(mesh_.opposite(mesh_.twin(h))), p)))) return false;
  }
  return true;
}

double TriangleDemand::margin_of(CellId cell, const VertexWeights& weights) const {
  double margin = kUnbounded;
  const auto potential = [&](VertexId v) { return potential_of(space(), weights[v]); };
  const auto value = [&](const WeightConstraint& c) { return counted(c, value_of(linear_form(c), potential)); };
  for (int k = 0; k < 3; ++k) {
    const HalfedgeId h = Mesh::halfedge(TriangleId(cell.index), k);
    if (has_height(h)) margin = std::min(margin, value(height_constraint(mesh_, h)));
    if (has_crossings()) {
      const double crossing = value(split_constraint(mesh_.origin(h), mesh_.target(h)));
      margin = std::min({margin, crossing, 1 - crossing});
    }
    if (has_dual(h)) margin = std::min(margin, value(dual_constraint(mesh_, h)));
  }
  return margin;
}

double TriangleDemand::angle_deg(const WeightConstraint& c) const {
  if (c.kind != WeightConstraint::Kind::height) return 0;
  return kDegrees * corner_angle(space(), mesh_.point(c.r), mesh_.point(c.p), mesh_.point(c.q));
}

CertificateCheck TriangleDemand::check(const Certificate& certificate) const {
  return pieces_ != nullptr ? check_certificate(*pieces_, certificate) : check_certificate(mesh_, certificate);
}

double TriangleDemand::reach(VertexId p, VertexId q, std::span<const VertexId> corners) const {
  const bool heights_only = has_heights() && !has_crossings();
  if (space().is_plane()) {
    const double l2 = squared_distance(mesh_, p, q);
    double most = has_duals() ? (1 + 2 * kCrossingReach) * l2 : l2;
    for (const VertexId r : corners) {
      if (heights_only) most = std::max(most, std::abs(squared_distance(mesh_, p, r) - squared_distance(mesh_, q, r)));
    }
    return most;
  }
  // With crossings, p·q/|p|² < σ_q/σ_p < |q|²/p·q. With heights alone, r·q/r·p is another extreme.
  const Vec3 a = position_of(mesh_, p), b = position_of(mesh_, q);
  const auto apart = [](double ratio) { return std::max(std::abs(ratio - 1), std::abs(1 / ratio - 1)); };
  double most = std::max(apart(dot(a, b) / squared_length(a)), apart(squared_length(b) / dot(a, b)));
  for (const VertexId r : corners) {
    const Vec3 c = position_of(mesh_, r);
    if (heights_only) most = std::max(most, apart(dot(c, b) / dot(c, a)));
  }
  if (!has_duals()) return most;
  const double lacking = 1 - dot(a, b) / std::sqrt(squared_length(a) * squared_length(b));
  const double least = 1 - (1 + kCrossingReach) * lacking;  // of σ_q/σ_p, up to a factor above one
  return least > 0 ? (1 + 2 * kCrossingReach) * lacking / least : kUnbounded;
}

std::vector<CellId> as_cells(std::span<const TriangleId> triangles) {
  std::vector<CellId> cells;
  cells.reserve(triangles.size());
  for (const TriangleId t : triangles) cells.emplace_back(t.index);
  return cells;
}

std::vector<TriangleId> as_triangles(std::span<const CellId> cells) {
  std::vector<TriangleId> triangles;
  triangles.reserve(cells.size());
  for (const CellId cell : cells) triangles.emplace_back(cell.index);
  return triangles;
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
  sort_unique(vertices);
  return vertices;
}

}  // namespace temper
