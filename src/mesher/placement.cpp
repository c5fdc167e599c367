// The advancing front. Distances to points by a hashed grid of several levels, to pieces by a tree of boxes.
#include "mesher/placement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "geometry/bounding_boxes.hpp"
#include "mesher/point_grid.hpp"

namespace temper::mesher {
namespace {

// Parts of the local size. Neighbours in a perfect row are 1 apart, the first row 0.87 from the outline; what is taken
// much nearer than that makes the short edges that a denser packing needs, what is refused leaves holes.
constexpr double kApart = 0.72;
constexpr double kClear = 0.5;
constexpr std::array<double, 3> kHeights = {0.866, 0.7, 0.55};

/// A point of the front: it proposes its six neighbours.
struct Front {
  Vec3 at;
  Vec3 direction;  // of the first proposal, of length 1
  std::int32_t area;
};

class Placement {
 public:
  Placement(const Ground& ground, const DividedOutline& divided, const Areas& areas, const GradedSize& size,
            Deadline& deadline)
      : ground_(ground),
        divided_(divided),
        areas_(areas),
        size_(size),
        deadline_(deadline),
        grid_(ground.space().dimension() == 2) {
    std::vector<BoundingBox> boxes;
    boxes.reserve(divided.pieces.size());
    for (const Piece& p : divided.pieces)
      boxes.push_back(box_around(ground, divided.points[p.ends[0]], divided.points[p.ends[1]]));
    tree_ = BoundingBoxTree(boxes);
    for (const Vec3 p : divided.points) grid_.add(p, size(p));
  }

  std::vector<Vec3> run(Vec3 start, std::size_t most) {
    for (std::size_t i = 0; i < divided_.pieces.size() && !deadline_.asked_to_stop(); ++i) start_from(i);
    const std::size_t given = divided_.pieces.empty() ? start_without_pieces(start) : 0;
    for (std::size_t i = 0; i < front_.size() && front_.size() < most && !deadline_.asked_to_stop(); ++i) {
      const Front from = front_[i];  // a copy: front_ grows
      const double here = size_at(from.at, from.area);
      for (int k = 0; k < 6; ++k) {
        const double angle = k * std::numbers::pi / 3;
        const double c = std::cos(angle), s = std::sin(angle);
        const Vec3 d = c * from.direction + s * ground_.to_the_left(from.direction, from.at);
        const double there = size_at(ground_.below(from.at + here * d), from.area);
        take(ground_.below(from.at + 0.5 * (here + there) * d), from.at, from.area, kNoPiece);
      }
    }
    std::vector<Vec3> points;
    points.reserve(front_.size() - given);
    for (std::size_t i = given; i < front_.size(); ++i) points.push_back(front_[i].at);
    return points;
  }

 private:
  static constexpr std::size_t kNoPiece = static_cast<std::size_t>(-1);

  [[nodiscard]] double size_at(Vec3 p, std::int32_t area) const {
    return std::min(size_(p), areas_.areas[static_cast<std::size_t>(area)].size);
  }

  /// The apex of the triangle on a piece, on each side that is inside.
  void start_from(std::size_t i) {
    const Piece& piece = divided_.pieces[i];
    const Vec3 a = divided_.points[piece.ends[0]], b = divided_.points[piece.ends[1]];
    const Vec3 middle = ground_.below(0.5 * (a + b)),
               normal = ground_.to_the_left((1 / length(b - a)) * (b - a), middle);
    for (const int side : {0, 1}) {
      const std::int32_t area = areas_.sides[piece.edge][static_cast<std::size_t>(side)];
      if (area == kOutside) continue;
      const Vec3 inwards = side == 0 ? normal : -1.0 * normal;
      const double size = size_at(middle, area);
      for (const double height : kHeights) {
        if (take(ground_.below(middle + (height * size) * inwards), middle, area, i)) break;
      }
    }
  }

  /// Returns how many points of the front are there already.
  std::size_t start_without_pieces(Vec3 start) {
    for (const Vec3 p : divided_.points) front_.push_back({p, ground_.some_direction(p), 0});
    if (front_.empty()) {
      grid_.add(start, size_at(start, 0));
      front_.push_back({start, ground_.some_direction(start), 0});
    }
    return divided_.points.size();
  }

  bool take(Vec3 p, Vec3 from, std::int32_t area, std::size_t own_piece) {
    const double size = size_at(p, area);
    if (grid_.any_within(p, kApart * size) || !is_clear(p, from, kClear * size, own_piece)) return false;
    grid_.add(p, size);
    front_.push_back({p, -1.0 * ground_.direction(p, from), area});
    return true;
  }

  /// No piece is within the distance of p, or between p and where it comes from.
  [[nodiscard]] bool is_clear(Vec3 p, Vec3 from, double distance, std::size_t own_piece) const {
    const BoundingBox box = united(BoundingBox{p, p}.grown(distance), box_around(ground_, p, from));
    return tree_.visit(box, [&](std::size_t i) {
      const Vec3 a = divided_.points[divided_.pieces[i].ends[0]], b = divided_.points[divided_.pieces[i].ends[1]];
      if (ground_.squared_distance(p, a, b) < distance * distance) return false;
      return i == own_piece || !(ground_.orientation(a, b, p) != ground_.orientation(a, b, from) &&
                                 ground_.orientation(p, from, a) != ground_.orientation(p, from, b));
    });
  }

  const Ground& ground_;
  const DividedOutline& divided_;
  const Areas& areas_;
  const GradedSize& size_;
  Deadline& deadline_;
  BoundingBoxTree tree_;
  PointGrid grid_;
  std::vector<Front> front_;
};

}  // namespace

std::vector<Vec3> place_points(const Ground& ground, const DividedOutline& divided, const Areas& areas,
                               const GradedSize& size, Vec3 start, std::size_t most, Deadline& deadline) {
  return Placement(ground, divided, areas, size, deadline).run(start, most);
}

}  // namespace temper::mesher
