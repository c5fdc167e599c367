// Stars wind once, boundary loops do not meet, components do not lie on one another. All exact.
#include "mesh/embedding.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "mesh/blocks.hpp"
#include "temper/geometry.hpp"

namespace temper {
namespace {

bool left_of(Vec2 a, Vec2 b, Vec2 p) { return orient2d(a, b, p) == Sign::positive; }

/// Says whether the direction from v to p is in the upper half-plane, the positive x-axis included.
bool is_upper(Vec2 v, Vec2 p) { return p.y > v.y || (p.y == v.y && p.x > v.x); }

/// Counts for each vertex how often its spokes, going round, enter the upper half-plane: once when an interior star
/// winds once. Counted triangle by triangle, which asks for each position once and not through chains of twins.
IdVector<VertexId, std::uint32_t> entries_to_upper_half(const Mesh& mesh, Executor* executor) {
  IdVector<VertexId, std::uint32_t> entries(mesh.n_vertices(), 0);
  const auto count = [&](std::size_t t, auto&& add) {
    const auto [a, b, c] = mesh.corners(TriangleId(t));
    const Vec2 p = mesh.position(a), q = mesh.position(b), r = mesh.position(c);
    // Of two distinct points one is upper to the other: what ends in the upper half at one end starts below the other.
    const bool ab = is_upper(p, q), bc = is_upper(q, r), ca = is_upper(r, p);
    if (!ab && !ca) add(entries[a]);
    if (!bc && !ab) add(entries[b]);
    if (!ca && !bc) add(entries[c]);
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
  const Vec2 center = mesh.position(v);
  const Vec2 first = mesh.position(mesh.target(mesh.outgoing(v)));
  for (const HalfedgeId h : mesh.star(v)) {
    const Vec2 from = mesh.position(mesh.target(h));
    const Vec2 to = mesh.position(mesh.opposite(h));
    if (left_of(center, from, first) && orient2d(center, first, to) != Sign::negative) return true;
  }
  return false;
}

struct Bounds {
  Vec2 low, high;
  [[nodiscard]] bool meets(const Bounds& o) const {
    return low.x <= o.high.x && o.low.x <= high.x && low.y <= o.high.y && o.low.y <= high.y;
  }
  void add(const Bounds& o) {
    low = {std::min(low.x, o.low.x), std::min(low.y, o.low.y)};
    high = {std::max(high.x, o.high.x), std::max(high.y, o.high.y)};
  }
};

/// p on the closed segment ab, given that the three are collinear.
bool within(Vec2 a, Vec2 b, Vec2 p) {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

bool segments_meet(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const Sign abc = orient2d(a, b, c), abd = orient2d(a, b, d), cda = orient2d(c, d, a), cdb = orient2d(c, d, b);
  if (abc == Sign::zero && within(a, b, c)) return true;
  if (abd == Sign::zero && within(a, b, d)) return true;
  if (cda == Sign::zero && within(c, d, a)) return true;
  if (cdb == Sign::zero && within(c, d, b)) return true;
  return abc == -abd && cda == -cdb && abc != Sign::zero && cda != Sign::zero;
}

/// Finds two boundary edges that meet away from a common vertex, by a tree of bounding boxes.
class BoundaryCrossing {
 public:
  BoundaryCrossing(const Mesh& mesh, std::vector<HalfedgeId> boundary) : mesh_(mesh), edges_(std::move(boundary)) {
    if (!edges_.empty()) root_ = make_node(0, edges_.size());
  }

  [[nodiscard]] std::optional<std::pair<HalfedgeId, HalfedgeId>> find() const {
    if (nodes_.empty()) return std::nullopt;
    std::vector<std::pair<std::size_t, std::size_t>> pairs{{root_, root_}};
    while (!pairs.empty()) {
      const auto [i, j] = pairs.back();
      pairs.pop_back();
      const Node& a = nodes_[i];
      const Node& b = nodes_[j];
      if (i != j && !a.bounds.meets(b.bounds)) continue;
      if (a.is_leaf() && b.is_leaf()) {
        if (i != j && meet(edges_[a.first], edges_[b.first])) return std::pair{edges_[a.first], edges_[b.first]};
      } else if (i == j) {
        pairs.insert(pairs.end(), {{a.left, a.left}, {a.right, a.right}, {a.left, a.right}});
      } else if (b.is_leaf() || (!a.is_leaf() && a.size >= b.size)) {
        pairs.insert(pairs.end(), {{a.left, j}, {a.right, j}});
      } else {
        pairs.insert(pairs.end(), {{i, b.left}, {i, b.right}});
      }
    }
    return std::nullopt;
  }

 private:
  struct Node {
    Bounds bounds;
    std::size_t first = 0, size = 0, left = 0, right = 0;
    [[nodiscard]] bool is_leaf() const { return size == 1; }
  };

  [[nodiscard]] Bounds bounds(HalfedgeId h) const {
    const Vec2 a = mesh_.position(mesh_.origin(h)), b = mesh_.position(mesh_.target(h));
    return {{std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}};
  }

  std::size_t make_node(std::size_t first, std::size_t size) {
    Node node{bounds(edges_[first]), first, size};
    for (std::size_t i = first + 1; i < first + size; ++i) node.bounds.add(bounds(edges_[i]));
    if (size > 1) {
      const bool by_x = node.bounds.high.x - node.bounds.low.x > node.bounds.high.y - node.bounds.low.y;
      const auto middle = edges_.begin() + static_cast<std::ptrdiff_t>(first + size / 2);
      std::nth_element(edges_.begin() + static_cast<std::ptrdiff_t>(first), middle,
                       edges_.begin() + static_cast<std::ptrdiff_t>(first + size), [&](HalfedgeId a, HalfedgeId b) {
                         const Vec2 p = bounds(a).low, q = bounds(b).low;
                         const double u = by_x ? p.x : p.y, v = by_x ? q.x : q.y;
                         return u != v ? u < v : a < b;
                       });
      node.left = make_node(first, size / 2);
      node.right = make_node(first + size / 2, size - size / 2);
    }
    nodes_.push_back(node);
    return nodes_.size() - 1;
  }

  [[nodiscard]] bool meet(HalfedgeId g, HalfedgeId h) const {
    const VertexId a = mesh_.origin(g), b = mesh_.target(g), c = mesh_.origin(h), d = mesh_.target(h);
    // Edges at a common vertex: the star check has seen to them.
    if (a == c || a == d || b == c || b == d) return false;
    return segments_meet(mesh_.position(a), mesh_.position(b), mesh_.position(c), mesh_.position(d));
  }

  const Mesh& mesh_;
  std::vector<HalfedgeId> edges_;
  std::vector<Node> nodes_;
  std::size_t root_ = 0;
};

std::vector<HalfedgeId> boundary_of(const Mesh& mesh) {
  std::vector<HalfedgeId> boundary;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (mesh.is_boundary(h)) boundary.push_back(h);
  }
  return boundary;
}

/// Boundary loops with the domain inside, one a component: at their leftmost vertex, the lowest of those, they turn
/// left, and loops around holes turn right. Precondition: no loop meets itself or another one.
std::size_t count_outer_loops(const Mesh& mesh, const std::vector<HalfedgeId>& boundary) {
  std::vector<bool> seen(boundary.size(), false);
  const auto place = [&](HalfedgeId h) {  // boundary is sorted
    return static_cast<std::size_t>(std::lower_bound(boundary.begin(), boundary.end(), h) - boundary.begin());
  };
  const auto is_before = [&](HalfedgeId g, HalfedgeId h) {
    const Vec2 p = mesh.position(mesh.origin(g)), q = mesh.position(mesh.origin(h));
    return p.x != q.x ? p.x < q.x : p.y < q.y;
  };
  std::size_t count = 0;
  for (std::size_t i = 0; i < boundary.size(); ++i) {
    if (seen[i]) continue;
    HalfedgeId before_least = boundary[i], h = boundary[i];
    do {
      const HalfedgeId next = mesh.outgoing(mesh.target(h));
      if (is_before(next, mesh.outgoing(mesh.target(before_least)))) before_least = h;
      seen[place(h)] = true;
      h = next;
    } while (h != boundary[i]);
    const VertexId least = mesh.target(before_least);
    count += left_of(mesh.position(mesh.origin(before_least)), mesh.position(least),
                     mesh.position(mesh.target(mesh.outgoing(least))))
                 ? 1
                 : 0;
  }
  return count;
}

/// The connected component of every triangle, numbered from 0.
IdVector<TriangleId, std::uint32_t> components(const Mesh& mesh, std::uint32_t& count) {
  constexpr std::uint32_t kNone = 0xffffffffu;
  IdVector<TriangleId, std::uint32_t> component(mesh.n_triangles(), kNone);
  std::vector<TriangleId> stack;
  count = 0;
  for (const TriangleId seed : mesh.triangles()) {
    if (component[seed] != kNone) continue;
    component[seed] = count;
    stack.push_back(seed);
    while (!stack.empty()) {
      const TriangleId t = stack.back();
      stack.pop_back();
      for (int k = 0; k < 3; ++k) {
        const HalfedgeId other = mesh.twin(Mesh::halfedge(t, k));
        if (!other.valid() || component[Mesh::triangle(other)] != kNone) continue;
        component[Mesh::triangle(other)] = count;
        stack.push_back(Mesh::triangle(other));
      }
    }
    ++count;
  }
  return component;
}

/// A component whose leftmost vertex has a non-zero winding number with respect to the other components'
/// boundaries lies in their triangles (and not in a hole of theirs).
std::optional<TriangleId> component_inside_another(const Mesh& mesh, const std::vector<HalfedgeId>& boundary) {
  if (count_outer_loops(mesh, boundary) < 2) return std::nullopt;
  std::uint32_t count = 0;
  const auto component = components(mesh, count);
  if (count < 2) return std::nullopt;
  std::vector<HalfedgeId> leftmost(count);  // a halfedge whose origin is the component's leftmost vertex
  for (const HalfedgeId h : boundary) {
    HalfedgeId& best = leftmost[component[Mesh::triangle(h)]];
    const Vec2 p = mesh.position(mesh.origin(h));
    if (!best.valid() || p.x < mesh.position(mesh.origin(best)).x) best = h;
  }
  for (std::uint32_t c = 0; c < count; ++c) {
    const Vec2 p = mesh.position(mesh.origin(leftmost[c]));
    int winding = 0;
    for (const HalfedgeId h : boundary) {
      if (component[Mesh::triangle(h)] == c) continue;
      const Vec2 a = mesh.position(mesh.origin(h)), b = mesh.position(mesh.target(h));
      if (a.y <= p.y && b.y > p.y && left_of(a, b, p)) ++winding;
      if (b.y <= p.y && a.y > p.y && left_of(b, a, p)) --winding;
    }
    if (winding != 0) return Mesh::triangle(leftmost[c]);
  }
  return std::nullopt;
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
  const Vec2 p = mesh.position(v);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    for (std::size_t j = i + 1; j < ends.size(); ++j) {
      const Vec2 a = mesh.position(ends[i]), b = mesh.position(ends[j]);
      if (orient2d(p, a, b) != Sign::zero || !(within(p, a, b) || within(p, b, a))) continue;
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
  const std::vector<HalfedgeId> boundary = boundary_of(mesh);
  if (const auto crossing = BoundaryCrossing(mesh, boundary).find()) {
    const TriangleId s = Mesh::triangle(crossing->first), t = Mesh::triangle(crossing->second);
    return Overlap{s, names.triangle(s.index) + " and " + names.triangle(t.index) +
                          " have boundary edges that cross or touch away from a common vertex"};
  }
  if (const auto t = component_inside_another(mesh, boundary)) {
    return Overlap{*t, names.triangle(t->index) + " lies on top of another component of the mesh"};
  }
  return std::nullopt;
}

}  // namespace temper
