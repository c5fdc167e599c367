// Insertion and split: ask and price.
//
//        d                        d              v is put into triangle abc (or on one of its edges) and joined to its
//       / \                      /|\             corners. If an edge of the link (here ab) conflicts with v, it is
//      /   \                    / | \            flipped to vd. Then ad and db are tested in the same way. So the
//     a-----b        →         a  |  b           cavity grows over the triangles whose power circle conflicts with v.
//      \ v /                    \ | /            It never crosses constrained edges, and stays star-shaped.
//       \ /                      \|/
//        c                        c              keeps: flags, regions, all old vertices
//
// Whether ab can be flipped depends on v, a, b and d alone, not on earlier flips. So one pass around the link is
// enough, and its order does not matter for the set of replaced triangles. If ab conflicts and cannot be flipped, an
// end of it has lost its power cell to v, or was hidden before.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/assert.hpp"
#include "geometry/predicates_inline.hpp"
#include "geometry/surface.hpp"
#include "temper/detail/space.hpp"
#include "temper/topology.hpp"
#include "topology/locate.hpp"

namespace temper {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

/// `linear` if it is between low and high, or the interval is empty; else the nearest number in its middle half.
double in_middle_half(double linear, double low, double high) {
  if (low >= high || (low < linear && linear < high)) return linear;
  const double quarter = 0.25 * (high - low);
  return std::clamp(linear, low + quarter, high - quarter);
}

/// The vertex that divides the edge ab a part t of the way, 0 < t < 1; in the plane split_weight() gives its weight. On
/// the sphere tℓ is an arc, and weights are compared as σ = R/|P|. The condition |w − w_a| < t²ℓ² of the plane becomes
/// σ_a cos(tℓ) < σ < σ_a / cos(tℓ).
WeightedPoint split_point(const Space& space, const WeightedPoint& a, const WeightedPoint& b, double t) {
  if (space.is_plane()) {
    const Vec2 step = b.position() - a.position(), p = a.position() + t * step;
    return {p.x, p.y, split_weight(a.w, b.w, squared_length(step), t)};
  }
  const Surface surface(space);
  const Vec3 from = surface.place(a), to = surface.place(b), p = surface.between(from, to, t);
  // The piece ap has both d inside when σ_a cos(ap) < σ < σ_a / cos(ap), σ = R/|P|, and the other likewise.
  const double r = space.radius(), r2 = r * r;
  const double sigma_a = r / length(as_vector(a)), sigma_b = r / length(as_vector(b));
  const double cos_a = std::cos(arc_length(from, p)), cos_b = std::cos(arc_length(p, to));
  const auto highest = [](double sigma, double cosine) { return cosine > 0 ? sigma / cosine : kNoLimit; };
  const double w = space.weight(a) + t * (space.weight(b) - space.weight(a)), linear = r / std::sqrt(r2 + w);
  const double sigma = in_middle_half(linear, std::max(sigma_a * cos_a, sigma_b * cos_b),
                                      std::min(highest(sigma_a, cos_a), highest(sigma_b, cos_b)));
  return space.vertex_at(p, sigma == linear ? w : r2 * (1 / (sigma * sigma) - 1));
}

/// Does the new vertex conflict with the triangle of h?
bool conflicts(const Mesh& mesh, HalfedgeId h, const WeightedPoint& p) {
  const auto [a, b, c] = mesh.points(mesh.origin(h), mesh.target(h), mesh.opposite(h));
  return inlined::power_test(mesh.space(), a, b, c, mesh.space().image(p, a)) == Sign::positive;
}

bool is_counter_clockwise(const Mesh& mesh, const WeightedPoint& p, VertexId a, VertexId b) {
  const WeightedPoint q = mesh.point(a, p), r = mesh.point(b, p);
  return mesh.space().are_near(q, r) && inlined::orientation(mesh.space(), p, q, r) == Sign::positive;
}

InsertionPlan begin_plan(InsertionStatus status, const WeightedPoint& p, InsertionPlan storage) {
  storage.status = status;
  storage.point = p;
  storage.triangle = {};
  storage.edge = {};
  storage.cavity.clear();
  storage.link.clear();
  storage.rim.clear();
  storage.flips.clear();
  return storage;
}

/// The rim of a point in triangle t: from its corner of smallest number on.
void begin_in_triangle(const Mesh& mesh, TriangleId t, InsertionPlan& plan) {
  HalfedgeId first = Mesh::halfedge(t, 0);
  for (int k = 1; k < 3; ++k) {
    if (mesh.origin(Mesh::halfedge(t, k)) < mesh.origin(first)) first = Mesh::halfedge(t, k);
  }
  plan.triangle = t;
  plan.cavity = {t};
  plan.rim.assign({first, Mesh::next(first), Mesh::prev(first)});
}

/// The rim of a point on the edge of h: both triangles without it.
void begin_on_edge(const Mesh& mesh, HalfedgeId h, InsertionPlan& plan) {
  plan.triangle = Mesh::triangle(h);
  plan.edge = h;
  for (const HalfedgeId side : {h, mesh.twin(h)}) {
    if (!side.valid()) continue;
    plan.cavity.push_back(Mesh::triangle(side));
    plan.rim.push_back(Mesh::next(side));
    plan.rim.push_back(Mesh::prev(side));
  }
}

/// Flips edges of the link while they conflict. False when one conflicts and cannot be flipped.
bool grow(const Mesh& mesh, InsertionPlan& plan) {
  bool all = true;
  for (std::size_t i = 0; i < plan.rim.size();) {
    const HalfedgeId h = plan.rim[i], g = mesh.twin(h);
    if (!g.valid() || mesh.is_constrained(h) || !conflicts(mesh, g, plan.point)) {
      ++i;
      continue;
    }
    const VertexId a = mesh.origin(h), b = mesh.target(h), d = mesh.opposite(g);
    if (!is_counter_clockwise(mesh, plan.point, a, d) || !is_counter_clockwise(mesh, plan.point, d, b)) {
      all = false;
      ++i;
      continue;
    }
    plan.flips.push_back({a, b});
    plan.cavity.push_back(Mesh::triangle(g));
    plan.rim[i] = Mesh::next(g);
    plan.rim.insert(plan.rim.begin() + static_cast<std::ptrdiff_t>(i + 1), Mesh::prev(g));
  }
  return all;
}

/// Grids of quadrilaterals are orthogonal. A vertex beside them would move the center across one of their sides.
bool is_side_of_quadrilateral(const Mesh& mesh, HalfedgeId h) {
  const HalfedgeId across = mesh.twin(h);
  return across.valid() && mesh.is_half(Mesh::triangle(across));
}

void write_link(const Mesh& mesh, InsertionPlan& plan) {
  for (const HalfedgeId h : plan.rim) plan.link.push_back(mesh.origin(h));
  if (plan.edge.valid() && mesh.is_boundary(plan.edge)) plan.link.push_back(mesh.target(plan.rim.back()));
}

/// Are the new edges from the new vertex to link[i] regular? The halves of a constrained edge need not be.
bool spokes_are_regular(const Mesh& mesh, const InsertionPlan& plan) {
  const std::size_t n = plan.link.size();
  const bool open = n > plan.rim.size();
  const bool has_line = plan.edge.valid() && mesh.is_constrained(plan.edge);
  for (std::size_t i = 0; i < n; ++i) {
    if (open && (i == 0 || i + 1 == n)) continue;
    const VertexId before = plan.link[(i + n - 1) % n], at = plan.link[i], after = plan.link[(i + 1) % n];
    if (has_line && (at == mesh.origin(plan.edge) || at == mesh.target(plan.edge))) continue;
    const WeightedPoint& v = plan.point;
    if (inlined::power_test(mesh.space(), v, mesh.point(before, v), mesh.point(at, v), mesh.point(after, v)) ==
        Sign::positive) {
      return false;
    }
  }
  return true;
}

/// Completes the plan from the first cavity. Precondition: the first triangles are counter-clockwise.
void complete(const Mesh& mesh, InsertionPlan& plan) {
  if (std::ranges::any_of(plan.cavity, [&](TriangleId t) { return mesh.is_half(t); })) {
    plan.status = InsertionStatus::in_quadrilateral;
    return;
  }
  const auto shows = [&](TriangleId t) { return conflicts(mesh, Mesh::halfedge(t, 0), plan.point); };
  if (!std::all_of(plan.cavity.begin(), plan.cavity.end(), shows)) {
    plan.status = InsertionStatus::hidden;
    return;
  }
  const bool all = grow(mesh, plan);
  if (std::ranges::any_of(plan.rim, [&](HalfedgeId h) { return is_side_of_quadrilateral(mesh, h); })) {
    plan.status = InsertionStatus::in_quadrilateral;
    return;
  }
  write_link(mesh, plan);
  plan.status = all && spokes_are_regular(mesh, plan) ? InsertionStatus::possible : InsertionStatus::not_regular;
}

}  // namespace

