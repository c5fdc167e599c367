// A walk from a triangle nearby, or a search in a tree of boxes; exact tests then find the relevant corners.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/assert.hpp"
#include "geometry/predicates_inline.hpp"
#include "location/box_tree.hpp"
#include "location/position_of.hpp"
#include "mesh/bad_triangles.hpp"
#include "mesh/blocks.hpp"
#include "temper/detail/location.hpp"

namespace temper {
namespace {

// The longest walk before the tree takes over. A vertex step crosses one or two triangles, and a walk that circles must
// end: some do in meshes that are not Delaunay.
constexpr int kLongestWalk = 32;

/// A triangle and a point, as seen from its first corner.
struct Seen {
  Seen(const Mesh& mesh, TriangleId t, const WeightedPoint& p)
      : space(mesh.space()), corners(mesh.points(t)), point(space.image(p, corners[0])) {}

  /// Positive for a point on the left of the edge from corner k.
  [[nodiscard]] Sign side(std::size_t k) const {
    return inlined::orientation(space, corners[k], corners[k == 2 ? 0 : k + 1], point);
  }

  const Space& space;
  std::array<WeightedPoint, 3> corners;
  WeightedPoint point;
};

/// Walks towards p, to the triangle that contains it; invalid when the walk leaves the mesh.
TriangleId walk(const Mesh& mesh, const WeightedPoint& p, TriangleId from) {
  TriangleId t = from;
  HalfedgeId entered;
  for (int steps = 0; steps < kLongestWalk; ++steps) {
    const Seen seen(mesh, t, p);
    HalfedgeId exit;
    for (int k = 0; k < 3 && !exit.valid(); ++k) {
      const HalfedgeId h = Mesh::halfedge(t, k);
      // p is on this side of it; half a period away the other triangle may have seen another image of p.
      if (h == entered && !mesh.space().is_periodic()) continue;
      if (seen.side(static_cast<std::size_t>(k)) == Sign::negative) exit = h;
    }
    if (!exit.valid()) return t;
    entered = mesh.twin(exit);
    if (!entered.valid()) return {};  // the domain need not be convex: p may still be inside
    t = Mesh::triangle(entered);
  }
  return {};
}

/// `along` of the way from a to b.
Place on_edge(TriangleId t, VertexId a, VertexId b, double along) {
  if (along == 0) return Place::at(a, t);
  if (along == 1) return Place::at(b, t);
  return {t, 2, {a, b}, {1 - along, along}, false};
}

/// Both triangles of an edge must give the same place for a point on it: its lower vertex comes first.
Place on_edge(const Mesh& mesh, HalfedgeId h, const WeightedPoint& p) {
  VertexId a = mesh.origin(h), b = mesh.target(h);
  if (b < a) std::swap(a, b);
  return on_edge(
      Mesh::triangle(h), a, b,
      part_of_edge(mesh.space(), position_of(mesh, a, p), position_of(mesh, b, p), position_of(mesh.space(), p)));
}

/// The place of p, which is in t or on its boundary.
Place inside(const Mesh& mesh, TriangleId t, const WeightedPoint& point) {
  const Seen seen(mesh, t, point);
  for (std::size_t k = 0; k < 3; ++k) {
    if (mesh.space().same_place(seen.corners[k], seen.point)) return Place::at(mesh.corners(t)[k], t);
  }
  const Vec3 p = position_of(mesh.space(), seen.point);
  Place place{t, 3, {}, {}, false};
  double area = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const HalfedgeId h = Mesh::halfedge(t, static_cast<int>(k));
    const Vec3 a = position_of(mesh.space(), seen.corners[k]),
               b = position_of(mesh.space(), seen.corners[k == 2 ? 0 : k + 1]);
    place.corners[k] = mesh.opposite(h);
    place.shares[k] = spanned(mesh.space(), p, a - p, b - p);  // the area across from that corner
    // Far more than the rounding of a zero: beyond this distance no exact test is needed.
    const bool near_edge = std::abs(place.shares[k]) <= 0x1p-40 * squared_length(b - a);
    if (near_edge && seen.side(k) == Sign::zero) return on_edge(mesh, h, seen.point);
    area += place.shares[k] = std::max(place.shares[k], 0.0);
  }
  if (area == 0) return Place::at(place.corners[0], t);  // of a triangle that is all rounding
  for (double& share : place.shares) share /= area;
  return place;
}

}  // namespace

PointLocator::~PointLocator() { delete made_tree_.load(); }

/// The tree takes time and memory, so it is made at its first use; if every point has a good hint, never. Threads that
/// need it at once make one each, all equal, and the first one stays.
const BoxTree& PointLocator::tree() const {
  const BoxTree* there = made_tree_.load(std::memory_order_acquire);
  if (there != nullptr) return *there;
  const auto* mine = new BoxTree(mesh_);
  if (made_tree_.compare_exchange_strong(there, mine, std::memory_order_acq_rel)) return *mine;
  delete mine;
  return *there;
}

Place PointLocator::find(const WeightedPoint& p, TriangleId near) const {
  if (near.valid()) {
    const TriangleId t = walk(mesh_, p, near);
    if (t.valid()) return inside(mesh_, t, p);
  }
  const NearestPoint found = tree().nearest(mesh_, p);
  if (found.distance2 == 0) return inside(mesh_, found.triangle, p);
  Place place = on_edge(found.triangle, mesh_.origin(found.edge), mesh_.target(found.edge), found.along);
  place.outside = true;
  return place;
}

// The places of one mesh from which the vertices and triangles of another take their data.

