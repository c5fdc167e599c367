#include "feasibility/sight.hpp"

#include <algorithm>

#include "geometry/predicates_inline.hpp"

namespace temper {

Sight::Sight(const Mesh& mesh) : mesh_(mesh), n_(mesh.n_vertices()), kinds_(n_ * n_, kHidden) {
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_edge_representative(h)) continue;
    if (mesh.is_boundary(h)) {
      walls_.push_back(h);
    } else if (mesh.is_constrained(h)) {
      lines_.push_back(h);
    }
  }
  for (const VertexId p : mesh.vertices()) {
    for (const VertexId q : mesh.vertices()) {
      if (q < p) kinds_[p.index * n_ + q.index] = kinds_[q.index * n_ + p.index] = kind_of(p, q);
    }
  }
}

Sight::Kind Sight::kind_of(VertexId p, VertexId q) const {
  if (mesh_.is_isolated(p) || mesh_.is_isolated(q)) return kHidden;
  const HalfedgeId h = mesh_.find_halfedge(p, q), back = mesh_.find_halfedge(q, p);
  if (h.valid() || back.valid()) return mesh_.is_unflippable(h.valid() ? h : back) ? kKept : kEdge;
  const auto is_between = [&](VertexId v) { return !mesh_.is_isolated(v) && is_on_segment(v, p, q); };
  const auto is_crossed = [&](HalfedgeId wall) { return cross(p, q, mesh_.origin(wall), mesh_.target(wall)); };
  const auto vertices = mesh_.vertices();
  if (std::any_of(vertices.begin(), vertices.end(), is_between)) return kHidden;
  if (std::any_of(walls_.begin(), walls_.end(), is_crossed) || !leaves_into_domain(p, q)) return kHidden;
  return std::any_of(lines_.begin(), lines_.end(), is_crossed) ? kSeen : kEdge;
}

/// Says whether a triangle at p lies around the start of the segment pq. No vertex lies on pq, so no edge at p does.
bool Sight::leaves_into_domain(VertexId p, VertexId q) const {
  for (const HalfedgeId h : mesh_.star(p)) {
    const Vec2 at = mesh_.position(p), to = mesh_.position(q);
    if (inlined::orient2d(at, mesh_.position(mesh_.target(h)), to) == Sign::positive &&
        inlined::orient2d(at, to, mesh_.position(mesh_.opposite(h))) == Sign::positive) {
      return true;
    }
  }
  return false;
}

bool Sight::is_on_segment(VertexId v, VertexId p, VertexId q) const {
  if (v == p || v == q) return false;
  const Vec2 at = mesh_.position(v), a = mesh_.position(p), b = mesh_.position(q);
  if (inlined::orient2d(a, b, at) != Sign::zero) return false;
  const auto is_between = [](double x, double from, double to) {
    return (from <= x && x <= to) || (to <= x && x <= from);
  };
  return is_between(at.x, a.x, b.x) && is_between(at.y, a.y, b.y);
}

bool Sight::is_inside(VertexId v, VertexId p, VertexId q, VertexId r) const {
  if (v == p || v == q || v == r) return false;
  const Vec2 at = mesh_.position(v), a = mesh_.position(p), b = mesh_.position(q), c = mesh_.position(r);
  return inlined::orient2d(a, b, at) == Sign::positive && inlined::orient2d(b, c, at) == Sign::positive &&
         inlined::orient2d(c, a, at) == Sign::positive;
}

// No side of pqr meets the boundary, except that it may be a part of it. So if no vertex of the boundary is inside, the
// inside is in the domain or outside as a whole. A side that is on the boundary tells which, and any other side is in
// the domain.
bool Sight::holds_triangle(VertexId p, VertexId q, VertexId r) const {
  if (!see_each_other(p, q) || !see_each_other(q, r) || !see_each_other(r, p)) return false;
  if (inlined::orient2d(mesh_.position(p), mesh_.position(q), mesh_.position(r)) != Sign::positive) return false;
  const auto is_outer_side = [&](VertexId a, VertexId b) {
    return !mesh_.find_halfedge(a, b).valid() && mesh_.find_halfedge(b, a).valid();
  };
  if (is_outer_side(p, q) || is_outer_side(q, r) || is_outer_side(r, p)) return false;
  return std::none_of(walls_.begin(), walls_.end(),
                      [&](HalfedgeId wall) { return is_inside(mesh_.origin(wall), p, q, r); });
}

bool Sight::can_be_triangle(VertexId p, VertexId q, VertexId r) const {
  if (!can_be_edge(p, q) || !can_be_edge(q, r) || !can_be_edge(r, p) || !holds_triangle(p, q, r)) return false;
  const auto vertices = mesh_.vertices();
  return std::none_of(vertices.begin(), vertices.end(),
                      [&](VertexId v) { return !mesh_.is_isolated(v) && is_inside(v, p, q, r); });
}

bool Sight::cross(VertexId a, VertexId b, VertexId c, VertexId d) const {
  if (a == c || a == d || b == c || b == d) return false;
  const Vec2 p = mesh_.position(a), q = mesh_.position(b), r = mesh_.position(c), s = mesh_.position(d);
  const auto are_opposite = [](Sign x, Sign y) { return x != Sign::zero && y != Sign::zero && x != y; };
  return are_opposite(inlined::orient2d(p, q, r), inlined::orient2d(p, q, s)) &&
         are_opposite(inlined::orient2d(r, s, p), inlined::orient2d(r, s, q));
}

}  // namespace temper
