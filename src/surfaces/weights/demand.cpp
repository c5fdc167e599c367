#include "surfaces/weights/demand.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/assert.hpp"

namespace temper::surfaces {
namespace {

using Kind = WeightConstraint::Kind;

}  // namespace

std::vector<WeightEdge> CurvedDemand::edges_of(std::span<const CellId> cells) const {
  std::vector<WeightEdge> edges;
  for (const HalfedgeId h : temper::edges_of(mesh(), as_triangles(cells))) {
    const VertexId p = mesh().origin(h), q = mesh().target(h);
    edges.push_back({p, q, squared_distance(p, q)});
  }
  return edges;
}

LinearForm CurvedDemand::linear_form(const WeightConstraint& c) const {
  if (c.kind == Kind::crossing) return crossing_form(c, squared_distance(c.p, c.q));
  const LinearForm left = form_of_height(c.p, c.q, c.r);
  return c.kind == Kind::height ? left : dual_form(c, left, form_of_height(c.q, c.p, c.s));
}

double CurvedDemand::scale_of_polynomial(const WeightConstraint& c) const {
  const double doubled = 2 * squared_distance(c.p, c.q);
  if (c.kind == Kind::crossing) return doubled;
  const double left = doubled * doubled_area(c.p, c.q, c.r);
  return c.kind == Kind::height ? left : left * doubled_area(c.p, c.q, c.s);
}

std::vector<OffsetTerm> CurvedDemand::offsets(const WeightOptions& /*options*/) const {
  TEMPER_ASSERT(false);
  return {};
}

double CurvedDemand::reach(VertexId p, VertexId q, std::span<const VertexId> corners) const {
  const double l2 = squared_distance(p, q);
  if (has_duals()) return (1 + 2 * kCrossingReach) * l2;
  double most = l2;
  for (const VertexId r : corners) {
    if (!has_crossings() && r != p && r != q)
      most = std::max(most, std::abs(squared_distance(p, r) - squared_distance(q, r)));
  }
  return most;
}

LinearForm SurfaceDemand::form_of_height(VertexId p, VertexId q, VertexId r) const {
  return height_form({Kind::height, p, q, r}, from_to(p, q), from_to(p, r), from_to(q, r), doubled_area(p, q, r));
}

bool SurfaceDemand::is_kept(CellId cell, const VertexWeights& weights) const {
  const TriangleId t(cell.index);
  const auto at = [&](VertexId v) {
    WeightedPoint p = surface_.point(v);
    p.w = weights[v];
    return p;
  };
  if (has_crossings()) {
    const auto [a, b, c] = mesh().corners(t);
    return is_well_centered(at(a), at(b), at(c));
  }
  for (int k = 0; k < 3; ++k) {
    const HalfedgeId h = Mesh::halfedge(t, k);
    const WeightedPoint p = at(mesh().origin(h)), q = at(mesh().target(h)), r = at(mesh().opposite(h));
    if (has_height(h) && !is_good(signed_height_sign(p, q, r))) return false;
    if (!has_dual(h)) continue;
    if (!is_good(dual_length_sign(p, q, r, at(mesh().opposite(mesh().twin(h)))))) return false;
  }
  return true;
}

double SurfaceDemand::angle_deg(const WeightConstraint& c) const {
  if (c.kind != Kind::height) return 0;
  const Vec3 to_p = from_to(c.r, c.p), to_q = from_to(c.r, c.q);
  return std::atan2(length(cross(to_p, to_q)), dot(to_p, to_q)) * (180 / std::numbers::pi);
}

CertificateCheck SurfaceDemand::check(const Certificate& certificate) const {
  return check_certificate(surface_, certificate);
}

}  // namespace temper::surfaces
