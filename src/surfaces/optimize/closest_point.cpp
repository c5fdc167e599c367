#include "surfaces/optimize/closest_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace temper::surfaces {
namespace {

Vec3 on_segment(Vec3 a, Vec3 b, Vec3 p) {
  return a + std::clamp(dot(p - a, b - a) / squared_length(b - a), 0.0, 1.0) * (b - a);
}

double squared_distance_from_box(const BoundingBox& box, Vec3 p) {
  const auto outside = [](double x, double low, double high) { return std::max({low - x, 0.0, x - high}); };
  return squared_length(Vec3{outside(p.x, box.low.x, box.high.x), outside(p.y, box.low.y, box.high.y),
                             outside(p.z, box.low.z, box.high.z)});
}

std::vector<ClosestPoints::Triangle> triangles_of(const SurfaceMesh& mesh) {
  std::vector<ClosestPoints::Triangle> triangles;
  triangles.reserve(mesh.n_triangles());
  for (const TriangleId t : mesh.triangles()) triangles.push_back(corners_of(mesh, t));
  return triangles;
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// A bound may be this part above the largest distance.
constexpr double kPart = 1e-3;
// The most cuts of a triangle. On a public surface 12 of four million triangles need more than 128.
constexpr int kMostCuts = 200;
// A lower bound of a distance is taken to be smaller by this factor, for its rounding.
constexpr double kSafe = 1 - 1e-9;
// Lengths as parts of the bound. Cuts are kBeyond outside of the sides of a triangle, and cut off at least kThinCut. A
// piece whose sides are shorter than kShort is not halved.
constexpr double kBeyond = 0.5, kThinCut = 0.1, kShort = 1e-4;

/// A convex polygon, or a segment.
using Piece = std::vector<Vec3>;

/// The part of a piece where `over` is at most 0, or with `is_above` the other one.
template <class Over>
Piece part_of(const Piece& piece, const Over& over, bool is_above) {
  Piece part;
  const auto add = [&](Vec3 p) {
    if (part.empty() || (part.back() != p && part.front() != p)) part.push_back(p);
  };
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const Vec3 p = piece[i], q = piece[(i + 1) % piece.size()];
    const double u = over(p), v = over(q);
    if (is_above ? u >= 0 : u <= 0) add(p);
    if ((u < 0 && v > 0) || (u > 0 && v < 0)) add(u < 0 ? p + (u / (u - v)) * (q - p) : q + (v / (v - u)) * (p - q));
  }
  return part;
}

/// Bounds the distance of a piece, which it cuts as often as needed. For one piece.
class PieceBounds {
 public:
  PieceBounds(std::vector<const Target*> near, double enough, double allowed)
      : near_(std::move(near)), bound_{enough, {}}, allowed_(allowed) {}

  [[nodiscard]] DistanceBound of(Piece piece) {
    for (std::size_t i = 0; i < piece.size(); ++i) measure(0.5 * (piece[i] + piece[(i + 1) % piece.size()]));
    pieces_.push_back(std::move(piece));
    for (int cuts = 0; !pieces_.empty() && bound_.most < kInfinity; ++cuts) {
      const Piece next = std::move(pieces_.back());
      pieces_.pop_back();
      add(next, cuts < kMostCuts);
    }
    return bound_;
  }

 private:
  /// Takes the distance of one point into the bound. Returns the closest triangle; null: none is near enough.
  const Target* measure(Vec3 p) {
    const Target* closest = nullptr;
    double least = kInfinity;
    for (const Target* t : near_) {
      const double distance = t->squared_distance(p, least);
      if (distance < least) least = distance, closest = t;
    }
    const double distance = std::sqrt(least);
    if (distance > allowed_) bound_ = {kInfinity, p};
    bound_.most = std::max(bound_.most, distance);
    return closest;
  }

  /// Says whether all of a piece is within a distance of one triangle.
  [[nodiscard]] bool is_near_one(const Piece& piece, double distance) const {
    const double square = distance * distance;
    return std::any_of(near_.begin(), near_.end(), [&](const Target* t) {
      return std::all_of(piece.begin(), piece.end(), [&](Vec3 p) { return t->squared_distance(p, square) <= square; });
    });
  }

