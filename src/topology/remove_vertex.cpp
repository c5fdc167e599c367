// Vertex removal: ask and price (plan_removal), and read a plan back from numbers.
//
//        3-----2               3-----2          before: k triangles v,i,i+1 around v, from spoke v→0 = first on
//       / \   / \             / \     \         after:  the polygon of the link in k − 2 triangles, in the slots of
//      /   \ /   \           /   \     \                the star from first on; two slots are erased, v is isolated
//     4-----v-----1   →     4     \     1       keeps:  the outer edges with their flags, the region, the domain
//      \   / \   /           \     \   /        refuses: a fixed vertex; one on constrained edges, unless they are two
//       \ /   \ /             \     \ /                 in line, as below
//        5-----0               5-----0          cost:   the plan O(k³), the commit O(k²)
//
// On a straight line, of the boundary or of constrained edges, the two edges of the line become one with their flag:
//
//        2-----1               2-----1          boundary: k triangles become k − 1, one slot is erased; the first
//       / \   / \             / \     \                   spoke is v's boundary halfedge, 3→0 the new boundary edge
//      /   \ /   \           /   \     \        interface: the same on both sides of the line; the first spoke is one
//     3-----v-----0   →     3-----------0                 of its two, and the side on its left comes first
//
// An edge collapse fills the cavity with the fan of the neighbor that v goes into:
//
//        3-----2               3-----2
//       / \   / \             /  . / |
//      /   \ /   \           / . /   |        v into 0: the triangles 0,1,2  0,2,3  0,3,4  0,4,5, which must be
//     4-----v-----1   →     4 . /    1        counter-clockwise, with edges 0-2, 0-3, 0-4 new to the mesh
//      \   / \   /           \.//   /
//       \ /   \ /             \// /
//        5-----0               5-0
//
// The commit is in commits.cpp.
#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "geometry/surface.hpp"
#include "mesh/predicates.hpp"
#include "temper/mesh.hpp"
#include "temper/topology.hpp"

namespace temper {
namespace {

// The regular triangulation of a cavity: the polygon that the star of a removed vertex leaves.
//
//        3-----2          Consider all triangulations of the polygon 0 … k−1 that are counter-clockwise by the exact
//       /       \         test. The result has the least volume under the lifted surface z = |x|² − w. The volume over
//      4         1        a triangle is its area × the mean of its corners' heights. So the best triangulation of the
//       \       /         part that a diagonal ij cuts off does not depend on the rest. This gives a dynamic program,
//        5-----0            V(i, j) = min over i < m < j of V(i, m) + V(m, j) + volume(i, m, j),   O(k³).
//
// Why is the least volume regular? To flip an edge that is not regular takes off the volume of a tetrahedron
// (lawson.hpp). So no such edge can be flipped if the volume is least. Coordinates are doubles relative to the removed
// vertex: heights and areas are then as small as the star. Rounding errs only in near ties, which Lawson repairs.

constexpr double kNone = std::numeric_limits<double>::infinity();
// Stars of more than a dozen triangles are rare; tables for twice that many fit into nine kilobytes of stack.
constexpr std::size_t kSmall = 24;

/// Is there an edge between a and b, in either direction? O(degree).
bool has_edge(const Mesh& mesh, VertexId a, VertexId b) {
  return mesh.find_halfedge(a, b).valid() || mesh.find_halfedge(b, a).valid();
}

/// n values of memory that is on the stack when n is small.
template <class T, std::size_t N>
class Scratch {
 public:
  explicit Scratch(std::size_t n) {
    if (n > N) large_.resize(n);
  }
  T& operator[](std::size_t i) { return large_.empty() ? small_[i] : large_[i]; }

 private:
  std::array<T, N> small_;
  std::vector<T> large_;
};

/// The best triangulation of the part of the polygon from i to j: its volume, and the apex over its closing edge.
struct Part {
  double volume;
  std::size_t apex;
};

class BestTriangulation {
 public:
  BestTriangulation(const Mesh& mesh, std::span<const VertexId> polygon, const WeightedPoint& origin)
      : mesh_(mesh), polygon_(polygon), n_(polygon.size()), lifted_(n_), parts_(n_ * n_) {
    for (std::size_t i = 0; i < n_; ++i) {
      lifted_[i] = on_lifted_surface(mesh.space(), mesh.point(polygon[i], origin), origin);
    }
    for (std::size_t i = 0; i + 1 < n_; ++i) part(i, i + 1) = {0, i};
    for (std::size_t length = 2; length < n_; ++length) {
      for (std::size_t i = 0; i + length < n_; ++i) part(i, i + length) = best(i, i + length);
    }
  }

