#include "mesher/face_sites.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace temper::mesher {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kSharedAngle = 115 * kDegree;  // as kSharedCosine
constexpr double kSteepest = 80 * kDegree;      // between a piece and the way from its end to its site

/// Two branches of a node with one site between them: the second follows the first, counter-clockwise.
struct Share {
  const FaceNode* node;
  const Branch *first, *second;
};

class SiteMaker {
 public:
  SiteMaker(const Domain& domain, const DividedOutline& divided, const FaceNodes& nodes,
            const PieceDistances& distances)
      : domain_(domain), divided_(divided), nodes_(nodes), distances_(distances) {
    result_.of_piece.assign(divided.pieces.size(), {-1, -1});
    most_.resize(divided.pieces.size());
    shares_.resize(divided.pieces.size());
  }

  FaceSites run() {
    for (std::uint32_t i = 0; i < divided_.pieces.size(); ++i) {
      if (divided_.pieces[i].is_face) begin(i);
    }
    for (const FaceNode& node : nodes_.nodes) {
      for (std::size_t i = 0; i < node.branches.size(); ++i) {
        if (area_beside(domain_, divided_, node.branches[i], true) != kOutside) limit(node, i);
      }
    }
    for (std::uint32_t i = 0; i < divided_.pieces.size(); ++i) {
      if (!divided_.pieces[i].is_face) continue;
      for (const std::size_t side : {0, 1}) make(i, side);
    }
    return std::move(result_);
  }

 private:
  static std::size_t side_of(const Branch& b, bool left) { return b.is_outwards == left ? 0 : 1; }

  /// The branch of a piece at its first end.
  [[nodiscard]] const Branch& branch(std::uint32_t piece) const {
    const FaceNode& node = *nodes_.at(divided_.pieces[piece].ends[0]);
    return *std::ranges::find_if(node.branches, [&](const Branch& b) { return b.piece == piece && b.is_outwards; });
  }

  void begin(std::uint32_t piece) {
    const auto [p, q] = divided_.pieces[piece].ends;
    const double whole = branch(piece).length;
    most_[piece].fill(0.25 * (whole + std::min({whole, nodes_.at(p)->size, nodes_.at(q)->size})));
  }

  /// Looks at the angle between a branch and the next one.
  void limit(const FaceNode& node, std::size_t i) {
    const Branch &first = node.branches[i], &second = node.branches[node.after(i)];
    const double angle = node.angle_after(i);
    if (first.is_face && second.is_face && angle < kSharedAngle) return share({&node, &first, &second});
    if (!first.is_face && !second.is_face) return;
    // Convex polygons need less than the bisector. A site of a line is on the line itself, at the same reach.
    constexpr double kApart = 12 * kDegree, kBesideLine = 0.7;
    const bool both = first.is_face && second.is_face;
    const double slope = std::tan(std::clamp(0.5 * angle - (both ? kApart : 0), 0.0, kSteepest));
    for (const bool left : {true, false}) {
      const Branch& b = left ? first : second;
      if (!b.is_face) continue;
      double& most = most_[b.piece].at(side_of(b, left));
      most = std::min(most, (both ? 1 : kBesideLine) * slope * b.reach);
    }
  }

  void share(const Share& share) {
    auto &one = shares_[share.first->piece].at(side_of(*share.first, true)),
         &other = shares_[share.second->piece].at(side_of(*share.second, false));
    if (one || other) {
      result_.crowded.push_back(share.node->point);
      return;
    }
    one = other = share;
  }

  void make(std::uint32_t piece, std::size_t side) {
    std::int32_t& site = result_.of_piece[piece].at(side);
    if (site >= 0) return;
    site = static_cast<std::int32_t>(result_.sites.size());
    if (const std::optional<Share>& share = shares_[piece].at(side)) return make_shared(*share, site);
    const auto [p, q] = divided_.pieces[piece].ends;
    const Branch& b = branch(piece);
    const FaceNode &from = *nodes_.at(p), &to = *nodes_.at(q);
    const Vec2 left = {-b.direction.y, b.direction.x}, normal = side == 0 ? left : -1.0 * left;
    const Vec2 foot = from.at + b.reach * b.direction;
    const double t = distances_.free_way(foot, normal, most_[piece].at(side), p, q);
    constexpr double kLeast = 0.02;  // of the length
    if (t < kLeast * b.length) result_.crowded.push_back(p);
    const Vec2 at = foot + t * normal;
    result_.sites.push_back({at, 0.5 * (weight_at(from, at) + weight_at(to, at)),
                             domain_.areas.sides[divided_.pieces[piece].edge].at(side)});
  }

  /// The perpendiculars of both pieces meet at x: x·u = f and x·v = g.
  void make_shared(const Share& share, std::int32_t site) {
    const auto& [node, first, second] = share;
    result_.of_piece[first->piece].at(side_of(*first, true)) = site;
    result_.of_piece[second->piece].at(side_of(*second, false)) = site;
    const Vec2 u = first->direction, v = second->direction;
    const double f = first->reach, g = second->reach, d = cross(u, v);
    const Vec2 at = node->at + (1 / d) * Vec2{f * v.y - g * u.y, g * u.x - f * v.x};
    const double weight =
        (weight_at(*node, at) + weight_at(*nodes_.at(first->far), at) + weight_at(*nodes_.at(second->far), at)) / 3;
    result_.sites.push_back({at, weight, area_beside(domain_, divided_, *first, true)});
  }

  const Domain& domain_;
  const DividedOutline& divided_;
  const FaceNodes& nodes_;
  const PieceDistances& distances_;
  FaceSites result_;
  std::vector<std::array<double, 2>> most_;                  // distance of the site on each side of each piece
  std::vector<std::array<std::optional<Share>, 2>> shares_;  // of each side of each piece
};

}  // namespace

PieceDistances::PieceDistances(const Surface& surface, const DividedOutline& divided)
    : surface_(surface), divided_(divided) {
  std::vector<BoundingBox> boxes;
  boxes.reserve(divided.pieces.size());
  for (const Piece& p : divided.pieces)
    boxes.push_back(box_around(surface, divided.points[p.ends[0]], divided.points[p.ends[1]]));
  tree_ = BoundingBoxTree(boxes);
}

bool PieceDistances::is_free(Vec2 p, double radius, std::uint32_t one, std::uint32_t other) const {
  const Vec3 at = {p.x, p.y, 0};
  return tree_.visit(BoundingBox{at, at}.grown(radius), [&](std::size_t i) {
    const auto [a, b] = divided_.pieces[i].ends;
    if (a == one || a == other || b == one || b == other) return true;
    return surface_.squared_distance(at, divided_.points[a], divided_.points[b]) >= radius * radius;
  });
}

double PieceDistances::free_way(Vec2 from, Vec2 direction, double most, std::uint32_t one, std::uint32_t other) const {
  constexpr int kHalvings = 20;
  const auto is_good = [&](double t) { return is_free(from + t * direction, 2 * t, one, other); };
  if (is_good(most)) return most;
  double good = 0, bad = most;
  for (int i = 0; i < kHalvings; ++i) {
    const double t = 0.5 * (good + bad);
    (is_good(t) ? good : bad) = t;
  }
  return good;
}

FaceSites face_sites(const Domain& domain, const DividedOutline& divided, const FaceNodes& nodes,
                     const PieceDistances& distances) {
  return SiteMaker(domain, divided, nodes, distances).run();
}

}  // namespace temper::mesher
