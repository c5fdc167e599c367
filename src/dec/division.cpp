#include "dec/division.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "temper/detail/geometry.hpp"

namespace temper {
namespace {

// Pieces below this share of their triangle are rounding: their cells touch it at a point or along a line.
constexpr double kNegligible = 1e-15;

/// The angle from a to b, counter-clockwise, in [0, 2π).
double angle_between(Vec2 a, Vec2 b) {
  const double angle = std::atan2(cross(a, b), dot(a, b));
  return angle < 0 ? angle + 2 * std::numbers::pi : angle;
}

/// Angles of the spokes of a boundary vertex, from the first one on, counter-clockwise, and their far ends.
struct Fan {
  std::vector<VertexId> ends;
  std::vector<double> angles;
};

double angle_at(const Mesh& mesh, VertexId v, VertexId a, VertexId b) {
  const auto [p, q, r] = mesh.points(v, a, b);
  return corner_angle(mesh.space(), p, q, r);
}

Fan fan_of(const Mesh& mesh, VertexId v) {
  Fan fan;
  double angle = 0;
  HalfedgeId last;
  for (const HalfedgeId h : mesh.star(v)) {
    fan.ends.push_back(mesh.target(h));
    fan.angles.push_back(angle);
    angle += angle_at(mesh, v, mesh.target(h), mesh.opposite(h));
    last = h;
  }
  fan.ends.push_back(mesh.opposite(last));
  fan.angles.push_back(angle);
  return fan;
}

/// The angle of a direction in the fan of a boundary vertex; outside of the fan, the angle of the nearer end.
double angle_in(const Fan& fan, Vec2 first, Vec2 direction) {
  const double angle = angle_between(first, direction), whole = fan.angles.back();
  if (angle <= whole) return angle;
  return angle - whole < 2 * std::numbers::pi - angle ? whole : 0;
}

Vec2 mean_of(const std::vector<PieceCorner>& polygon) {
  Vec2 sum;
  for (const PieceCorner& c : polygon) sum = sum + c.at;
  return (1.0 / static_cast<double>(polygon.size())) * sum;
}

}  // namespace

std::vector<CellPiece> TriangleDivider::divide(TriangleId t) {
  t = joints_.whole(t);
  const std::array own = {Mesh::halfedge(t, 0), Mesh::halfedge(t, 1), Mesh::halfedge(t, 2)};
  const std::span<const HalfedgeId> sides = joints_.has(t) ? joints_.sides(t) : own;
  chart_ = Chart::of_triangle(mesh_, t);
  whole_.clear();
  for (const HalfedgeId h : sides) whole_.push_back({chart_.of(mesh_, mesh_.origin(h)).position(), {}, h});
  n_candidates_ = 0;
  for (const HalfedgeId h : sides) add(mesh_.origin(h));
  const double negligible = kNegligible * area_of(whole_);
  for (std::size_t i = 0; i < n_candidates_; ++i) {
    if (area_of(candidates_[i].piece) > negligible) expand(i);
  }
  std::vector<CellPiece> pieces;
  for (std::size_t i = 0; i < n_candidates_; ++i) {
    const Candidate& c = candidates_[i];
    if (area_of(c.piece) <= negligible) continue;
    pieces.push_back({c.vertex, t, c.piece});
    if (joints_.has(t)) move_onto_orthocenter(pieces.back());
  }
  return pieces;
}

/// All bisectors of the corners of a polygon meet at its orthocenter. Where they cross each other or a side near it,
/// the difference is rounding.
void TriangleDivider::move_onto_orthocenter(CellPiece& piece) const {
  constexpr double kNear = 1e-7;  // of the triangle, as in keep_faces()
  const auto [i, j, k] = mesh_.corners(piece.triangle);
  const WeightedPoint a = chart_.of(mesh_, i), b = chart_.of(mesh_, j), c = chart_.of(mesh_, k);
  const Vec2 center = orthocenter(a, b, c);
  const double near = kNear * std::sqrt(cross(b.position() - a.position(), c.position() - a.position()));
  for (PieceCorner& corner : piece.corners) {
    const double distance = length(corner.at - center);
    if (distance > near) continue;
    piece.moved = std::max(piece.moved, distance);
    corner.at = center;
  }
}

/// Takes from the others the part that is nearer to v.
void TriangleDivider::add(VertexId v) {
  for (std::size_t i = 0; i < n_candidates_; ++i) {
    if (candidates_[i].vertex == v) return;
  }
  if (n_candidates_ == candidates_.size()) candidates_.emplace_back();
  Candidate& added = candidates_[n_candidates_];
  added.vertex = v;
  const WeightedPoint p = chart_.of(mesh_, v);
  added.at = p.position();
  added.weight = p.w;
  added.piece.clear();
  const std::size_t others = n_candidates_++;
  if (others > 0 && !wins_anywhere(added, others)) return;
  added.piece = whole_;
  for (std::size_t i = 0; i < others && !added.piece.empty(); ++i) {
    if (!candidates_[i].piece.empty()) clip(added.piece, added, candidates_[i]);
  }
  if (added.piece.empty()) return;
  for (std::size_t i = 0; i < others; ++i) {
    if (!candidates_[i].piece.empty()) clip(candidates_[i].piece, candidates_[i], added);
  }
}

/// Says whether the vertex added is nearer than the owner anywhere. The difference is linear on each piece, so the
/// corners of the pieces decide.
bool TriangleDivider::wins_anywhere(const Candidate& added, std::size_t others) const {
  for (std::size_t i = 0; i < others; ++i) {
    const Candidate& owner = candidates_[i];
    const Vec2 e = added.at - owner.at;
    const double constant = squared_length(e) + (owner.weight - added.weight);
    for (const PieceCorner& c : owner.piece) {
      if (2 * dot(c.at - owner.at, e) > constant) return true;
    }
  }
  return false;
}

void TriangleDivider::expand(std::size_t i) {
  const VertexId v = candidates_[i].vertex;
  if (!mesh_.is_boundary(v)) {
    for (const HalfedgeId h : mesh_.star(v)) add(mesh_.target(h));
    return;
  }
  const Fan fan = fan_of(mesh_, v);
  const bool reflex = fan.angles.back() > std::numbers::pi;
  double here = 0;
  if (reflex) {
    const Vec2 first = chart_.of(mesh_, fan.ends[0]).position() - candidates_[i].at;
    here = angle_in(fan, first, mean_of(candidates_[i].piece) - candidates_[i].at);
  }
  for (std::size_t k = 0; k < fan.ends.size(); ++k) {
    if (!reflex || std::abs(fan.angles[k] - here) < std::numbers::pi) add(fan.ends[k]);
  }
}

/// Keeps the part where the power distance to `owner` is not above the power distance to `other`. Let y be the vector
/// from one vertex and e the vector to the other: 2 y·e − |e|² + w_other − w_owner ≤ 0. Computed from the lower vertex,
/// so that both get the same corners.
void TriangleDivider::clip(std::vector<PieceCorner>& piece, const Candidate& owner, const Candidate& other) {
  const bool swapped = other.vertex < owner.vertex;
  const Candidate& low = swapped ? other : owner;
  const Candidate& high = swapped ? owner : other;
  const Vec2 e = high.at - low.at;
  const double constant = squared_length(e) + (low.weight - high.weight), sign = swapped ? -1 : 1;
  const std::size_t n = piece.size();
  sides_.resize(n);
  bool any_out = false, any_in = false;
  for (std::size_t i = 0; i < n; ++i) {
    sides_[i] = sign * (2 * dot(piece[i].at - low.at, e) - constant);
    (sides_[i] > 0 ? any_out : any_in) = true;
  }
  if (!any_out) return;
  if (!any_in) return piece.clear();
  scratch_.clear();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = i + 1 == n ? 0 : i + 1;
    const bool in = sides_[i] <= 0, next_in = sides_[j] <= 0;
    if (in) scratch_.push_back(piece[i]);
    if (in == next_in) continue;
    const double share = sides_[i] / (sides_[i] - sides_[j]);
    const Vec2 at = piece[i].at + share * (piece[j].at - piece[i].at);
    if (in) {
      scratch_.push_back({at, other.vertex, {}});
    } else {
      scratch_.push_back({at, piece[i].against, piece[i].along});
    }
  }
  piece.swap(scratch_);
}