namespace {

// The largest distance from an edge of a vertex that slid along the edge or splits it, in units of the last place of
// the largest coordinate there. Rounding a split takes three (plan_split), and the end of a slide as much again.
constexpr double kOffEdge = 8 * std::numeric_limits<double>::epsilon();

double largest_coordinate(Vec3 p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

/// p on the edge from a to b of triangle t, if only rounding separates p from it.
std::optional<Place> near_edge(const Mesh& mesh, TriangleId t, VertexId a, VertexId b, const WeightedPoint& point) {
  const Vec3 from = position_of(mesh, a, point), to = position_of(mesh, b, point), p = position_of(mesh.space(), point);
  const double off = std::abs(spanned(mesh.space(), p, to - from, p - from)) / length(to - from);
  if (off > kOffEdge * std::max(largest_coordinate(from), largest_coordinate(to))) return {};
  const double along = std::clamp(part_of_edge(mesh.space(), from, to, p), 0.0, 1.0);
  return Place{t, 2, {a, b}, {1 - along, along}, false};
}

Place without_rounding(const Mesh& mesh, const Place& place, const WeightedPoint& p) {
  for (std::size_t k = 0; place.n == 3 && k < 3; ++k) {
    const auto on_edge = near_edge(mesh, place.triangle, place.corners[(k + 1) % 3], place.corners[(k + 2) % 3], p);
    if (on_edge) return *on_edge;
  }
  return place;
}

/// For each vertex of `after` the vertex of `before` that it was.
class FormerVertices {
 public:
  FormerVertices(const Mesh& before, const Mesh& after, const IdVector<VertexId, VertexId>& vertices)
      : before_(before), after_(after), vertices_(vertices) {}

  [[nodiscard]] VertexId operator[](VertexId v) const {
    const VertexId former = vertices_.empty() ? v : vertices_[v];
    return former.index < before_.n_vertices() ? former : VertexId();
  }
  /// A triangle of `before` to start the search for v: of its own, or of a neighbor's.
  [[nodiscard]] TriangleId near(VertexId v) const {
    if ((*this)[v].valid()) return Mesh::triangle(before_.outgoing((*this)[v]));
    for (const HalfedgeId h : after_.star(v)) {
      const VertexId there = (*this)[after_.target(h)];
      if (there.valid()) return Mesh::triangle(before_.outgoing(there));
    }
    return {};
  }

 private:
  const Mesh &before_, &after_;
  const IdVector<VertexId, VertexId>& vertices_;
};

/// The triangle with those corners, in either orientation, or none.
TriangleId find_triangle(const Mesh& mesh, const std::array<VertexId, 3>& corners) {
  const auto [a, b, c] = corners;
  for (const HalfedgeId h : {mesh.find_halfedge(a, b), mesh.find_halfedge(b, a)}) {
    if (h.valid() && mesh.opposite(h) == c) return Mesh::triangle(h);
  }
  return {};
}

/// t, or else a triangle of the region next to it. An interface that rounding bends may leave the middle of a thin
/// triangle on its other side.
TriangleId of_region(const Mesh& mesh, TriangleId t, std::int32_t region) {
  if (mesh.region(t) == region) return t;
  for (const VertexId v : mesh.corners(t)) {
    for (const HalfedgeId h : mesh.star(v)) {
      if (mesh.region(Mesh::triangle(h)) == region) return Mesh::triangle(h);
    }
  }
  return t;
}

/// The triangle of `before` with the corners of t of `after`, at the same places; or none.
TriangleId same_triangle(const Mesh& before, const Mesh& after, TriangleId t, const IdVector<VertexId, Place>& places) {
  std::array<VertexId, 3> corners = after.corners(t);
  for (VertexId& v : corners) {
    if (places[v].n != 1 || places[v].outside) return {};
    v = places[v].corners[0];
  }
  return find_triangle(before, corners);
}

}  // namespace

IdVector<VertexId, Place> positions_of_vertices(const Mesh& before, const Mesh& after,
                                                const IdVector<VertexId, VertexId>& vertices, Executor* executor) {
  TEMPER_ASSERT_SLOW(!has_erased_triangles(before) && !has_erased_triangles(after));
  TEMPER_ASSERT(before.space().kind() == after.space().kind());
  TEMPER_ASSERT(vertices.empty() || vertices.size() == after.n_vertices());
  const PointLocator finder(before);
  const FormerVertices former(before, after, vertices);
  IdVector<VertexId, Place> places(after.n_vertices());
  for_each_index(after.n_vertices(), executor, [&](std::size_t i) {
    const VertexId v(i), was = former[v];
    const WeightedPoint p = after.point(v);
    const bool stayed = was.valid() && before.space().same_place(before.point(was), p);
    places[v] = stayed ? Place::at(was, Mesh::triangle(before.outgoing(was)))
                       : without_rounding(before, finder.find(p, former.near(v)), p);
  });
  return places;
}

IdVector<TriangleId, TriangleId> sources_of_triangles(const Mesh& before, const Mesh& after,
                                                      const IdVector<VertexId, Place>& places, Executor* executor) {
  const PointLocator finder(before);
  IdVector<TriangleId, TriangleId> sources(after.n_triangles());
  for_each_index(after.n_triangles(), executor, [&](std::size_t i) {
    const TriangleId t(i);
    sources[t] = same_triangle(before, after, t, places);
    if (sources[t].valid()) return;
    const auto [a, b, c] = positions_of(after, t);
    const Vec3 middle = (1.0 / 3) * (a + b + c);
    const TriangleId near = places[after.corners(t)[0]].triangle;
    sources[t] = of_region(before, finder.find(as_point(middle), near).triangle, after.region(t));
  });
  return sources;
}

}  // namespace temper