  [[nodiscard]] bool exists() { return part(0, n_ - 1).volume < kNone; }

  void append(std::size_t i, std::size_t j, std::vector<std::array<VertexId, 3>>& triangles) {
    if (j - i < 2) return;
    const std::size_t m = part(i, j).apex;
    triangles.push_back({polygon_[i], polygon_[m], polygon_[j]});
    append(i, m, triangles);
    append(m, j, triangles);
  }

 private:
  Part& part(std::size_t i, std::size_t j) { return parts_[i * n_ + j]; }

  /// Ties go to the smallest apex: then the best one depends on the order of the polygon alone.
  Part best(std::size_t i, std::size_t j) {
    Part least = {kNone, i};
    const bool closes_polygon = i == 0 && j == n_ - 1;
    if (!closes_polygon && has_edge(mesh_, polygon_[i], polygon_[j])) return least;
    for (std::size_t m = i + 1; m < j; ++m) {
      const double rest = part(i, m).volume + part(m, j).volume;
      if (!(rest < kNone) || !is_counter_clockwise(i, m, j)) continue;
      const double volume = rest + volume_under(mesh_.space(), lifted_[i], lifted_[m], lifted_[j]);
      if (volume < least.volume) least = {volume, m};
    }
    return least;
  }

  [[nodiscard]] bool is_counter_clockwise(std::size_t i, std::size_t m, std::size_t j) const {
    return inlined::orientation(mesh_, polygon_[i], polygon_[m], polygon_[j]) == Sign::positive;
  }

