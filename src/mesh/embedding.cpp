// Tests that stars wind once and that the sweep over the boundary meets no clash. All exact.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/text.hpp"
#include "geometry/surface.hpp"
#include "mesh/blocks.hpp"
#include "mesh/boundary_sweep.hpp"
#include "mesh/predicates.hpp"

namespace temper {
namespace {

/// Says whether the direction from v to p is in the upper half-plane, the positive x-axis included.
bool is_upper(Vec2 v, Vec2 p) { return p.y > v.y || (p.y == v.y && p.x > v.x); }

/// Is P upper, seen from V on the sphere? It is if det(V, e, P) > 0 for an axis e that V is not on, or if P is on the
/// side of e in their plane. Exact.
bool is_upper(Vec3 v, Vec3 p) {
  // Turned so that e is the third axis: (x, y) of V is not 0.
  const bool on_third = v.x == 0 && v.y == 0;
  const Vec3 a = on_third ? Vec3{v.y, v.z, v.x} : v, b = on_third ? Vec3{p.y, p.z, p.x} : p;
  const auto turn = [](double x1, double y1, double x2, double y2) { return orient2d({0, 0}, {x1, y1}, {x2, y2}); };
  const Sign side = turn(b.x, b.y, a.x, a.y);  // det(A, e, B) = A_y B_x − A_x B_y
  if (side != Sign::zero) return side == Sign::positive;
  // B = α A + β e, β = (A_x B_z − A_z B_x)/A_x, or likewise with y.
  if (a.x != 0) return turn(a.x, a.z, b.x, b.z) == (a.x > 0 ? Sign::positive : Sign::negative);
  return turn(a.y, a.z, b.y, b.z) == (a.y > 0 ? Sign::positive : Sign::negative);
}

bool is_upper(const Mesh& mesh, VertexId v, VertexId p) {
  if (!mesh.space().is_plane()) return is_upper(mesh.weighted_vector(v), mesh.weighted_vector(p));
  const WeightedPoint from = mesh.point(v);
  return is_upper(from.position(), mesh.point(p, from).position());
}

/// Counts for each vertex how often its spokes, in their cyclic order, enter the upper half-plane: once when an
/// interior star winds once. Counting triangle by triangle reads each position once, and follows no chains of twins.
IdVector<VertexId, std::uint32_t> entries_to_upper_half(const Mesh& mesh, Executor* executor) {
  IdVector<VertexId, std::uint32_t> entries(mesh.n_vertices(), 0);
  const auto count = [&](std::size_t t, auto&& add) {
    const auto [a, b, c] = mesh.corners(TriangleId(t));
    if (!is_upper(mesh, a, b) && is_upper(mesh, a, c)) add(entries[a]);
    if (!is_upper(mesh, b, c) && is_upper(mesh, b, a)) add(entries[b]);
    if (!is_upper(mesh, c, a) && is_upper(mesh, c, b)) add(entries[c]);
  };
  if (executor == nullptr) {
    for (const TriangleId t : mesh.triangles()) count(t.index, [](std::uint32_t& n) { ++n; });
  } else {
    for_each_index(mesh.n_triangles(), executor, [&](std::size_t t) {
      count(t, [](std::uint32_t& n) { __atomic_fetch_add(&n, 1U, __ATOMIC_RELAXED); });
    });
  }
  return entries;
}

/// A boundary star overlaps itself when a later triangle contains the direction of its first edge.
bool boundary_star_overlaps(const Mesh& mesh, VertexId v) {
  const VertexId first = mesh.target(mesh.outgoing(v));
  for (const HalfedgeId h : mesh.star(v)) {
    const VertexId from = mesh.target(h), to = mesh.opposite(h);
    if (inlined::orientation(mesh, v, from, first) == Sign::positive &&
        inlined::orientation(mesh, v, first, to) != Sign::negative) {
      return true;
    }
  }
  return false;
}

/// More than one piece, or more area than the domain has. Consider one piece whose boundary loops are simple and apart.
/// Euler characteristics (as in boundary_sweep.hpp) give 1 − g = Σ n_t over t = 1, 2, …. Here n_t is the number of
/// pieces of the part that is covered t times or more, less one if it goes around along both axes. So nothing is
/// covered twice along one period. Along two periods a mesh that goes around both ways can go on over itself. Then its
/// area is more than the domain's, unless its holes are larger than the part covered twice.
std::optional<Overlap> find_more_than_the_domain(const Mesh& mesh) {
  const std::vector<HalfedgeId> pieces = pieces_of(mesh).first;
  if (pieces.size() > 1) {
    return Overlap{Mesh::triangle(pieces[1]),
                   "the mesh is of " + std::to_string(pieces.size()) + " pieces; expected one in a periodic plane"};
  }
  const Vec2 period = mesh.space().period();
  if (period.x == 0 || period.y == 0) return std::nullopt;
  constexpr double kRounded = 1e-6;
  const double domain = period.x * period.y;
  double area = 0;
  for (const TriangleId t : mesh.triangles()) {
    const auto [p, q, r] = mesh.points(t);
    area += 0.5 * cross(q.position() - p.position(), r.position() - p.position());
  }
  if (area <= (1 + kRounded) * domain) return std::nullopt;
  return Overlap{TriangleId(0), "the triangles have the area " + to_text(area) + ", the domain of the periods only " +
                                    to_text(domain) + ": the mesh covers it more than once"};
}

}  // namespace

std::string edges_on_each_other(const Mesh& mesh, VertexId v, const InputNames& names) {
  std::vector<VertexId> ends;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_boundary(h)) continue;
    if (mesh.origin(h) == v) ends.push_back(mesh.target(h));
    if (mesh.target(h) == v) ends.push_back(mesh.origin(h));
  }
  std::sort(ends.begin(), ends.end());
  const auto lies_on = [&](VertexId a, VertexId b) {  // b on the edge from v to a
    const auto [p, q, r] = mesh.points(v, a, b);
    return is_between(mesh.space(), p, q, r);
  };
  for (std::size_t i = 0; i < ends.size(); ++i) {
    for (std::size_t j = i + 1; j < ends.size(); ++j) {
      const VertexId a = ends[i], b = ends[j];
      if (inlined::orientation(mesh, v, a, b) != Sign::zero || !(lies_on(a, b) || lies_on(b, a))) continue;
      return "the mesh touches itself at " + names.point(v.index) + ": its edges to " + names.point(ends[i].index) +
             " and " + names.point(ends[j].index) +
             " lie on each other (a hanging node, or an edge whose two sides are not joined)";
    }
  }
  return {};
}

