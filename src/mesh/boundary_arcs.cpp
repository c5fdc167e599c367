#include "mesh/boundary_arcs.hpp"

#include <algorithm>
#include <vector>

#include "geometry/between.hpp"
#include "mesh/pieces.hpp"
#include "mesh/predicates.hpp"

namespace temper {
namespace {

/// A boundary edge as an arc of the unit sphere, in a box.
struct Arc {
  HalfedgeId halfedge;
  Vec3 low, high;
};

Arc arc_of(const Mesh& mesh, HalfedgeId h) {
  const auto unit = [](Vec3 p) { return (1 / length(p)) * p; };
  const Vec3 a = unit(mesh.lifted_point(mesh.origin(h))), b = unit(mesh.lifted_point(mesh.target(h)));
  // An arc leaves its chord c by at most 1 − √(1 − c²/4), which is below c²/4 for chords up to 2.
  const double out = 0.25 * squared_length(b - a) + 1e-14;
  return {h,
          {std::min(a.x, b.x) - out, std::min(a.y, b.y) - out, std::min(a.z, b.z) - out},
          {std::max(a.x, b.x) + out, std::max(a.y, b.y) + out, std::max(a.z, b.z) + out}};
}

bool boxes_meet(const Arc& a, const Arc& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
         a.low.z <= b.high.z && b.low.z <= a.high.z;
}

bool arcs_meet(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  const Sign abc = orientation(a, b, c), abd = orientation(a, b, d);
  const Sign cda = orientation(c, d, a), cdb = orientation(c, d, b);
  if (abc == Sign::zero && is_between(a, b, c)) return true;
  if (abd == Sign::zero && is_between(a, b, d)) return true;
  if (cda == Sign::zero && is_between(c, d, a)) return true;
  if (cdb == Sign::zero && is_between(c, d, b)) return true;
  // The great circles cross in two points; both arcs go through the same one when they leave each other's side so.
  return abc != Sign::zero && cda != Sign::zero && abc == -abd && cda == -cdb && abc == -cda;
}

bool meet(const Mesh& mesh, HalfedgeId g, HalfedgeId h) {
  const VertexId a = mesh.origin(g), b = mesh.target(g), c = mesh.origin(h), d = mesh.target(h);
  if (b == c || d == a) return false;  // neighbours on their loop, which go different ways
  return arcs_meet(mesh.lifted_point(a), mesh.lifted_point(b), mesh.lifted_point(c), mesh.lifted_point(d));
}

/// From south to north: each arc with those that begin no farther north than it ends.
std::optional<BoundaryClash> find_meeting(const Mesh& mesh) {
  std::vector<Arc> arcs;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (mesh.is_boundary(h)) arcs.push_back(arc_of(mesh, h));
  }
  std::sort(arcs.begin(), arcs.end(), [](const Arc& a, const Arc& b) {
    return a.low.z != b.low.z ? a.low.z < b.low.z : a.halfedge < b.halfedge;
  });
  for (auto a = arcs.begin(); a != arcs.end(); ++a) {
    for (auto b = std::next(a); b != arcs.end() && b->low.z <= a->high.z; ++b) {
      if (boxes_meet(*a, *b) && meet(mesh, a->halfedge, b->halfedge)) {
        return BoundaryClash{BoundaryClash::meeting, a->halfedge, b->halfedge};
      }
    }
  }
  return std::nullopt;
}

bool is_inside(const Mesh& mesh, TriangleId t, VertexId v) {
  const auto [a, b, c] = mesh.corners(t);
  const auto on_left = [&](VertexId p, VertexId q) { return inlined::orientation(mesh, p, q, v) != Sign::negative; };
  return on_left(a, b) && on_left(b, c) && on_left(c, a);
}

/// A component on the triangles of another one: all of it, since boundaries do not meet.
std::optional<BoundaryClash> find_covered(const Mesh& mesh) {
  const MeshPieces components = pieces_of(mesh);
  if (components.first.size() < 2) return std::nullopt;
  for (const TriangleId t : mesh.triangles()) {
    for (std::uint32_t i = 0; i < components.first.size(); ++i) {
      if (components.of[t] == i || !is_inside(mesh, t, mesh.origin(components.first[i]))) continue;
      return BoundaryClash{BoundaryClash::covered, components.first[i], Mesh::halfedge(t, 0)};
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<BoundaryClash> find_arc_clash(const Mesh& mesh) {
  auto clash = find_meeting(mesh);
  return clash ? clash : find_covered(mesh);
}

}  // namespace temper