// Every piece brings its corners as nodes and its sides as arcs. If two pieces lie on the two sides of a mesh edge, the
// two arcs are removed, and their ends become one node (union-find). The remaining arcs run around the union,
// counter-clockwise.

namespace {

// Coinciding corners are computed twice and differ by rounding, which is larger if a bisector meets the edge at a small
// angle. Relative to the size of the cell; a wrong join would change the area.
constexpr double kSamePlace = 1e-10;
// The change that joining may make to the area of a cell.
constexpr double kSameArea = 1e-12;

struct Arc {
  std::size_t from, to;
  VertexId against;
  HalfedgeId along;
  bool gone = false;
};

class PieceJoiner {
 public:
  /// The polygons are the places of the pieces' corners.
  PieceJoiner(const Mesh& mesh, std::span<const CellPiece> pieces, const std::vector<LocalPolygon>& polygons);
  std::vector<LocalPolygon> join();

 private:
  std::size_t root(std::size_t node);
  void unite(std::size_t a, std::size_t b);
  void cancel();
  void take_shared(std::size_t i, std::size_t j);
  [[nodiscard]] bool same_place(std::size_t a, std::size_t b) const {
    return length(places_[a] - places_[b]) <= kSamePlace * size_;
  }
  LocalPolygon trace(std::size_t first);
  [[nodiscard]] std::size_t following(std::size_t arc) const;

