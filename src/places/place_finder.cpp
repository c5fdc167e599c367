// A walk from a triangle nearby, or a search in a tree of boxes; then the corners that count, by exact tests.
#include <cmath>
#include <utility>

#include "geometry/predicates_inline.hpp"
#include "places/box_tree.hpp"
#include "places/place_of.hpp"
#include "temper/detail/places.hpp"

namespace temper {
namespace {

// Triangles that a walk may cross before the tree is asked: a vertex step crosses one or two, and a walk that circles
// (in meshes that are not Delaunay some do) must end.
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

/// Walks towards p, to the triangle that has it; invalid when the walk leaves the mesh.
TriangleId walk(const Mesh& mesh, const WeightedPoint& p, TriangleId from) {
  TriangleId t = from;
  HalfedgeId entered;
  for (int steps = 0; steps < kLongestWalk; ++steps) {
    const Seen seen(mesh, t, p);
    HalfedgeId exit;
    for (int k = 0; k < 3 && !exit.valid(); ++k) {
      const HalfedgeId h = Mesh::halfedge(t, k);
      if (h == entered) continue;  // p is on this side of it
      if (seen.side(static_cast<std::size_t>(k)) == Sign::negative) exit = h;
    }
    if (!exit.valid()) return t;
    entered = mesh.twin(exit);
    if (!entered.valid()) return {};  // the domain need not be convex: p may be inside all the same
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

/// Both triangles of an edge must say the same of a point on it: its lower vertex comes first.
Place on_edge(const Mesh& mesh, HalfedgeId h, const WeightedPoint& p) {
  VertexId a = mesh.origin(h), b = mesh.target(h);
  if (b < a) std::swap(a, b);
  return on_edge(Mesh::triangle(h), a, b,
                 part_of_edge(mesh.space(), place_of(mesh, a, p), place_of(mesh, b, p), place_of(mesh.space(), p)));
}

/// The place of p, which is in t or on its boundary.
Place inside(const Mesh& mesh, TriangleId t, const WeightedPoint& point) {
  const Seen seen(mesh, t, point);
  for (std::size_t k = 0; k < 3; ++k) {
    if (mesh.space().same_place(seen.corners[k], seen.point)) return Place::at(mesh.corners(t)[k], t);
  }
  const Vec3 p = place_of(mesh.space(), seen.point);
  Place place{t, 3, {}, {}, false};
  double area = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const HalfedgeId h = Mesh::halfedge(t, static_cast<int>(k));
    const Vec3 a = place_of(mesh.space(), seen.corners[k]),
               b = place_of(mesh.space(), seen.corners[k == 2 ? 0 : k + 1]);
    place.corners[k] = mesh.opposite(h);
    place.shares[k] = spanned(mesh.space(), p, a - p, b - p);  // the area across from that corner
    // Far more than rounding makes of a zero: what is not this near needs no exact test.
    const bool near_edge = std::abs(place.shares[k]) <= 0x1p-40 * squared_length(b - a);
    if (near_edge && seen.side(k) == Sign::zero) return on_edge(mesh, h, seen.point);
    area += place.shares[k] = std::max(place.shares[k], 0.0);
  }
  if (area == 0) return Place::at(place.corners[0], t);  // of a triangle that is all rounding
  for (double& share : place.shares) share /= area;
  return place;
}

}  // namespace

PlaceFinder::~PlaceFinder() { delete made_tree_.load(); }

/// Made when it is first asked: where every point has a good hint it never is, and it takes its time and memory.
/// Threads that ask at once make one each, all alike, and the first one stays.
const BoxTree& PlaceFinder::tree() const {
  const BoxTree* there = made_tree_.load(std::memory_order_acquire);
  if (there != nullptr) return *there;
  const auto* mine = new BoxTree(mesh_);
  if (made_tree_.compare_exchange_strong(there, mine, std::memory_order_acq_rel)) return *mine;
  delete mine;
  return *there;
}

Place PlaceFinder::find(const WeightedPoint& p, TriangleId near) const {
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

}  // namespace temper
