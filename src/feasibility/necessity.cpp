// The two-disc condition of one edge: the vertices that stay and see the edge are found by a walk from its triangles,
// then sorted by their bounds, exactly, and the first visible one on each end decides.
//
// With a + b ≤ S both bounds are below S, so that both vertices lie in the discs with diameters from u to u + S (v − u)
// and from v to v + S (u − v). For S ≥ 1 so do the triangles u v X, and whatever hides X: all is found inside the
// smallest disc around both.
#include "temper/necessity.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <unordered_set>

#include "base/assert.hpp"
#include "feasibility/exact_number.hpp"
#include "geometry/predicates_inline.hpp"
#include "mesh/erased.hpp"

namespace temper {
namespace {

using exact::Number;

// A piece of a split edge is a fifth of it at least: shorter ones would only ask for the next split.
constexpr double kLeastPiece = 0.2;
// Relative to the largest distance that enters: far more than the dozen roundings of a distance. The walk may go a bit
// too far, never too short.
constexpr double kWalkSlack = 1e-12;
// Relative roundings of |X − u|² and of a quotient: below 8 units; of a product of vectors, relative to its permanent.
constexpr double kRounding = 8 * 0x1p-53;

Number product(Vec2 from, Vec2 a, Vec2 b) {
  return Number::difference(a.x, from.x) * Number::difference(b.x, from.x) +
         Number::difference(a.y, from.y) * Number::difference(b.y, from.y);
}

/// |X − near|² / ((far − near)·(X − near)): the part of the edge, from `near`, in which the dual must cross it.
struct CrossingBound {
  VertexId vertex;
  double value = 0, error = 0;  ///< rounded, and by how much at most
  Vec2 near, far, at;

  [[nodiscard]] Number numerator() const { return product(near, at, at); }
  [[nodiscard]] Number denominator() const { return product(near, far, at); }

  friend bool operator<(const CrossingBound& x, const CrossingBound& y) {
    if (std::abs(x.value - y.value) > x.error + y.error) return x.value < y.value;
    const Sign sign = (x.numerator() * y.denominator() - y.numerator() * x.denominator()).sign();
    return sign == Sign::zero ? x.vertex < y.vertex : sign == Sign::negative;
  }
};

/// a + b ≤ up_to, exactly.
bool is_at_most(const CrossingBound& a, const CrossingBound& b, double up_to) {
  const double sum = a.value + b.value, error = a.error + b.error + kRounding * sum;
  if (std::abs(sum - up_to) > error) return sum < up_to;
  const Number da = a.denominator(), db = b.denominator();
  const Number limit = up_to == 1 ? da * db : Number(up_to) * (da * db);
  return (a.numerator() * db + b.numerator() * da - limit).sign() != Sign::positive;
}

/// None when X does not bound the crossing below up_to, and so cannot be part of a conflict.
std::optional<CrossingBound> bound_of(VertexId vertex, Vec2 at, Vec2 near, Vec2 far, double up_to) {
  const Vec2 along = far - near, to = at - near;
  const double numerator = squared_length(to), denominator = dot(along, to);
  const double error = kRounding * (std::abs(along.x * to.x) + std::abs(along.y * to.y));
  if (denominator + error < 0 || numerator > 2 * up_to * (denominator + error)) return std::nullopt;
  CrossingBound bound = {vertex, numerator / denominator, 0, near, far, at};
  if (denominator <= 2 * error) {  // even the sign is not known
    if (bound.denominator().sign() != Sign::positive) return std::nullopt;
    bound.value = bound.numerator().approximation() / bound.denominator().approximation();
    bound.error = kRounding * bound.value;
  } else {
    bound.error = bound.value * (kRounding + 2 * error / denominator);
  }
  return bound;
}

/// A vertex that no optimisation takes away from its place, its line apart.
bool stays(const Mesh& mesh, VertexId v) {
  if (mesh.is_fixed(v) || mesh.is_boundary(v)) return true;
  for (const HalfedgeId h : mesh.star(v)) {
    if (mesh.is_constrained(h)) return true;
  }
  return false;
}

struct Segment {
  Vec2 p, q;
};

/// Says whether pq meets the inside of the counter-clockwise triangle abc: no line along one of the four separates
/// them.
bool meets_inside(const Segment& s, Vec2 a, Vec2 b, Vec2 c) {
  const auto is_left = [](Vec2 x, Vec2 y, Vec2 z) { return inlined::orient2d(x, y, z) == Sign::positive; };
  const auto side_separates = [&](Vec2 x, Vec2 y) { return !is_left(x, y, s.p) && !is_left(x, y, s.q); };
  if (side_separates(a, b) || side_separates(b, c) || side_separates(c, a)) return false;
  const bool any_left = is_left(s.p, s.q, a) || is_left(s.p, s.q, b) || is_left(s.p, s.q, c);
  const bool any_right = is_left(s.q, s.p, a) || is_left(s.q, s.p, b) || is_left(s.q, s.p, c);
  return any_left && any_right;
}

/// The vertices and edges in the disc on the left side of an edge u → v.
class Surroundings {
 public:
  Surroundings(const Mesh& mesh, HalfedgeId h, double up_to)
      : mesh_(mesh),
        u_(mesh.position(mesh.origin(h))),
        v_(mesh.position(mesh.target(h))),
        up_to_(std::max(up_to, 1.0)) {
    walk(h);
  }

