#include "mesh/boundary_sweep.hpp"

#include <algorithm>
#include <cstdint>
#include <set>
#include <vector>

#include "geometry/predicates_inline.hpp"
#include "geometry/surface.hpp"
#include "mesh/predicates.hpp"

namespace temper {
namespace {

/// The order in which the line meets points: from left to right, and upwards at equal x.
bool is_before(Vec2 p, Vec2 q) { return p.x != q.x ? p.x < q.x : p.y < q.y; }

bool segments_meet(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const Sign abc = inlined::orient2d(a, b, c), abd = inlined::orient2d(a, b, d);
  const Sign cda = inlined::orient2d(c, d, a), cdb = inlined::orient2d(c, d, b);
  if (abc == Sign::zero && is_between(a, b, c)) return true;
  if (abd == Sign::zero && is_between(a, b, d)) return true;
  if (cda == Sign::zero && is_between(c, d, a)) return true;
  if (cdb == Sign::zero && is_between(c, d, b)) return true;
  return abc == -abd && cda == -cdb && abc != Sign::zero && cda != Sign::zero;
}

/// A boundary edge, from the end that the line meets first.
struct SweptEdge {
  Vec2 left, right;
  HalfedgeId halfedge;
  bool mesh_above;
};

/// The order on the line, from below, of edges that do not meet. Edges with a common left end are ordered by direction.
struct IsBelow {
  bool operator()(const SweptEdge& e, const SweptEdge& f) const {
    const bool e_first = !is_before(f.left, e.left);
    const Sign side = e_first ? side_of(e, f) : -side_of(f, e);
    return side != Sign::zero ? side == Sign::positive : e.halfedge < f.halfedge;
  }

 private:
  /// Positive when `later`, which begins no sooner, is above `first`.
  static Sign side_of(const SweptEdge& first, const SweptEdge& later) {
    const Sign side = inlined::orient2d(first.left, first.right, later.left);
    return side != Sign::zero ? side : inlined::orient2d(first.left, first.right, later.right);
  }
};

/// Edges begin in the domain and are shorter than half a period. So if two edges meet somewhere, two of their images
/// meet that are shifted by at most one period.
std::vector<Vec2> shifts_of_images(const Space& space) {
  const auto [x, y] = space.period();
  std::vector<Vec2> shifts = {{0, 0}};
  if (x > 0) shifts.push_back({x, 0});
  if (y > 0) shifts.push_back({0, y});
  if (x > 0 && y > 0) shifts.push_back({x, y});
  return shifts;
}

class BoundarySweep {
 public:
  explicit BoundarySweep(const Mesh& mesh);

  std::optional<BoundaryClash> find_clash();

 private:
  using Line = std::set<SweptEdge, IsBelow>;

  /// An end of an edge. Ends at a point come before beginnings there.
  struct Event {
    Vec2 at;
    std::uint32_t edge;
    bool begins;
  };
  static bool comes_before(const Event& a, const Event& b) {
    if (a.at != b.at) return is_before(a.at, b.at);
    return a.begins != b.begins ? b.begins : a.edge < b.edge;
  }

  bool begin(std::uint32_t edge);
  bool end(std::uint32_t edge);
  bool covers_twice(const Event& one, const Event& other);
  bool meet(Line::const_iterator below, Line::const_iterator above);
  [[nodiscard]] VertexId vertex(const Event& event) const;

  const Mesh& mesh_;
  const bool looks_below_;  // the line begins outside the mesh, which it does not among images
  std::vector<SweptEdge> edges_;
  std::vector<Event> events_;
  std::vector<Line::const_iterator> places_;  // by edge, of those on the line
  Line line_;
  std::optional<BoundaryClash> clash_;
};

BoundarySweep::BoundarySweep(const Mesh& mesh) : mesh_(mesh), looks_below_(!mesh.space().is_periodic()) {
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_boundary(h)) continue;
    const WeightedPoint p = mesh.point(mesh.origin(h));
    const Vec2 a = p.position(), b = mesh.point(mesh.target(h), p).position();
    const bool rightwards = is_before(a, b);
    for (const Vec2 shift : shifts_of_images(mesh.space())) {
      const auto edge = static_cast<std::uint32_t>(edges_.size());
      edges_.push_back({shift + (rightwards ? a : b), shift + (rightwards ? b : a), h, rightwards});
      events_.push_back({edges_.back().left, edge, true});
      events_.push_back({edges_.back().right, edge, false});
    }
  }
  places_.resize(edges_.size());
  std::sort(events_.begin(), events_.end(), comes_before);
}

