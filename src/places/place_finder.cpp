// A walk from a triangle nearby, or a search in a tree of boxes; then the corners that count, by exact tests.
#include <cmath>
#include <utility>

#include "base/assert.hpp"
#include "geometry/predicates_inline.hpp"
#include "places/box_tree.hpp"
#include "temper/places.hpp"

namespace temper {
namespace {

// Triangles that a walk may cross before the tree is asked: a vertex step crosses one or two, and a walk that circles
// (in meshes that are not Delaunay some do) must end.
constexpr int kLongestWalk = 32;

/// Walks towards p, to the triangle that has it; invalid when the walk leaves the mesh.
TriangleId walk(const Mesh& mesh, Vec2 p, TriangleId from) {
  TriangleId t = from;
  HalfedgeId entered;
  for (int steps = 0; steps < kLongestWalk; ++steps) {
    HalfedgeId exit;
    for (int k = 0; k < 3 && !exit.valid(); ++k) {
      const HalfedgeId h = Mesh::halfedge(t, k);
      if (h == entered) continue;  // p is on this side of it
      const Vec2 a = mesh.position(mesh.origin(h)), b = mesh.position(mesh.target(h));
      if (inlined::orient2d(a, b, p) == Sign::negative) exit = h;
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
Place on_edge(const Mesh& mesh, HalfedgeId h, Vec2 p) {
  VertexId a = mesh.origin(h), b = mesh.target(h);
  if (b < a) std::swap(a, b);
  const Vec2 ab = mesh.position(b) - mesh.position(a);
  return on_edge(Mesh::triangle(h), a, b, dot(p - mesh.position(a), ab) / squared_length(ab));
}

/// The place of p, which is in t or on its boundary.
Place inside(const Mesh& mesh, TriangleId t, Vec2 p) {
  for (const VertexId v : mesh.corners(t)) {
    if (p == mesh.position(v)) return Place::at(v, t);
  }
  Place place{t, 3, {}, {}, false};
  double area = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const HalfedgeId h = Mesh::halfedge(t, static_cast<int>(k));
    const Vec2 a = mesh.position(mesh.origin(h)), b = mesh.position(mesh.target(h));
    place.corners[k] = mesh.opposite(h);
    place.shares[k] = cross(a - p, b - p);  // the area across from that corner
    // Far more than rounding makes of a zero: what is not this near needs no exact test.
    const bool near_edge = std::abs(place.shares[k]) <= 0x1p-40 * squared_length(b - a);
    if (near_edge && inlined::orient2d(a, b, p) == Sign::zero) return on_edge(mesh, h, p);
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

Place PlaceFinder::find(Vec2 p, TriangleId near) const {
  TEMPER_ASSERT(mesh_.space().is_plane());
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
