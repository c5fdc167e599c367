// From which places of one mesh the vertices and triangles of another take their data.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/assert.hpp"
#include "mesh/blocks.hpp"
#include "mesh/erased.hpp"
#include "places/place_of.hpp"
#include "temper/detail/places.hpp"

namespace temper {
namespace {

// What a vertex that slid along an edge, or splits it, may be off that by, in units of the last place of the largest
// coordinate there: three where a split is rounded (plan_split), and as much again where a slide ends.
constexpr double kOffEdge = 8 * std::numeric_limits<double>::epsilon();

double largest_coordinate(Vec3 p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

/// p on the edge from a to b of triangle t, if rounding alone has put it off that.
std::optional<Place> near_edge(const Mesh& mesh, TriangleId t, VertexId a, VertexId b, const WeightedPoint& point) {
  const Vec3 from = place_of(mesh, a, point), to = place_of(mesh, b, point), p = place_of(mesh.space(), point);
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

/// The vertices of `before` that those of `after` were.
class FormerVertices {
 public:
  FormerVertices(const Mesh& before, const Mesh& after, const IdVector<VertexId, VertexId>& vertices)
      : before_(before), after_(after), vertices_(vertices) {}

  [[nodiscard]] VertexId operator[](VertexId v) const {
    const VertexId former = vertices_.empty() ? v : vertices_[v];
    return former.index < before_.n_vertices() ? former : VertexId();
  }
  /// A triangle of `before` to look for v from: of its own, or of a neighbour's.
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

/// The triangle of those corners, either way round, or none.
TriangleId find_triangle(const Mesh& mesh, const std::array<VertexId, 3>& corners) {
  const auto [a, b, c] = corners;
  for (const HalfedgeId h : {mesh.find_halfedge(a, b), mesh.find_halfedge(b, a)}) {
    if (h.valid() && mesh.opposite(h) == c) return Mesh::triangle(h);
  }
  return {};
}

/// t, or else a triangle of the region next to it: an interface that rounding bends may leave the middle of a thin
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

/// The triangle of `before` that t of `after` is, at the same places; or none.
TriangleId same_triangle(const Mesh& before, const Mesh& after, TriangleId t, const IdVector<VertexId, Place>& places) {
  std::array<VertexId, 3> corners = after.corners(t);
  for (VertexId& v : corners) {
    if (places[v].n != 1 || places[v].outside) return {};
    v = places[v].corners[0];
  }
  return find_triangle(before, corners);
}

}  // namespace

IdVector<VertexId, Place> places_of_vertices(const Mesh& before, const Mesh& after,
                                             const IdVector<VertexId, VertexId>& vertices, Executor* executor) {
  TEMPER_ASSERT_SLOW(!has_erased_triangles(before) && !has_erased_triangles(after));
  TEMPER_ASSERT(before.space().kind() == after.space().kind());
  TEMPER_ASSERT(vertices.empty() || vertices.size() == after.n_vertices());
  const PlaceFinder finder(before);
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
  const PlaceFinder finder(before);
  IdVector<TriangleId, TriangleId> sources(after.n_triangles());
  for_each_index(after.n_triangles(), executor, [&](std::size_t i) {
    const TriangleId t(i);
    sources[t] = same_triangle(before, after, t, places);
    if (sources[t].valid()) return;
    const auto [a, b, c] = places_of(after, t);
    const Vec3 middle = (1.0 / 3) * (a + b + c);
    const TriangleId near = places[after.corners(t)[0]].triangle;
    sources[t] = of_region(before, finder.find(as_point(middle), near).triangle, after.region(t));
  });
  return sources;
}

}  // namespace temper