  void add(const Piece& piece, bool may_cut) {
    if (is_near_one(piece, bound_.most)) return;
    Vec3 center = {};
    for (const Vec3 p : piece) center = center + (1.0 / static_cast<double>(piece.size())) * p;
    for (const Vec3 p : piece) measure(p);
    const Target* const closest = measure(center);
    if (bound_.most == kInfinity) return;
    const double more = std::min(allowed_, (1 + kPart) * bound_.most);
    if (more > bound_.most && is_near_one(piece, more)) {
      bound_.most = more;
    } else if (!may_cut || !divide(piece, *closest)) {
      for (double most = std::max(more, kShort * allowed_); most < 2 * allowed_; most *= 2) {
        if (!is_near_one(piece, std::min(most, allowed_))) continue;
        bound_.most = std::min(most, allowed_);
        return;
      }
      bound_ = {kInfinity, center};
    }
  }

  /// Cuts a piece around a triangle, or into halves. False: it is too thin.
  bool divide(Piece piece, const Target& triangle) {
    const std::size_t before = pieces_.size();
    const auto cut = [&](const auto& over, double least) {
      const auto [low, high] = std::ranges::minmax(piece, {}, over);
      if (!(over(low) < -least && over(high) > least)) return;
      pieces_.push_back(part_of(piece, over, true));
      piece = part_of(piece, over, false);
    };
    for (const double height : {kBeyond * bound_.most, 0.0}) {
      if (pieces_.size() > before) break;
      for (std::size_t k = 0; k < 3; ++k)
        cut([&](Vec3 p) { return triangle.beyond(k, p) - height; }, kThinCut * bound_.most);
    }
    if (pieces_.size() == before) {
      Vec3 longest, middle;
      for (std::size_t i = 0; i < piece.size(); ++i) {
        const Vec3 side = piece[(i + 1) % piece.size()] - piece[i];
        if (squared_length(side) > squared_length(longest)) longest = side, middle = piece[i] + 0.5 * side;
      }
      if (length(longest) <= kShort * bound_.most) return false;
      cut([&](Vec3 p) { return dot(longest, p - middle); }, 0);
    }
    pieces_.push_back(std::move(piece));
    return true;
  }

  std::vector<const Target*> near_;
  DistanceBound bound_;
  double allowed_;
  std::vector<Piece> pieces_;
};

}  // namespace

Vec3 closest_point(const std::array<Vec3, 3>& triangle, Vec3 p) {
  const auto& [a, b, c] = triangle;
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double bb = squared_length(ab), bc = dot(ab, ac), cc = squared_length(ac), determinant = bb * cc - bc * bc;
  // No number for a segment.
  const double at_b = (cc * dot(ab, ap) - bc * dot(ac, ap)) / determinant;
  const double at_c = (bb * dot(ac, ap) - bc * dot(ab, ap)) / determinant;
  if (at_b >= 0 && at_c >= 0 && at_b + at_c <= 1) return a + at_b * ab + at_c * ac;
  Vec3 best = on_segment(a, b, p);
  if (cc == 0) return best;
  for (const Vec3 other : {on_segment(b, c, p), on_segment(c, a, p)}) {
    if (squared_length(other - p) < squared_length(best - p)) best = other;
  }
  return best;
}

Target::Target(const std::array<Vec3, 3>& triangle) : corners(triangle) {
  const auto unit = [](Vec3 a) { return squared_length(a) > 0 ? (1 / length(a)) * a : Vec3{}; };
  normal = is_segment() ? Vec3{} : unit(cross(corners[1] - corners[0], corners[2] - corners[0]));
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 side = corners[(k + 1) % 3] - corners[k];
    away[k] = unit(is_segment() ? side : cross(side, normal));
  }
}

double Target::squared_distance(Vec3 p, double most) const {
  if (p == corners[0] || p == corners[1] || p == corners[2]) return 0;  // without rounding
  const double height = dot(normal, p - corners[0]);
  double farthest = 0, least = kInfinity;
  for (std::size_t k = 0; k < 3; ++k) farthest = std::max(farthest, beyond(k, p));
  if ((height * height + farthest * farthest) * kSafe > most) return kInfinity;
  const bool is_sliver = !is_segment() && squared_length(normal) == 0;  // then its sides are all there is
  if (!is_segment() && !is_sliver && farthest == 0) return height * height;
  // The closest point is on a side that p is beyond.
  for (std::size_t k = 0; k < 3; ++k) {
    if (is_segment() ? k > 0 : !is_sliver && beyond(k, p) <= 0) continue;
    least = std::min(least, squared_length(on_segment(corners[k], corners[(k + 1) % 3], p) - p));
  }
  return least <= most ? least : kInfinity;
}

