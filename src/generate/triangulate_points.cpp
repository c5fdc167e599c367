// Incremental Delaunay triangulation of a growing convex hull.
//
// There is no enclosing triangle, neither a huge one (whose circumcircles would cut corners off the hull) nor a
// symbolic one. The mesh is at all times the Delaunay triangulation of the convex hull of the points so far. A point
// inside splits a triangle or an edge. A point outside is joined to every hull edge it strictly sees, so that the hull
// stays convex. With points in random rounds few are outside. Lawson's flips follow each insertion. Every decision is
// an exact predicate, so offsets, scales and lattices make no difference.
#include <algorithm>
#include <bit>

#include "base/hilbert.hpp"
#include "base/rng.hpp"
#include "base/text.hpp"
#include "generate/triangulation.hpp"
#include "mesh/mesh_editor.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/topology.hpp"

namespace temper::generate {

// Biased randomized insertion order: see Amenta, Choi and Rote, "Incremental constructions con BRIO", 2003.

namespace {

struct Keyed {
  std::uint64_t key;
  std::uint32_t index;
  friend bool operator<(const Keyed& a, const Keyed& b) { return a.key != b.key ? a.key < b.key : a.index < b.index; }
};

/// `curve`: the place of a point along it, in `bits` bits.
template <class Point, class Curve>
std::vector<std::uint32_t> order_along(std::span<const Point> points, int bits, const Curve& curve) {
  constexpr int kRounds = 24;  // a first round of one point or none up to 16 million points
  static_assert(kCubeBits + 5 <= 64);
  std::vector<Keyed> keyed;
  keyed.reserve(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    // Half of all points have no trailing zero and go last, a quarter have one and go before them, and so on.
    const auto zeros = static_cast<std::uint64_t>(std::min(kRounds, std::countr_zero(mix64(i + 1))));
    keyed.push_back({((kRounds - zeros) << bits) | curve(points[i]), i});
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<std::uint32_t> order;
  order.reserve(points.size());
  for (const Keyed& k : keyed) order.push_back(k.index);
  return order;
}

}  // namespace

std::vector<std::uint32_t> insertion_order(std::span<const Vec2> points) {
  return order_along(points, 2 * kHilbertBits, HilbertGrid(points));
}

std::vector<std::uint32_t> insertion_order(std::span<const Vec3> points) {
  return order_along(points, kCubeBits, cube_hilbert_index);
}

namespace {

enum class Place { inside, edge, vertex, outside };

/// The place of a point: in the triangle of h, on h, at the origin of h, or outside, strictly right of boundary edge h.
struct Location {
  Place place;
  HalfedgeId h;
};

class Inserter {
 public:
  explicit Inserter(std::span<const Vec2> points) : points_(points) {
    result_.number.reserve(points.size());
    result_.vertex.resize(points.size());
  }

  /// The first triangle: the first points of the order that are distinct and not collinear. Returns their places in the
  /// order.
  std::optional<std::array<std::size_t, 3>> start(std::span<const std::uint32_t> order) {
    const Vec2 a = points_[order[0]];
    std::size_t i = 1;
    while (i < order.size() && points_[order[i]] == a) ++i;
    if (i == order.size()) return std::nullopt;
    const Vec2 b = points_[order[i]];
    std::size_t j = i + 1;
    while (j < order.size() && orient2d(a, b, points_[order[j]]) == Sign::zero) ++j;
    if (j == order.size()) return std::nullopt;
    std::array<std::size_t, 3> corners = {0, i, j};
    if (orient2d(a, b, points_[order[j]]) == Sign::negative) std::swap(corners[1], corners[2]);
    std::array<VertexId, 3> vertices;
    for (int k = 0; k < 3; ++k) {
      vertices[k] = edit().add_vertex(weighted(order[corners[k]]));
      record(vertices[k], order[corners[k]]);
    }
    last_ = edit().add_triangle(vertices, 0);
    for (int k = 0; k < 3; ++k) edit().set_outgoing(vertices[k], Mesh::halfedge(last_, k));
    return corners;
  }

  /// Inserts point i, or returns the vertex at its place.
  std::optional<VertexId> insert(std::uint32_t i) {
    const Location at = locate(points_[i]);
    if (at.place == Place::vertex) return mesh().origin(at.h);
    lawson_.clear();
    VertexId v;
    if (at.place == Place::inside) {
      v = insert_in_triangle(mesh(), Mesh::triangle(at.h), weighted(i));
    } else if (at.place == Place::edge) {
      v = split_edge(mesh(), at.h, weighted(i));
    } else {
      v = extend_hull(at.h, i);
    }
    record(v, i);
    // The spokes of v are regular: only the edges of its link may not be.
    for (const HalfedgeId h : mesh().star(v)) lawson_.push(Mesh::next(h));
    lawson_.run(mesh(), IgnoreFlips(), Lawson::kNoCap, result_.conflict_test());
    last_ = Mesh::triangle(mesh().outgoing(v));
    return std::nullopt;
  }

  Triangulation take() { return std::move(result_); }
  [[nodiscard]] const Triangulation& result() const { return result_; }

 private:
  Mesh& mesh() { return result_.mesh; }
  MeshEditor edit() { return MeshEditor(result_.mesh); }
  [[nodiscard]] WeightedPoint weighted(std::uint32_t i) const { return {points_[i].x, points_[i].y, 0}; }