std::optional<Overlap> find_overlap(const Mesh& mesh, const InputNames& names, Executor* executor) {
  const auto entries = entries_to_upper_half(mesh, executor);
  const auto overlaps = [&](std::size_t i) {
    const VertexId v(i);
    return mesh.is_boundary(v) ? boundary_star_overlaps(mesh, v) : entries[v] != 1;
  };
  if (const auto first = first_index(mesh.n_vertices(), executor, overlaps)) {
    const VertexId v(*first);
    std::string message = mesh.is_boundary(v) ? edges_on_each_other(mesh, v, names) : std::string();
    if (message.empty()) message = "the triangles around " + names.point(v.index) + " overlap";
    return Overlap{Mesh::triangle(mesh.outgoing(v)), std::move(message)};
  }
  if (mesh.space().is_periodic()) {
    if (auto overlap = find_more_than_the_domain(mesh)) return overlap;
  }
  if (const auto clash = mesh.space().is_plane() ? find_boundary_clash(mesh) : find_arc_clash(mesh)) {
    const TriangleId s = Mesh::triangle(clash->first), t = Mesh::triangle(clash->second);
    if (clash->kind == BoundaryClash::covered) {
      return Overlap{s, names.triangle(s.index) + " lies on top of another component of the mesh"};
    }
    return Overlap{s, names.triangle(s.index) + " and " + names.triangle(t.index) +
                          " have boundary edges that cross or touch away from a common vertex"};
  }
  return std::nullopt;
}

}  // namespace temper