ClosestPoints::ClosestPoints(const SurfaceMesh& mesh) : ClosestPoints(triangles_of(mesh)) {}

ClosestPoints::ClosestPoints(const std::vector<Triangle>& triangles)
    : targets_(triangles.begin(), triangles.end()), order_(triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  if (!order_.empty()) build(0, 0, order_.size());
}

BoundingBox ClosestPoints::box_of(std::size_t first, std::size_t last) const {
  const auto box = [&](std::size_t i) {
    const auto& [a, b, c] = targets_[order_[i]].corners;
    return united(temper::box_of(a, b), {c, c});
  };
  BoundingBox all = box(first);
  for (std::size_t i = first + 1; i < last; ++i) all = united(all, box(i));
  return all;
}

void ClosestPoints::build(std::size_t node, std::size_t first, std::size_t last) {
  if (boxes_.size() <= node) boxes_.resize(node + 1);
  boxes_[node] = box_of(first, last);
  if (last - first <= kLeaf) return;
  double Vec3::*const axis = boxes_[node].longest();
  const auto middle = [&](std::uint32_t t) {
    const auto& [a, b, c] = targets_[t].corners;
    return a.*axis + b.*axis + c.*axis;
  };
  const auto before = [&](std::uint32_t s, std::uint32_t t) {
    return middle(s) != middle(t) ? middle(s) < middle(t) : s < t;
  };
  const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  const std::size_t half = (first + last) / 2;
  std::nth_element(at(first), at(half), at(last), before);
  build(2 * node + 1, first, half);
  build(2 * node + 2, half, last);
}

ClosestPoint ClosestPoints::find(Vec3 p) const {
  Search state{p, {}};
  state.best.squared_distance = kInfinity;
  if (order_.empty()) return state.best;
  search(0, 0, order_.size(), state);
  ClosestPoint& best = state.best;
  best.at = best.squared_distance == 0 ? p : closest_point(targets_[best.triangle].corners, p);
  best.squared_distance = squared_length(best.at - p);
  return best;
}

DistanceBound ClosestPoints::bound(const Triangle& triangle, double enough, double allowed) const {
  std::vector<const Target*> targets;
  for (const std::uint32_t t : near(triangle, allowed)) targets.push_back(&targets_[t]);
  const auto& [a, b, c] = triangle;
  return PieceBounds(std::move(targets), enough, allowed).of(c == a ? Piece{a, b} : Piece{a, b, c});
}

std::vector<std::uint32_t> ClosestPoints::near(const Triangle& triangle, double distance) const {
  const auto& [a, b, c] = triangle;
  std::vector<std::uint32_t> found;
  if (!order_.empty()) collect(0, 0, order_.size(), united(temper::box_of(a, b), {c, c}).grown(distance), found);
  return found;
}

void ClosestPoints::collect(std::size_t node, std::size_t first, std::size_t last, const BoundingBox& box,
                            std::vector<std::uint32_t>& found) const {
  if (!boxes_[node].meets(box)) return;
  const std::size_t half = (first + last) / 2;
  if (last - first > kLeaf) {
    collect(2 * node + 1, first, half, box, found);
    collect(2 * node + 2, half, last, box, found);
    return;
  }
  for (std::size_t i = first; i < last; ++i) {
    if (box_of(i, i + 1).meets(box)) found.push_back(order_[i]);
  }
}

void ClosestPoints::search(std::size_t node, std::size_t first, std::size_t last, Search& state) const {
  if (last - first <= kLeaf) {
    ClosestPoint& best = state.best;
    for (std::size_t i = first; i < last; ++i) {
      const std::uint32_t t = order_[i];
      const double distance = targets_[t].squared_distance(state.p, best.squared_distance);
      if (distance < best.squared_distance || (distance == best.squared_distance && t < best.triangle))
        best.squared_distance = distance, best.triangle = t;
    }
    return;
  }
  const std::size_t half = (first + last) / 2, left = 2 * node + 1, right = left + 1;
  const double to_left = squared_distance_from_box(boxes_[left], state.p),
               to_right = squared_distance_from_box(boxes_[right], state.p);
  const auto visit_left = [&] {
    if (to_left <= state.best.squared_distance) search(left, first, half, state);
  };
  const auto visit_right = [&] {
    if (to_right <= state.best.squared_distance) search(right, half, last, state);
  };
  if (to_left <= to_right) {
    visit_left(), visit_right();
  } else {
    visit_right(), visit_left();
  }
}

}  // namespace temper::surfaces