  const Mesh& mesh_;
  std::vector<Vec2> places_;  // of nodes
  std::vector<std::size_t> parents_;
  std::vector<Arc> arcs_;
  double size_ = 0;
};

PieceJoiner::PieceJoiner(const Mesh& mesh, std::span<const CellPiece> pieces, const std::vector<LocalPolygon>& polygons)
    : mesh_(mesh) {
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const auto& corners = pieces[k].corners;
    const std::size_t first = places_.size(), n = corners.size();
    places_.insert(places_.end(), polygons[k].begin(), polygons[k].end());
    for (std::size_t i = 0; i < n; ++i) {
      arcs_.push_back({first + i, first + (i + 1) % n, corners[i].against, corners[i].along});
    }
  }
  for (const Vec2 p : places_) size_ = std::max(size_, length(p - places_[0]));
  parents_.resize(places_.size());
  std::iota(parents_.begin(), parents_.end(), std::size_t{0});
}

std::size_t PieceJoiner::root(std::size_t node) {
  while (parents_[node] != node) node = parents_[node] = parents_[parents_[node]];
  return node;
}

void PieceJoiner::unite(std::size_t a, std::size_t b) {
  a = root(a), b = root(b);
  parents_[std::max(a, b)] = std::min(a, b);
}

void PieceJoiner::cancel() {
  std::vector<std::size_t> on_edges;
  for (std::size_t i = 0; i < arcs_.size(); ++i) {
    Arc& arc = arcs_[i];
    if (same_place(arc.from, arc.to)) {
      arc.gone = true;
      unite(arc.from, arc.to);
    } else if (arc.along.valid() && mesh_.twin(arc.along).valid()) {
      on_edges.push_back(i);
    }
  }
  // A cell has at most one arc on each half-edge: its pieces are convex.
  std::sort(on_edges.begin(), on_edges.end(),
            [&](std::size_t a, std::size_t b) { return arcs_[a].along < arcs_[b].along; });
  for (const std::size_t i : on_edges) {
    const HalfedgeId h = arcs_[i].along, twin = mesh_.twin(h);
    if (twin < h) continue;
    const auto j = std::lower_bound(on_edges.begin(), on_edges.end(), twin,
                                    [&](std::size_t a, HalfedgeId side) { return arcs_[a].along < side; });
    if (j == on_edges.end() || arcs_[*j].along != twin) continue;
    take_shared(i, *j);
  }
  for (Arc& arc : arcs_) {
    arc.from = root(arc.from), arc.to = root(arc.to);
    if (arc.from == arc.to) arc.gone = true;
  }
}

