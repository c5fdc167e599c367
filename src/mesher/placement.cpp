// The advancing front. Distances to points by a hashed grid of several levels, to pieces by a tree of boxes.
#include "mesher/placement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "mesher/box_tree.hpp"
#include "mesher/point_grid.hpp"
#include "temper/geometry.hpp"

namespace temper::mesher {
namespace {

// Parts of the local size. Neighbours in a perfect row are 1 apart, the first row 0.87 from the outline; what is taken
// much nearer than that makes the short edges that a denser packing needs, what is refused leaves holes.
constexpr double kApart = 0.72;
constexpr double kClear = 0.5;
constexpr std::array<double, 3> kHeights = {0.866, 0.7, 0.55};

/// A point of the front: it proposes its six neighbours.
struct Front {
  Vec2 at;
  Vec2 direction;  // of the first proposal, of length 1
  std::int32_t area;
};

class Placement {
 public:
  Placement(const DividedOutline& divided, const Areas& areas, const GradedSize& size, Deadline& deadline)
      : divided_(divided), areas_(areas), size_(size), deadline_(deadline) {
    std::vector<Box> boxes;
    boxes.reserve(divided.pieces.size());
    for (const Piece& p : divided.pieces) boxes.push_back(box_of(divided.points[p.ends[0]], divided.points[p.ends[1]]));
    tree_ = BoxTree(boxes);
    for (const Vec2 p : divided.points) grid_.add(p, size(p));
  }

  std::vector<Vec2> run(std::size_t most) {
    for (std::size_t i = 0; i < divided_.pieces.size() && !deadline_.asked_to_stop(); ++i) start_from(i);
    for (std::size_t i = 0; i < front_.size() && front_.size() < most && !deadline_.asked_to_stop(); ++i) {
      const Front from = front_[i];  // a copy: front_ grows
      const double here = size_at(from.at, from.area);
      for (int k = 0; k < 6; ++k) {
        const double angle = k * std::numbers::pi / 3;
        const double c = std::cos(angle), s = std::sin(angle);
        const Vec2 d = {c * from.direction.x - s * from.direction.y, s * from.direction.x + c * from.direction.y};
        const double there = size_at(from.at + here * d, from.area);
        take(from.at + 0.5 * (here + there) * d, from.at, from.area, kNoPiece);
      }
    }
    std::vector<Vec2> points;
    points.reserve(front_.size());
    for (const Front& f : front_) points.push_back(f.at);
    return points;
  }

 private:
  static constexpr std::size_t kNoPiece = static_cast<std::size_t>(-1);

  [[nodiscard]] double size_at(Vec2 p, std::int32_t area) const {
    return std::min(size_(p), areas_.areas[static_cast<std::size_t>(area)].size);
  }

  /// The apex of the triangle on a piece, on each side that is inside.
  void start_from(std::size_t i) {
    const Piece& piece = divided_.pieces[i];
    const Vec2 a = divided_.points[piece.ends[0]], b = divided_.points[piece.ends[1]];
    const Vec2 middle = 0.5 * (a + b), normal = (1 / length(b - a)) * Vec2{a.y - b.y, b.x - a.x};
    for (const int side : {0, 1}) {
      const std::int32_t area = areas_.sides[piece.edge][static_cast<std::size_t>(side)];
      if (area == kOutside) continue;
      const Vec2 inwards = side == 0 ? normal : -1.0 * normal;
      const double size = size_at(middle, area);
      for (const double height : kHeights) {
        if (take(middle + (height * size) * inwards, middle, area, i)) break;
      }
    }
  }

  bool take(Vec2 p, Vec2 from, std::int32_t area, std::size_t own_piece) {
    const double size = size_at(p, area);
    if (grid_.any_within(p, kApart * size) || !is_clear(p, from, kClear * size, own_piece)) return false;
    grid_.add(p, size);
    const Vec2 way = p - from;
    front_.push_back({p, (1 / length(way)) * way, area});
    return true;
  }

  /// No piece is within the distance of p, or between p and where it comes from.
  [[nodiscard]] bool is_clear(Vec2 p, Vec2 from, double distance, std::size_t own_piece) const {
    const Box box = united(Box{p, p}.grown(distance), box_of(p, from));
    return tree_.visit(box, [&](std::size_t i) {
      const Vec2 a = divided_.points[divided_.pieces[i].ends[0]], b = divided_.points[divided_.pieces[i].ends[1]];
      const double along = std::clamp(dot(p - a, b - a) / squared_length(b - a), 0.0, 1.0);
      if (squared_length(p - a - along * (b - a)) < distance * distance) return false;
      return i == own_piece ||
             !(orient2d(a, b, p) != orient2d(a, b, from) && orient2d(p, from, a) != orient2d(p, from, b));
    });
  }

  const DividedOutline& divided_;
  const Areas& areas_;
  const GradedSize& size_;
  Deadline& deadline_;
  BoxTree tree_;
  PointGrid grid_;
  std::vector<Front> front_;
};

}  // namespace

std::vector<Vec2> place_points(const DividedOutline& divided, const Areas& areas, const GradedSize& size,
                               std::size_t most, Deadline& deadline) {
  return Placement(divided, areas, size, deadline).run(most);
}

}  // namespace temper::mesher