  const Mesh& mesh_;
  std::span<const VertexId> polygon_;
  std::size_t n_;
  Scratch<Vec3, kSmall> lifted_;          // on_lifted_surface()
  Scratch<Part, kSmall * kSmall> parts_;  // of i < j alone; the rest is never looked at
};

/// Appends the triangles of the best triangulation of a simple polygon, counter-clockwise, to `triangles`. Appends
/// nothing and returns false when every triangulation has a diagonal that is already in the mesh. Heights are relative
/// to `origin`. Allocates nothing else for polygons of up to 24 corners.
bool triangulate_cavity(const Mesh& mesh, std::span<const VertexId> polygon, const WeightedPoint& origin,
                        std::vector<std::array<VertexId, 3>>& triangles) {
  if (polygon.size() < 3) return false;
  BestTriangulation best(mesh, polygon, origin);
  if (!best.exists()) return false;
  best.append(0, polygon.size() - 1, triangles);
  return true;
}

using Corners = std::array<VertexId, 3>;

/// The star of a vertex, for a removal.
struct StarShape {
  RemovalStatus status = RemovalStatus::possible;
  HalfedgeId first;              ///< the first spoke, as the numbers of the vertices decide it
  bool on_line = false;          ///< two edges of the boundary, or two constrained ones, become one
  HalfedgeId line_end = {};      ///< the other spoke of an interface; invalid on the boundary
  bool line_constrained = true;  ///< the flag of the new edge
};

/// Does v lie exactly on the segment ab, between its ends?
bool is_inside_line(const Mesh& mesh, VertexId a, VertexId v, VertexId b) {
  if (inlined::orientation(mesh, a, v, b) != Sign::zero) return false;
  const auto [p, q, r] = mesh.points(v, a, b);
  return is_between(mesh.space(), q, r, p);
}

/// Do all triangles around v have one region, except across constrained spokes?
bool has_one_region_a_side(const Mesh& mesh, VertexId v) {
  for (const HalfedgeId h : mesh.star(v)) {
    if (mesh.is_unflippable(h)) continue;
    if (mesh.region(Mesh::triangle(h)) != mesh.region(Mesh::triangle(mesh.twin(h)))) return false;
  }
  return true;
}

StarShape boundary_shape(const Mesh& mesh, VertexId v) {
  const HalfedgeId first = mesh.outgoing(v);
  HalfedgeId last = first;
  std::size_t constrained_inside = 0;
  for (const HalfedgeId h : mesh.star(v)) {
    last = h;
    if (h != first && mesh.is_constrained(h)) ++constrained_inside;
  }
  const HalfedgeId back = Mesh::prev(last);  // the boundary halfedge into v
  if (!is_inside_line(mesh, mesh.target(first), v, mesh.origin(back))) {
    return {RemovalStatus::boundary_corner, {}};
  }
  const bool constrained = mesh.is_constrained(first);
  if (constrained_inside > 0 || constrained != mesh.is_constrained(back) || !has_one_region_a_side(mesh, v)) {
    return {RemovalStatus::constrained, {}};
  }
  return {RemovalStatus::possible, first, true, {}, constrained};
}

StarShape inner_shape(const Mesh& mesh, VertexId v) {
  HalfedgeId least;
  std::array<HalfedgeId, 2> line;
  std::size_t constrained = 0;
  for (const HalfedgeId h : mesh.star(v)) {
    if (!least.valid() || mesh.target(h) < mesh.target(least)) least = h;
    if (!mesh.is_constrained(h)) continue;
    if (constrained < 2) line[constrained] = h;
    ++constrained;
  }
  const StarShape refused = {RemovalStatus::constrained, {}};
  if (!has_one_region_a_side(mesh, v)) return refused;
  if (constrained == 0) return {RemovalStatus::possible, least};
  if (constrained != 2) return refused;
  if (mesh.target(line[1]) < mesh.target(line[0])) std::swap(line[0], line[1]);
  const VertexId a = mesh.target(line[0]), b = mesh.target(line[1]);
  if (!is_inside_line(mesh, a, v, b)) return refused;
  return {RemovalStatus::possible, line[0], true, line[1], true};
}

StarShape star_shape(const Mesh& mesh, VertexId v) {
  if (v.index >= mesh.n_vertices() || mesh.is_isolated(v)) return {RemovalStatus::no_triangulation, {}};
  if (mesh.is_fixed(v)) return {RemovalStatus::fixed, {}};
  return mesh.is_boundary(v) ? boundary_shape(mesh, v) : inner_shape(mesh, v);
}

void gather_link(const Mesh& mesh, HalfedgeId first, std::vector<VertexId>& link) {
  HalfedgeId last = first;
  for (HalfedgeId h = first; h.valid();) {
    link.push_back(mesh.target(h));
    last = h;
    h = mesh.rotate(h);
    if (h == first) return;
  }
  link.push_back(mesh.opposite(last));
}

/// The index in the link at which the line that starts at link[0] ends.
std::size_t line_end_index(const Mesh& mesh, const StarShape& shape, const std::vector<VertexId>& link) {
  if (!shape.line_end.valid()) return link.size() - 1;
  const auto end = std::find(link.begin(), link.end(), mesh.target(shape.line_end));
  return static_cast<std::size_t>(end - link.begin());
}

/// The polygon of the cavity, or both polygons: link[0 … end], and on an interface link[end … 0] too. Calls
/// use(polygon) for each while it returns true; true when all did.
template <class Use>
bool each_polygon(const Mesh& mesh, const StarShape& shape, std::vector<VertexId>& link, Use&& use) {
  if (!shape.line_end.valid()) return use(std::span<const VertexId>(link));
  const std::size_t end = line_end_index(mesh, shape, link);
  link.push_back(link[0]);
  const std::span<const VertexId> around = link;
  const bool all = use(around.subspan(0, end + 1)) && use(around.subspan(end));
  link.pop_back();
  return all;
}

/// The edge that takes the line's place must be new to the mesh, as the diagonals are.
bool line_is_free(const Mesh& mesh, const StarShape& shape, const std::vector<VertexId>& link) {
  return !shape.on_line || !has_edge(mesh, link[0], link[line_end_index(mesh, shape, link)]);
}

RemovalPlan begin_plan(const Mesh& mesh, VertexId v, const StarShape& shape, RemovalPlan storage) {
  storage.status = shape.status;
  storage.vertex = v;
  storage.first = shape.first;
  storage.link.clear();
  storage.triangles.clear();
  if (shape.status != RemovalStatus::possible) return storage;
  gather_link(mesh, shape.first, storage.link);
  if (!line_is_free(mesh, shape, storage.link)) storage.status = RemovalStatus::no_triangulation;
  return storage;
}

/// Is a → b a side of the polygon?
bool is_side(std::span<const VertexId> polygon, VertexId a, VertexId b) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    if (polygon[i] == a) return polygon[(i + 1) % polygon.size()] == b;
  }
  return false;
}

std::size_t count_edge(std::span<const Corners> triangles, VertexId a, VertexId b) {
  std::size_t count = 0;
  for (const auto& [i, j, k] : triangles) {
    count += ((i == a && j == b) || (j == a && k == b) || (k == a && i == b)) ? 1 : 0;
  }
  return count;
}