std::optional<BoundaryClash> BoundarySweep::find_clash() {
  for (std::size_t i = 0; i < events_.size(); ++i) {
    const Event& event = events_[i];
    const bool with_last = i > 0 && events_[i - 1].at == event.at;
    if (with_last && vertex(events_[i - 1]) != vertex(event)) {
      return BoundaryClash{BoundaryClash::meeting, edges_[events_[i - 1].edge].halfedge, edges_[event.edge].halfedge};
    }
    if (event.begins ? begin(event.edge) : end(event.edge)) return clash_;
    const bool begin_together = with_last && event.begins && events_[i - 1].begins;
    if (looks_below_ && begin_together && covers_twice(events_[i - 1], event)) return clash_;
  }
  return std::nullopt;
}

VertexId BoundarySweep::vertex(const Event& event) const {
  const HalfedgeId h = edges_[event.edge].halfedge;
  return event.begins == edges_[event.edge].mesh_above ? mesh_.origin(h) : mesh_.target(h);
}

bool BoundarySweep::begin(std::uint32_t edge) {
  const auto place = line_.insert(edges_[edge]).first;
  places_[edge] = place;
  return (place != line_.begin() && meet(std::prev(place), place)) ||
         (std::next(place) != line_.end() && meet(place, std::next(place)));
}

bool BoundarySweep::end(std::uint32_t edge) {
  const auto above = line_.erase(places_[edge]);
  return above != line_.begin() && above != line_.end() && meet(std::prev(above), above);
}

/// Two edges begin at a vertex: do their triangles, between them, lie on those that begin below?
bool BoundarySweep::covers_twice(const Event& one, const Event& other) {
  const auto first = places_[one.edge], second = places_[other.edge];
  const auto lower = IsBelow()(*first, *second) ? first : second;
  if (!lower->mesh_above || lower == line_.begin() || !std::prev(lower)->mesh_above) return false;
  clash_ = {BoundaryClash::covered, lower->halfedge, std::prev(lower)->halfedge};
  return true;
}

/// Notes a clash when two neighbors meet. Edges at a common vertex do not count.
bool BoundarySweep::meet(Line::const_iterator below, Line::const_iterator above) {
  const HalfedgeId g = below->halfedge, h = above->halfedge;
  if (mesh_.target(g) == mesh_.origin(h) || mesh_.target(h) == mesh_.origin(g)) return false;
  if (!segments_meet(below->left, below->right, above->left, above->right)) return false;
  clash_ = {BoundaryClash::meeting, g, h};
  return true;
}

}  // namespace

std::optional<BoundaryClash> find_boundary_clash(const Mesh& mesh) { return BoundarySweep(mesh).find_clash(); }

namespace {

/// A boundary edge as an arc of the unit sphere, in a box.
struct Arc {
  HalfedgeId halfedge;
  Vec3 low, high;
};

Arc arc_of(const Mesh& mesh, HalfedgeId h) {
  const auto unit = [](Vec3 p) { return (1 / length(p)) * p; };
  const Vec3 a = unit(mesh.weighted_vector(mesh.origin(h))), b = unit(mesh.weighted_vector(mesh.target(h)));
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
  // The great circles cross in two points; both arcs go through the same one exactly if these signs agree.
  return abc != Sign::zero && cda != Sign::zero && abc == -abd && cda == -cdb && abc == -cda;
}

bool meet(const Mesh& mesh, HalfedgeId g, HalfedgeId h) {
  const VertexId a = mesh.origin(g), b = mesh.target(g), c = mesh.origin(h), d = mesh.target(h);
  if (b == c || d == a) return false;  // neighbors on their loop, which go different ways
  return arcs_meet(mesh.weighted_vector(a), mesh.weighted_vector(b), mesh.weighted_vector(c), mesh.weighted_vector(d));
}

/// From south to north: tests each arc with the arcs that begin no farther north than it ends.
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

/// Finds a component on the triangles of another one: all of it is there, since boundaries do not meet.
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