InsertionPlan plan_insertion(const Mesh& mesh, const WeightedPoint& p, TriangleId near, InsertionPlan storage) {
  InsertionPlan plan = begin_plan(InsertionStatus::outside, p, std::move(storage));
  const Location location = locate(mesh, p, near);
  plan.triangle = location.triangle;
  switch (location.kind) {
    case Location::Kind::outside:
      return plan;
    case Location::Kind::at_vertex:
      plan.status = InsertionStatus::at_vertex;
      return plan;
    case Location::Kind::in_triangle:
      begin_in_triangle(mesh, location.triangle, plan);
      break;
    case Location::Kind::on_edge:
      plan.edge = location.edge;
      if (mesh.is_boundary(location.edge)) {
        plan.status = InsertionStatus::on_boundary;
        return plan;
      }
      if (mesh.is_constrained(location.edge)) {
        plan.status = InsertionStatus::on_constrained;
        return plan;
      }
      begin_on_edge(mesh, location.edge, plan);
      break;
  }
  complete(mesh, plan);
  return plan;
}

InsertionPlan plan_split(const Mesh& mesh, HalfedgeId h, const WeightedPoint& p, InsertionPlan storage) {
  InsertionPlan plan = begin_plan(InsertionStatus::at_vertex, p, std::move(storage));
  const VertexId a = mesh.origin(h), b = mesh.target(h);
  begin_on_edge(mesh, h, plan);
  if (mesh.space().same_place(p, mesh.point(a, p)) || mesh.space().same_place(p, mesh.point(b, p))) return plan;
  const auto is_ccw = [&](HalfedgeId side) {
    return is_counter_clockwise(mesh, p, mesh.origin(side), mesh.target(side));
  };
  if (!std::all_of(plan.rim.begin(), plan.rim.end(), is_ccw)) {
    plan.status = InsertionStatus::inverted;
    return plan;
  }
  complete(mesh, plan);
  return plan;
}