  void record(VertexId v, std::uint32_t i) {
    result_.number.push_back(i);
    result_.vertex[i] = v;
  }

  /// Walks from the last triangle, always across an edge that has p strictly on its other side. In a Delaunay
  /// triangulation no triangle comes twice: the power of p relative to the circumcircles falls along the way.
  Location locate(Vec2 p) {
    HalfedgeId entered;
    for (HalfedgeId h = Mesh::halfedge(last_, 0);;) {
      HalfedgeId across;
      std::array<HalfedgeId, 2> touching;
      int touched = 0;
      for (int k = 0; k < 3 && !across.valid(); ++k, h = Mesh::next(h)) {
        if (h == entered) continue;
        const Sign side = orient2d(mesh().position(mesh().origin(h)), mesh().position(mesh().target(h)), p);
        if (side == Sign::negative) across = h;
        if (side == Sign::zero) touching[touched++] = h;
      }
      if (!across.valid()) return settle(h, touching, touched);
      if (mesh().is_boundary(across)) return {Place::outside, across};
      ++result_.steps;
      h = entered = mesh().twin(across);
    }
  }

  Location settle(HalfedgeId h, const std::array<HalfedgeId, 2>& touching, int touched) const {
    if (touched == 0) return {Place::inside, h};
    if (touched == 1) return {Place::edge, touching[0]};
    // If p is on two sides at once, it is at their common corner.
    return {Place::vertex, Mesh::next(touching[0]) == touching[1] ? touching[1] : touching[0]};
  }

  [[nodiscard]] bool sees(Vec2 p, HalfedgeId h) {
    return orient2d(mesh().position(mesh().origin(h)), mesh().position(mesh().target(h)), p) == Sign::negative;
  }
  [[nodiscard]] HalfedgeId previous_boundary(HalfedgeId h) {
    HalfedgeId last = h;
    for (; mesh().rotate(last).valid(); ++result_.steps) last = mesh().rotate(last);
    return Mesh::prev(last);
  }

  //     a1 --- b1       The hull edges that p sees form one chain a1 b1 b2 …; each gets a triangle (b, a, v).
  //    /  \   / \  .
  //   .     v --- b2
  VertexId extend_hull(HalfedgeId seen, std::uint32_t i) {
    const Vec2 p = points_[i];
    for (HalfedgeId h = previous_boundary(seen); sees(p, h); h = previous_boundary(h)) seen = h;
    const VertexId v = edit().add_vertex(weighted(i));
    const VertexId first = mesh().origin(seen);
    HalfedgeId open;  // v → b of the triangle before
    HalfedgeId first_side;
    for (HalfedgeId h = seen; sees(p, h);) {
      const VertexId a = mesh().origin(h), b = mesh().target(h);
      const HalfedgeId following = mesh().outgoing(b);
      const TriangleId t = edit().add_triangle({b, a, v}, 0);
      edit().link(Mesh::halfedge(t, 0), h);
      if (open.valid()) {
        edit().link(open, Mesh::halfedge(t, 1));
        edit().set_outgoing(a, canonical_outgoing(mesh(), h));
        lawson_.push(open);
      } else {
        first_side = Mesh::halfedge(t, 1);
      }
      lawson_.push(h);
      open = Mesh::halfedge(t, 2);
      h = following;
    }
    edit().set_outgoing(first, first_side);
    edit().set_outgoing(v, open);
    return v;
  }

  std::span<const Vec2> points_;
  Triangulation result_;
  Lawson lawson_;
  TriangleId last_;
};

std::string place(Vec2 p) { return "(" + to_text(p.x) + ", " + to_text(p.y) + ")"; }

std::optional<InputError> check_points(std::span<const Vec2> points) {
  if (points.size() < 3) {
    return InputError{ErrorCode::empty_input, "",
                      "a triangulation needs three points or more, not " + std::to_string(points.size())};
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2 p = points[i];
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) {
      return InputError{ErrorCode::not_finite, "", "point " + std::to_string(i) + " is not finite"};
    }
    if (!is_exact_coordinate(p.x) || !is_exact_coordinate(p.y)) {
      return InputError{ErrorCode::out_of_scale, "",
                        "point " + std::to_string(i) + " at " + place(p) + " is out of the range of exact arithmetic"};
    }
  }
  return std::nullopt;
}

}  // namespace

Expected<Triangulation> triangulate_points(std::span<const Vec2> points, const std::function<bool()>& stop) {
  if (auto error = check_points(points)) return *error;
  const std::vector<std::uint32_t> order = insertion_order(points);
  Inserter inserter(points);
  const auto corners = inserter.start(order);
  if (!corners) return InputError{ErrorCode::zero_area, "", "all points lie on one line"};
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (stop && stop()) return stopped_error();
    if (k == (*corners)[0] || k == (*corners)[1] || k == (*corners)[2]) continue;
    if (const auto there = inserter.insert(order[k])) {
      const auto [low, high] = std::minmax(inserter.result().number[there->index], order[k]);
      return InputError{
          ErrorCode::duplicate_point, "",
          "points " + std::to_string(low) + " and " + std::to_string(high) + " are both at " + place(points[order[k]])};
    }
  }
  return inserter.take();
}

}  // namespace temper::generate