/// Let n − 2 triangles have a simple polygon of n corners. They fill it exactly when all are counter-clockwise and
/// their boundary is the polygon's: each side is there once, and each other edge once either way. Then they cover its
/// inside once.
bool fills(const Mesh& mesh, std::span<const VertexId> polygon, std::span<const Corners> triangles) {
  if (triangles.size() + 2 != polygon.size()) return false;
  for (const Corners& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId a = t[k], b = t[(k + 1) % 3];
      if (std::find(polygon.begin(), polygon.end(), a) == polygon.end()) return false;
      if (count_edge(triangles, a, b) != 1) return false;
      if (is_side(polygon, a, b)) continue;
      if (count_edge(triangles, b, a) != 1 || has_edge(mesh, a, b)) return false;
    }
    if (inlined::orientation(mesh, t[0], t[1], t[2]) != Sign::positive) return false;
  }
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    if (count_edge(triangles, polygon[i], polygon[(i + 1) % polygon.size()]) != 1) return false;
  }
  return true;
}

/// The fan of `apex` in the polygon, appended to `triangles`; false when the polygon does not have it as a corner.
bool append_fan(std::span<const VertexId> polygon, VertexId apex, std::vector<Corners>& triangles) {
  const auto at = std::find(polygon.begin(), polygon.end(), apex);
  if (at == polygon.end()) return false;
  const std::size_t n = polygon.size(), first = static_cast<std::size_t>(at - polygon.begin());
  for (std::size_t i = 1; i + 1 < n; ++i) {
    triangles.push_back({apex, polygon[(first + i) % n], polygon[(first + i + 1) % n]});
  }
  return true;
}

}  // namespace

RemovalPlan plan_removal(const Mesh& mesh, VertexId v, RemovalPlan storage) {
  const StarShape shape = star_shape(mesh, v);
  RemovalPlan plan = begin_plan(mesh, v, shape, std::move(storage));
  if (plan.status != RemovalStatus::possible) return plan;
  const bool filled = each_polygon(mesh, shape, plan.link, [&](std::span<const VertexId> polygon) {
    return triangulate_cavity(mesh, polygon, mesh.point(v), plan.triangles);
  });
  if (!filled) plan.status = RemovalStatus::no_triangulation;
  return plan;
}

RemovalPlan removal_from_names(const Mesh& mesh, VertexId vertex, VertexId link_first,
                               std::span<const Corners> triangles, RemovalPlan storage) {
  StarShape shape = star_shape(mesh, vertex);
  if (shape.status == RemovalStatus::possible) {
    const HalfedgeId first = mesh.find_halfedge(vertex, link_first);
    // A line has two ends, and either may come first. Without a line any spoke may. The boundary has one beginning.
    const bool is_other_end = shape.line_end.valid() && first == shape.line_end;
    if (is_other_end) std::swap(shape.first, shape.line_end);
    if (!first.valid() || (shape.on_line && first != shape.first)) shape.status = RemovalStatus::no_triangulation;
    shape.first = first;
  }
  RemovalPlan plan = begin_plan(mesh, vertex, shape, std::move(storage));
  if (plan.status != RemovalStatus::possible) return plan;
  std::span<const Corners> rest = triangles;
  const bool filled = each_polygon(mesh, shape, plan.link, [&](std::span<const VertexId> polygon) {
    const std::size_t n = std::min(polygon.size() - 2, rest.size());
    const bool fits = fills(mesh, polygon, rest.first(n));
    rest = rest.subspan(n);
    return fits;
  });
  if (!filled || !rest.empty()) {
    plan.status = RemovalStatus::no_triangulation;
    return plan;
  }
  plan.triangles.assign(triangles.begin(), triangles.end());
  return plan;
}

RemovalPlan plan_collapse(const Mesh& mesh, VertexId v, VertexId into, RemovalPlan storage) {
  StarShape shape = star_shape(mesh, v);
  const bool leaves_line =
      shape.line_end.valid() && into != mesh.target(shape.first) && into != mesh.target(shape.line_end);
  if (shape.status == RemovalStatus::possible && leaves_line) shape.status = RemovalStatus::constrained;
  RemovalPlan plan = begin_plan(mesh, v, shape, std::move(storage));
  if (plan.status != RemovalStatus::possible) return plan;
  const bool filled = each_polygon(mesh, shape, plan.link, [&](std::span<const VertexId> polygon) {
    const std::size_t before = plan.triangles.size();
    return append_fan(polygon, into, plan.triangles) &&
           fills(mesh, polygon, std::span<const Corners>(plan.triangles).subspan(before));
  });
  if (!filled) plan.status = RemovalStatus::no_triangulation;
  return plan;
}

}  // namespace temper
