#include "dec/division.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "temper/detail/geometry.hpp"

namespace temper {
namespace {

// Pieces below this share of their triangle are rounding: of cells that touch it at a point or along a line.
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

/// The angle of a direction in the fan of a boundary vertex, or that of the nearer end when it is outside.
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
  const std::array<VertexId, 3> corners = mesh_.corners(t);
  chart_ = Chart::of_triangle(mesh_, t);
  whole_.clear();
  for (int k = 0; k < 3; ++k) {
    whole_.push_back({chart_.of(mesh_, corners[static_cast<std::size_t>(k)]).position(), {}, Mesh::halfedge(t, k)});
  }
  n_candidates_ = 0;
  for (const VertexId v : corners) add(v);
  const double negligible = kNegligible * area_of(whole_);
  for (std::size_t i = 0; i < n_candidates_; ++i) {
    if (area_of(candidates_[i].piece) > negligible) expand(i);
  }
  std::vector<CellPiece> pieces;
  for (std::size_t i = 0; i < n_candidates_; ++i) {
    const Candidate& c = candidates_[i];
    if (area_of(c.piece) > negligible) pieces.push_back({c.vertex, t, c.piece});
  }
  return pieces;
}

/// Takes from the others what is nearer to v.
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

/// Says whether the vertex added is nearer than the owner anywhere: at a corner of one of the pieces, since the
/// difference is linear on each piece.
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

/// Keeps where the power distance to `owner` is not above that to `other`: with y from the one and e from the one to
/// the other, 2 y·e − |e|² + w_other − w_owner ≤ 0. Computed from the lower vertex, so that both get the same corners.
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

}  // namespace temper
