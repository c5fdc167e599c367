#include "optimize/repair/neighborhood.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <unordered_map>
#include <utility>

#include "base/assert.hpp"
#include "base/sort_unique.hpp"
#include "geometry/surface.hpp"
#include "mesh/mesh_editor.hpp"
#include "regularity/duals.hpp"
#include "temper/detail/geometry.hpp"
#include "topology/outgoing.hpp"
#include "topology/rings.hpp"

namespace temper {
namespace {

bool contains(const std::vector<TriangleId>& sorted, TriangleId t) {
  return std::binary_search(sorted.begin(), sorted.end(), t);
}

/// Returns the neighbors of v outside of the triangles, which have one fan at v.
OutsideNeighbors outside_of(const Mesh& mesh, VertexId v, const std::vector<TriangleId>& inside) {
  OutsideNeighbors all;
  all.is_closed = !mesh.is_boundary(v);
  std::vector<WeightedPoint> before;  // the fan
  bool fan_was_there = false;
  const auto is_inside = [&](HalfedgeId h) { return h.valid() && contains(inside, Mesh::triangle(h)); };
  const auto add = [&](VertexId u) { (fan_was_there ? all.points : before).push_back(mesh.point(u, mesh.point(v))); };
  for (const HalfedgeId h : mesh.star(v)) {
    const bool here = is_inside(h);
    fan_was_there = fan_was_there || here;
    all.is_outside = all.is_outside || !here;
    if (!here && !is_inside(mesh.twin(h))) add(mesh.target(h));
    if (!here && mesh.is_boundary(Mesh::prev(h))) add(mesh.opposite(h));
  }
  all.points.insert(all.points.end(), before.begin(), before.end());
  return all;
}

/// Returns the vertices at which the triangles meet in more than one fan.
std::vector<VertexId> pinches(const Mesh& mesh, const std::vector<TriangleId>& triangles) {
  std::vector<VertexId> corners;
  for (const TriangleId t : triangles) {
    for (const VertexId v : mesh.corners(t)) corners.push_back(v);
  }
  sort_unique(corners);
  std::erase_if(corners, [&](VertexId v) {
    int fans = 0;  // a fan begins after a triangle outside
    for (const HalfedgeId h : mesh.star(v)) {
      const bool inside = contains(triangles, Mesh::triangle(h));
      const bool before = !mesh.is_boundary(h) && contains(triangles, Mesh::triangle(mesh.twin(h)));
      fans += inside && !before ? 1 : 0;
    }
    return fans < 2;
  });
  return corners;
}

std::vector<TriangleId> rings_around(const Mesh& mesh, TriangleId seed, int rings) {
  std::vector<TriangleId> triangles = {seed};
  for (int i = 0; i < rings; ++i) triangles = triangles_around(mesh, triangles);
  for (auto pinched = pinches(mesh, triangles); !pinched.empty(); pinched = pinches(mesh, triangles)) {
    std::vector<TriangleId> wider;
    std::ranges::set_union(triangles, triangles_at(mesh, pinched), std::back_inserter(wider));
    triangles = std::move(wider);
  }
  return triangles;
}

/// Returns the plan of a removal that a trial recorded, in the numbers of the whole mesh.
template <class Whole>
RemovalPlan removal_of(const Mesh& mesh, const TraceEvent& e, const Whole& whole) {
  std::vector<std::array<VertexId, 3>> triangles;
  for (const auto& [a, b, c] : e.triangles) triangles.push_back({whole(a), whole(b), whole(c)});
  RemovalPlan plan = removal_from_names(mesh, whole(e.vertex), whole(e.link.front()), triangles);
  TEMPER_ASSERT(plan.status == RemovalStatus::possible);
  return plan;
}

}  // namespace

bool Neighborhood::is_rim(VertexId a, VertexId b) const {
  return std::ranges::any_of(
      rim, [&](const auto& ends) { return (ends[0] == a && ends[1] == b) || (ends[0] == b && ends[1] == a); });
}

std::vector<HalfedgeId> lines_at(const Mesh& mesh, VertexId v) {
  std::vector<HalfedgeId> lines;
  for (const HalfedgeId h : mesh.star(v)) {
    if (mesh.is_unflippable(h)) lines.push_back(h);
    if (mesh.is_boundary(Mesh::prev(h))) lines.push_back(Mesh::prev(h));
  }
  return lines;
}

namespace {

/// Copies these triangles with their vertices, in order.
void copy_triangles(const WorkingCopy& work, const std::vector<TriangleId>& triangles, Neighborhood& around) {
  const Mesh& mesh = work.mesh;
  MeshEditor edit(around.mesh);
  std::unordered_map<std::uint32_t, VertexId> local;
  const auto local_vertex = [&](VertexId v) {
    const auto [entry, is_new] = local.try_emplace(v.index, around.vertices.size());
    if (is_new) {
      around.vertices.push_back(v);
      edit.add_vertex(mesh.point(v));
      around.mesh.set_fixed(entry->second, mesh.is_fixed(v));
      if (mesh.is_frozen(v)) around.mesh.set_frozen(entry->second);
      if (const DividedEdge* edge = work.divided_edge(v)) around.divided.emplace(entry->second, *edge);
    }
    return entry->second;
  };
  for (const TriangleId t : triangles) {
    const auto [a, b, c] = mesh.corners(t);
    edit.add_triangle({local_vertex(a), local_vertex(b), local_vertex(c)}, mesh.region(t));
  }
}

/// Links the halfedges of the copies of these triangles. Without a twin among them they are the rim.
void copy_edges(const Mesh& mesh, const std::vector<TriangleId>& triangles, Neighborhood& around) {
  MeshEditor edit(around.mesh);
  for (const HalfedgeId h : around.mesh.halfedges()) {
    const HalfedgeId whole(3 * std::size_t{triangles[h.index / 3].index} + h.index % 3);
    around.mesh.set_constrained(h, mesh.is_constrained(whole));
    if (mesh.joins_halves(whole)) around.mesh.set_diagonal(h);
    if (mesh.is_face(whole)) around.mesh.set_face(h);
    if (mesh.is_joint(whole)) around.mesh.set_joint(h);
    const HalfedgeId twin = mesh.twin(whole);
    if (!twin.valid()) continue;
    const auto at = std::lower_bound(triangles.begin(), triangles.end(), Mesh::triangle(twin));
    if (at != triangles.end() && *at == Mesh::triangle(twin)) {
      const auto slot = static_cast<std::size_t>(at - triangles.begin());
      edit.link(h, HalfedgeId(3 * slot + twin.index % 3));
      continue;
    }
    around.rim.push_back({around.mesh.origin(h), around.mesh.target(h)});
    around.beyond.push_back(mesh.point(mesh.opposite(twin)));
    around.region_beyond.push_back(mesh.region(Mesh::triangle(twin)));
  }
}

/// Finds an outgoing halfedge of each vertex, and what of its star is outside.
void complete_vertices(const Mesh& mesh, const std::vector<TriangleId>& triangles, Neighborhood& around) {
  MeshEditor edit(around.mesh);
  around.frozen.assign(around.vertices.size(), 0);
  for (const VertexId v : around.mesh.vertices()) around.frozen[v.index] = around.mesh.is_frozen(v) ? 1 : 0;
  for (const HalfedgeId h : around.mesh.halfedges()) edit.set_outgoing(around.mesh.origin(h), h);
  for (const VertexId v : around.mesh.vertices()) {
    edit.set_outgoing(v, canonical_outgoing(around.mesh, around.mesh.outgoing(v)));
    for (const HalfedgeId h : mesh.star(around.vertices[v.index])) {
      if (!contains(triangles, Mesh::triangle(h))) around.frozen[v.index] = 1;
    }
    around.outside.push_back(outside_of(mesh, around.vertices[v.index], triangles));
  }
}

/// Gives v the place or the weight of an event.
void place(Mesh& mesh, VertexId v, const TraceEvent& e, const Recorder& recorder) {
  const WeightedPoint from = mesh.point(v), reweighted = mesh.space().with_weight(from, e.point.w);
  mesh.set_point(v, e.kind == EventKind::move ? e.point : reweighted);
  recorder.placed(v, from, mesh.point(v), e.before, e.after);
}

}  // namespace

Neighborhood neighborhood_of(const WorkingCopy& work, TriangleId seed, int rings) {
  const std::vector<TriangleId> triangles = rings_around(work.mesh, seed, rings);
  Neighborhood around;
  around.mesh.set_space(work.mesh.space());
  around.seed = TriangleId(
      static_cast<std::size_t>(std::lower_bound(triangles.begin(), triangles.end(), seed) - triangles.begin()));
  copy_triangles(work, triangles, around);
  copy_edges(work.mesh, triangles, around);
  complete_vertices(work.mesh, triangles, around);
  return around;
}

bool rim_is_regular(const Neighborhood& around, const Mesh& local) {
  for (std::size_t i = 0; i < around.rim.size(); ++i) {
    const HalfedgeId h = local.find_halfedge(around.rim[i][0], around.rim[i][1]);
    if (!h.valid() || local.is_constrained(h)) continue;
    const auto [a, b, c] = local.points(local.origin(h), local.target(h), local.opposite(h));
    const Sign conflict = power_test(local.space(), a, b, c, local.space().image(around.beyond[i], a));
    if (conflict == Sign::positive) return false;
  }
  return true;
}

std::vector<ViolatedEdge> violated_edges(const Neighborhood& around, const Mesh& local, Criterion criterion) {
  std::vector<ViolatedEdge> all = violated_edges(local, criterion);
  // Alone, an edge of the rim has one side, which is a part if the regions differ.
  for (std::size_t i = 0; i < around.rim.size(); ++i) {
    const HalfedgeId h = local.find_halfedge(around.rim[i][0], around.rim[i][1]);
    if (!h.valid() || local.is_diagonal(h)) continue;
    if (local.region(Mesh::triangle(h)) == around.region_beyond[i])
      std::erase_if(all, [&](const ViolatedEdge& violated) { return violated.edge == h; });
    const Space& space = local.space();
    const auto [a, b, c] = local.points(local.origin(h), local.target(h), local.opposite(h));
    const WeightedPoint d = space.image(around.beyond[i], a);
    const Sign sign = -power_test(space, a, b, c, d);
    if (!allows(criterion, sign))
      all.push_back({h, DualKind::inside, with_sign(dual_length(space, a, b, c, d) / distance(space, a, b), sign)});
  }
  return all;
}

std::vector<VertexId> splice(WorkingCopy& work, Flipper& flipper, const Neighborhood& around,
                             std::span<const TraceEvent> events) {
  TEMPER_ASSERT_SLOW(std::all_of(around.mesh.vertices().begin(), around.mesh.vertices().end(), [&](VertexId v) {
    return around.mesh.point(v) == work.mesh.point(around.vertices[v.index]);
  }));
  Mesh& mesh = work.mesh;
  std::vector<VertexId> vertices = around.vertices;  // by local number
  const auto whole = [&](VertexId local) { return vertices[local.index]; };
  const auto edge = [&](VertexId a, VertexId b) { return mesh.find_halfedge(whole(a), whole(b)); };
  for (const TraceEvent& e : events) {
    TEMPER_ASSERT((e.kind != EventKind::insertion && e.kind != EventKind::split) || e.vertex.index == vertices.size());
    switch (e.kind) {
      case EventKind::move:
      case EventKind::weight:
        place(mesh, whole(e.vertex), e, flipper.recorder());
        break;
      case EventKind::flip:
        flipper.flip(edge(e.quad[0], e.quad[1]), e.before, e.after);
        break;
      case EventKind::insertion: {
        const TriangleId t = Mesh::triangle(edge(e.link[0], e.link[1]));
        vertices.push_back(flipper.insert(work, t, e.point, e.before, e.after));
        break;
      }
      case EventKind::split:
        vertices.push_back(flipper.split(work, edge(e.quad[0], e.quad[1]), e.point, e.before, e.after));
        break;
      case EventKind::collapse:
      case EventKind::removal:
        flipper.remove(e.kind, removal_of(mesh, e, whole), e.before, e.after);
        break;
      case EventKind::hidden:
      case EventKind::undo:
        break;  // changed nothing
    }
  }
  return vertices;
}

}  // namespace temper