  /// The least bound from u or from v that a vertex which sees the edge sets.
  [[nodiscard]] std::optional<CrossingBound> least(bool from_u) const {
    std::vector<CrossingBound> bounds;
    for (const VertexId x : vertices_) {
      if (!stays(mesh_, x)) continue;
      const auto bound = bound_of(x, mesh_.position(x), from_u ? u_ : v_, from_u ? v_ : u_, up_to_);
      if (bound) bounds.push_back(*bound);
    }
    std::sort(bounds.begin(), bounds.end());
    for (const CrossingBound& bound : bounds) {
      if (is_visible(bound.at)) return bound;
    }
    return std::nullopt;
  }

 private:
  void walk(HalfedgeId first) {
    std::vector<HalfedgeId> entered = {first};
    std::unordered_set<std::uint32_t> seen = {Mesh::triangle(first).index};
    while (!entered.empty()) {
      const HalfedgeId in = entered.back();
      entered.pop_back();
      vertices_.push_back(mesh_.opposite(in));
      for (const HalfedgeId h : {Mesh::next(in), Mesh::prev(in)}) {
        if (mesh_.is_boundary(h)) {
          walls_.push_back({mesh_.position(mesh_.origin(h)), mesh_.position(mesh_.target(h))});
        } else if (reaches(h) && seen.insert(Mesh::triangle(mesh_.twin(h)).index).second) {
          entered.push_back(mesh_.twin(h));
        }
      }
    }
    std::sort(vertices_.begin(), vertices_.end());
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
    std::erase_if(vertices_, [&](VertexId x) { return !is_left(mesh_.position(x)); });
  }

  /// Says whether the edge has points in the disc and on the left of u → v.
  [[nodiscard]] bool reaches(HalfedgeId h) const {
    const Vec2 p = mesh_.position(mesh_.origin(h)), q = mesh_.position(mesh_.target(h));
    if (!is_left(p) && !is_left(q)) return false;
    const Vec2 along = v_ - u_, center = 0.5 * along;  // seen from u: differences round relative to themselves
    const Vec2 from = (p - u_) - center, pq = q - p;
    const double t = std::clamp(-dot(from, pq) / squared_length(pq), 0.0, 1.0);
    const double slack = kWalkSlack * (length(from) + length(pq) + length(along));
    return length(from + t * pq) <= (up_to_ - 0.5) * length(along) + slack;
  }

  [[nodiscard]] bool is_left(Vec2 p) const { return inlined::orient2d(u_, v_, p) == Sign::positive; }

  /// The triangle u v x is in the domain: no edge of the boundary gets into it.
  [[nodiscard]] bool is_visible(Vec2 x) const {
    return std::none_of(walls_.begin(), walls_.end(), [&](const Segment& s) { return meets_inside(s, u_, v_, x); });
  }

  const Mesh& mesh_;
  Vec2 u_, v_;
  double up_to_;
  std::vector<VertexId> vertices_;
  std::vector<Segment> walls_;
};

std::optional<CrossingBound> lesser(const std::optional<CrossingBound>& x, const std::optional<CrossingBound>& y) {
  if (!x || !y) return x ? x : y;
  return *y < *x ? y : x;
}

}  // namespace

std::optional<EdgeConflict> edge_conflict(const Mesh& mesh, HalfedgeId h, double up_to) {
  TEMPER_ASSERT(mesh.space().is_plane());
  const HalfedgeId edge = mesh.is_edge_representative(h) ? h : mesh.twin(h);
  const Surroundings left(mesh, edge, up_to);
  std::optional<CrossingBound> a = left.least(true), b = left.least(false);
  if (!mesh.is_boundary(edge)) {  // one crossing serves both sides
    const Surroundings right(mesh, mesh.twin(edge), up_to);
    a = lesser(a, right.least(false));
    b = lesser(b, right.least(true));
  }
  if (!a || !b || !is_at_most(*a, *b, up_to)) return std::nullopt;
  EdgeConflict conflict = {edge, a->vertex, b->vertex, a->value, b->value};
  conflict.sum = a->value + b->value;
  conflict.split_at = std::clamp((a->value + (1 - b->value)) / 2, kLeastPiece, 1 - kLeastPiece);
  return conflict;
}

std::vector<EdgeConflict> edges_that_must_be_split(const Mesh& mesh, double up_to) {
  TEMPER_ASSERT_SLOW(!has_erased_triangles(mesh));
  std::vector<EdgeConflict> conflicts;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_edge_representative(h) || !(mesh.is_boundary(h) || mesh.is_constrained(h))) continue;
    if (const auto conflict = edge_conflict(mesh, h, up_to)) conflicts.push_back(*conflict);
  }
  const auto key = [&](const EdgeConflict& c) {
    return std::tuple(c.sum, std::minmax({mesh.origin(c.edge), mesh.target(c.edge)}));
  };
  std::sort(conflicts.begin(), conflicts.end(),
            [&](const EdgeConflict& x, const EdgeConflict& y) { return key(x) < key(y); });
  return conflicts;
}

}  // namespace temper