InsertionPlan plan_split(const Mesh& mesh, HalfedgeId h, double t, InsertionPlan storage) {
  // From the end of smaller number: both sides of the edge give the same bits.
  VertexId from = mesh.origin(h), to = mesh.target(h);
  if (to < from) std::swap(from, to), t = 1 - t;
  const WeightedPoint a = mesh.point(from), b = mesh.point(to, a);
  return plan_split(mesh, h, split_point(mesh.space(), a, b, t), std::move(storage));
}

double interpolated_weight(const Mesh& mesh, TriangleId t, Vec2 p) {
  TEMPER_ASSERT(mesh.space().dimension() == 2);
  const auto [pa, pb, pc] = mesh.points(t);
  p = mesh.space().image({p.x, p.y, 0}, pa).position();
  const double area = doubled_area(pa.position(), pb.position(), pc.position());
  const double at_b = doubled_area(pa.position(), p, pc.position()) / area;
  const double at_c = doubled_area(pa.position(), pb.position(), p) / area;
  return pa.w + (at_b * (pb.w - pa.w) + at_c * (pc.w - pa.w));
}

double split_weight(double w_a, double w_b, double squared_length, double t) {
  // The piece of length tℓ has both d inside when |w − w_a| < t²ℓ², and the other likewise.
  const double reach_a = t * t * squared_length, reach_b = (1 - t) * (1 - t) * squared_length;
  return in_middle_half(w_a + t * (w_b - w_a), std::max(w_a - reach_a, w_b - reach_b),
                        std::min(w_a + reach_a, w_b + reach_b));
}

}  // namespace temper