/// Takes from two arcs on the two sides of an edge the part that they share. In a regular mesh it is all of both.
/// Otherwise the ends that only one of them has stay as shorter arcs.
void PieceJoiner::take_shared(std::size_t i, std::size_t j) {
  const Arc arc = arcs_[i], other = arcs_[j];  // copies: arcs_ grows
  const Vec2 along = places_[arc.to] - places_[arc.from];
  const auto position = [&](std::size_t node) { return dot(places_[node] - places_[arc.from], along) / length(along); };
  const double low = std::max(0.0, position(other.to)), high = std::min(length(along), position(other.from));
  if (high - low <= kSamePlace * size_) return;
  arcs_[i].gone = arcs_[j].gone = true;
  const auto settle = [&](std::size_t mine, std::size_t theirs, bool mine_sticks_out, bool at_low) {
    if (same_place(mine, theirs)) return unite(mine, theirs);
    const bool outgoing = mine_sticks_out == at_low;  // of the arc that sticks out, the end before the shared part
    const std::size_t out = mine_sticks_out ? mine : theirs, shared = mine_sticks_out ? theirs : mine;
    arcs_.push_back({outgoing ? out : shared, outgoing ? shared : out, {}, mine_sticks_out ? arc.along : other.along});
  };
  settle(arc.from, other.to, position(other.to) > 0, true);
  settle(arc.to, other.from, position(other.from) < length(along), false);
}

/// The arc that continues from the end of another, with the sharpest left turn, so that polygons that touch at a corner
/// stay apart. None: arcs_.size().
std::size_t PieceJoiner::following(std::size_t arc) const {
  const auto first = std::lower_bound(arcs_.begin(), arcs_.end(), arcs_[arc].to,
                                      [](const Arc& a, std::size_t node) { return a.from < node; });
  const Vec2 ahead = places_[arcs_[arc].to] - places_[arcs_[arc].from];
  std::size_t best = arcs_.size();
  double sharpest = -2 * std::numbers::pi;
  for (auto a = first; a != arcs_.end() && a->from == arcs_[arc].to; ++a) {
    if (a->gone) continue;
    const Vec2 out = places_[a->to] - places_[a->from];
    const double left = std::atan2(cross(ahead, out), dot(ahead, out));
    if (left > sharpest) sharpest = left, best = static_cast<std::size_t>(a - arcs_.begin());
  }
  return best;
}

/// The polygon of an arc, without the corners where a bisector only crosses from one triangle into the next. Empty when
/// it does not close. Its arcs are removed.
LocalPolygon PieceJoiner::trace(std::size_t first) {
  LocalPolygon polygon;
  for (std::size_t at = first;;) {
    if (at != first) arcs_[at].gone = true;  // the first one stays to be found at the end
    const std::size_t next = following(at);
    const bool open = next == arcs_.size();
    if (open || next == first) arcs_[first].gone = true;
    if (open) return {};
    const bool straight = arcs_[at].against.valid() && arcs_[at].against == arcs_[next].against;
    if (!straight) polygon.push_back(places_[arcs_[at].to]);
    if (next == first) return polygon;
    at = next;
  }
}

std::vector<LocalPolygon> PieceJoiner::join() {
  cancel();
  arcs_.erase(std::remove_if(arcs_.begin(), arcs_.end(), [](const Arc& a) { return a.gone; }), arcs_.end());
  std::stable_sort(arcs_.begin(), arcs_.end(), [](const Arc& a, const Arc& b) { return a.from < b.from; });
  std::vector<LocalPolygon> polygons;
  for (std::size_t i = 0; i < arcs_.size(); ++i) {
    if (arcs_[i].gone) continue;
    polygons.push_back(trace(i));
    if (!(area_of(polygons.back()) > 0)) return {};  // a hole, or what did not close
  }
  return polygons;
}

}  // namespace

std::vector<LocalPolygon> join_pieces(const Mesh& mesh, const Chart& chart, std::span<const CellPiece> pieces) {
  double area = 0, joined_area = 0, moved = 0, size = 0;
  std::vector<LocalPolygon> apart;
  for (const CellPiece& piece : pieces) {
    const Chart plane = Chart::of_triangle(mesh, piece.triangle);
    LocalPolygon& polygon = apart.emplace_back();
    for (const PieceCorner& c : piece.corners) polygon.push_back(chart.moved(plane, c.at));
    area += area_of(polygon);
    moved += piece.moved;
    for (const Vec2 p : polygon) size = std::max(size, length(p - polygon.front()));
  }
  std::vector<LocalPolygon> joined = PieceJoiner(mesh, pieces, apart).join();
  for (const LocalPolygon& polygon : joined) joined_area += area_of(polygon);
  return std::abs(joined_area - area) <= kSameArea * area + moved * size ? joined : apart;
}

}  // namespace temper
