// The advancing front. Distances to points by a hashed grid of several levels, to pieces by a tree of boxes.
#include "mesher/placement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "geometry/bounding_boxes.hpp"
#include "temper/detail/vec.hpp"

namespace temper::mesher {

// Consider the constrained Delaunay triangulation of the divided outline alone. Every inner edge spans a gap, and every
// triangle on a piece measures the distance to the other side. Neighbors along the outline are no gap, unless their
// corner is sharp.

namespace {

// Two rows of equilateral triangles across a gap have edges of 0.577 of it.
constexpr double kOfGap = 0.6;
// Sites beside two faces are at a third of the gap: no free vertex has to be between them.
constexpr double kOfGapOfFaces = 0.9;
// A size below this part of the present one is a new one.
constexpr double kLess = 0.9;

class Narrow {
 public:
  Narrow(const DividedOutline& divided, const Triangulated& triangulated, const GradedSize& size)
      : divided_(divided), mesh_(triangulated.mesh), triangulated_(triangulated), size_(size) {
    around_.resize(divided.points.size());
    edge_.resize(divided.points.size());
    is_on_face_.resize(divided.points.size());
    for (std::size_t i = 0; i < edge_.size(); ++i) edge_[i] = Gap::kPoint + static_cast<std::uint32_t>(i);
    for (const Piece& p : divided.pieces) {
      for (const std::uint32_t end : p.ends) edge_[end] = p.edge, is_on_face_[end] |= p.is_face ? 1 : 0;
      around_[p.ends[0]].push_back(p.ends[1]);
      around_[p.ends[1]].push_back(p.ends[0]);
    }
  }

  NarrowPlaces run(Deadline& deadline) {
    for (const HalfedgeId h : mesh_.halfedges()) {
      if (deadline.asked_to_stop()) break;
      if (triangulated_.area[Mesh::triangle(h)] == kOutside) continue;
      if (triangulated_.piece[h] != kNoPiece) {
        across(h);
      } else if (mesh_.is_edge_representative(h)) {
        along(h);
      }
    }
    return std::move(result_);
  }

 private:
  /// Says whether v is a helper of the triangulation that surrounds a sphere, and no point of the outline.
  [[nodiscard]] bool helps(VertexId v) const { return v.index >= divided_.points.size(); }
  [[nodiscard]] Vec3 at(VertexId v) const { return divided_.points[v.index]; }
  [[nodiscard]] bool isolated(VertexId v) const { return around_[v.index].empty(); }
  [[nodiscard]] double size_in(double gap, VertexId one, VertexId other) const {
    if (isolated(one) || isolated(other)) return gap;
    return (is_on_face_[one.index] != 0 && is_on_face_[other.index] != 0 ? kOfGapOfFaces : kOfGap) * gap;
  }

  void add(Vec3 p, double size) {
    if (size < kLess * size_(p)) result_.sources.push_back({p, size});
  }
  void note(double width, Vec3 place, std::uint32_t one, std::uint32_t other) {
    if (!result_.narrowest || width < result_.narrowest->width) result_.narrowest = {width, place, {one, other}};
  }

  /// Both are ends of pieces at one point, and those do not make a sharp corner.
  [[nodiscard]] bool neighbors(VertexId a, VertexId b) const {
    for (const std::uint32_t c : around_[a.index]) {
      for (const std::uint32_t d : around_[b.index]) {
        if (c != d) continue;
        const Vec3 to_a = at(a) - divided_.points[c], to_b = at(b) - divided_.points[c];
        if (dot(to_a, to_b) <= kSharpCosine * length(to_a) * length(to_b)) return true;
      }
    }
    return false;
  }

  /// Visits an edge from vertex to vertex through the inside.
  void along(HalfedgeId h) {
    const VertexId a = mesh_.origin(h), b = mesh_.target(h);
    if (helps(a) || helps(b) || neighbors(a, b)) return;
    const double gap = length(at(b) - at(a));
    const double size = size_in(gap, a, b);
    note(gap, at(a), edge_[a.index], edge_[b.index]);
    add(at(a), size);
    add(at(b), size);
  }

  /// Visits a triangle on a piece: from the piece to the other side.
  void across(HalfedgeId h) {
    const VertexId a = mesh_.origin(h), b = mesh_.target(h), c = mesh_.opposite(h);
    if (helps(c) || triangulated_.piece[Mesh::next(h)] != kNoPiece || triangulated_.piece[Mesh::prev(h)] != kNoPiece ||
        neighbors(a, c) || neighbors(b, c))
      return;
    const Vec3 ab = at(b) - at(a);
    const double part = dot(at(c) - at(a), ab) / squared_length(ab);
    if (part <= 0 || part >= 1) return;  // the gap is that to a or b
    const Vec3 foot = at(a) + part * ab;
    const double gap = length(at(c) - foot);
    const double size = divided_.pieces[triangulated_.piece[h]].is_face ? size_in(gap, a, c)
                        : isolated(c)                                   ? gap
                                                                        : kOfGap * gap;
    note(gap, at(c), divided_.pieces[triangulated_.piece[h]].edge, edge_[c.index]);
    add(foot, size);
    add(at(c), size);
  }

  const DividedOutline& divided_;
  const Mesh& mesh_;
  const Triangulated& triangulated_;
  const GradedSize& size_;
  std::vector<std::vector<std::uint32_t>> around_;
  std::vector<std::uint32_t> edge_;       // of each point, as the sides of a gap
  std::vector<std::uint8_t> is_on_face_;  // of each point
  NarrowPlaces result_;
};

}  // namespace

NarrowPlaces narrow_places(const DividedOutline& divided, const Triangulated& triangulated, const GradedSize& size,
                           Deadline& deadline) {
  return Narrow(divided, triangulated, size).run(deadline);
}

namespace {

// A hashed grid of points with sizes, with one level for each power of two: is a point near a place?
//
// A point lies in the level of its size. A query looks at the levels whose points may be near enough. Sizes grow no
// faster than distances, so these are the levels around its radius.

class PointGrid {
 public:
  /// `flat`: all points have z = 0.
  explicit PointGrid(bool flat) : flat_(flat) {}

  void add(Vec3 p, double size) {
    if (2 * (points_.size() + 1) > slots_.size()) grow();
    const int level = std::ilogb(size);
    lowest_ = points_.empty() ? level : std::min(lowest_, level);
    highest_ = points_.empty() ? level : std::max(highest_, level);
    points_.push_back({p, scale_of(level), level, kNone});
    insert(static_cast<std::uint32_t>(points_.size() - 1));
  }

  /// Looks at all points whose size is between `least` and `most`, and at those in the same levels.
  [[nodiscard]] bool any_within(Vec3 p, double radius, double least, double most) const {
    const Vec3 reach = {radius, radius, flat_ ? 0 : radius};
    const int last = std::min(highest_, std::ilogb(most));
    for (int l = std::max(lowest_, std::ilogb(least)); l <= last; ++l) {
      const double scale = scale_of(l);
      const Cell low = cell(p - reach, l, scale), high = cell(p + reach, l, scale);
      for (std::int64_t x = low.x; x <= high.x; ++x) {
        for (std::int64_t y = low.y; y <= high.y; ++y) {
          for (std::int64_t z = low.z; z <= high.z; ++z) {
            for (std::uint32_t i = first({x, y, z, l}); i != kNone; i = points_[i].next) {
              if (squared_length(points_[i].at - p) < radius * radius) return true;
            }
          }
        }
      }
    }
    return false;
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  struct Entry {
    Vec3 at;
    double scale;
    int level;
    std::uint32_t next;
  };
  struct Cell {
    std::int64_t x, y, z;
    int level;
    friend bool operator==(const Cell&, const Cell&) = default;
  };

  /// One over the width of the cells of a level.
  [[nodiscard]] double scale_of(int level) const {
    // Narrow cells are many to look at: in space a query would see 729 of the least level, nearly all off the sphere.
    return std::ldexp(1.0, -(flat_ ? level + 1 : level + 2));
  }
  static Cell cell(Vec3 p, int level, double scale) {
    const auto along = [scale](double x) {
      const double scaled = scale * x;
      const auto towards_zero = static_cast<std::int64_t>(scaled);
      return towards_zero - (scaled < static_cast<double>(towards_zero) ? 1 : 0);
    };
    return {along(p.x), along(p.y), along(p.z), level};
  }
  static Cell cell_of(const Entry& entry) { return cell(entry.at, entry.level, entry.scale); }
  [[nodiscard]] std::size_t slot(const Cell& c) const {
    std::uint64_t hash = static_cast<std::uint64_t>(c.x) * 0x9e3779b97f4a7c15u;
    hash = (hash ^ (hash >> 29) ^ static_cast<std::uint64_t>(c.y)) * 0xbf58476d1ce4e5b9u;
    hash = (hash ^ (hash >> 31) ^ static_cast<std::uint64_t>(c.z)) * 0xd6e8feb86659fd93u;
    hash = (hash ^ (hash >> 32) ^ static_cast<std::uint64_t>(std::int64_t{c.level})) * 0x94d049bb133111ebu;
    return static_cast<std::size_t>(hash ^ (hash >> 31)) & (slots_.size() - 1);
  }
  /// The slot of the cell: it has its first point, or is the empty slot for it.
  [[nodiscard]] std::size_t find(const Cell& c) const {
    std::size_t s = slot(c);
    while (slots_[s] != kNone && !(cell_of(points_[slots_[s]]) == c)) {
      s = (s + 1) & (slots_.size() - 1);
    }
    return s;
  }
  [[nodiscard]] std::uint32_t first(const Cell& c) const { return slots_.empty() ? kNone : slots_[find(c)]; }
  void insert(std::uint32_t i) {
    const std::size_t s = find(cell_of(points_[i]));
    points_[i].next = slots_[s];
    slots_[s] = i;
  }
  void grow() {
    slots_.assign(std::max<std::size_t>(64, 4 * slots_.size()), kNone);
    for (std::uint32_t i = 0; i < points_.size(); ++i) insert(i);
  }

  std::vector<Entry> points_;
  std::vector<std::uint32_t> slots_;  // of open addressing, a power of two of them
  int lowest_ = 0, highest_ = 0;
  bool flat_;
};

// Parts of the local size. Neighbors in a perfect row are 1 apart, the first row is 0.87 from the outline. Points that
// are accepted much nearer make the short edges that a denser packing needs; points that are refused leave holes.
constexpr double kApart = 0.72;
constexpr double kClear = 0.5;
constexpr double kRounding = 1e-9;  // of sizes and distances, where sizes that were not computed must decide
constexpr std::array<double, 3> kHeights = {0.866, 0.7, 0.55};

/// A point of the front: it proposes its six neighbors.
struct Front {
  Vec3 at;
  Vec3 direction;  // of the first proposal, of length 1
  std::int32_t area;
  double size;
};

class Placement {
 public:
  Placement(const DividedOutline& divided, const Areas& areas, const GradedSize& size, Deadline& deadline)
      : surface_(size.surface()),
        divided_(divided),
        areas_(areas),
        size_(size),
        deadline_(deadline),
        is_even_(is_even(areas, size)),
        grid_(surface_.space().dimension() == 2) {
    std::vector<BoundingBox> boxes;
    boxes.reserve(divided.pieces.size());
    for (const Piece& p : divided.pieces)
      boxes.push_back(box_around(surface_, divided.points[p.ends[0]], divided.points[p.ends[1]]));
    tree_ = BoundingBoxTree(boxes);
    boxes.clear();
    for (const Circle& c : divided.corridors.circles) boxes.push_back(BoundingBox{c.center, c.center}.grown(c.radius));
    circles_ = BoundingBoxTree(boxes);
    for (const Vec3 p : divided.points) grid_.add(p, size(p));
    for (const Vec3 p : divided.corridors.points) grid_.add(p, size(p));
  }

  std::vector<Vec3> run(std::size_t most) {
    for (std::size_t i = 0; i < divided_.pieces.size() && !deadline_.asked_to_stop(); ++i) start_from(i);
    const std::size_t given = divided_.pieces.empty() ? start_without_pieces() : 0;
    std::array<std::array<double, 2>, 6> turns;
    for (std::size_t k = 0; k < turns.size(); ++k) {
      const double angle = static_cast<double>(k) * std::numbers::pi / 3;
      turns[k] = {std::cos(angle), std::sin(angle)};
    }
    for (std::size_t i = 0; i < front_.size() && front_.size() < most && !deadline_.asked_to_stop(); ++i) {
      const Front from = front_[i];  // a copy: front_ grows
      const double here = from.size, grade = size_.grade();
      for (const auto& [c, s] : turns) {
        const Vec3 d = c * from.direction + s * surface_.to_the_left(from.direction, from.at);
        const Vec3 ahead = surface_.below(from.at + here * d);
        if (is_surely_near(ahead, here, (1 + 0.5 * grade) * here, 0.5 * grade * here)) continue;
        const double there = size_at(ahead, from.area);
        const Vec3 p = surface_.below(from.at + 0.5 * (here + there) * d);
        if (is_surely_near(p, there, length(p - ahead), 0)) continue;
        take(p, from.at, from.area, kNoPiece);
      }
    }
    std::vector<Vec3> points;
    points.reserve(front_.size() - given);
    for (std::size_t i = given; i < front_.size(); ++i) points.push_back(front_[i].at);
    return points;
  }

 private:
  [[nodiscard]] double size_at(Vec3 p, std::int32_t area) const {
    return std::min(size_(p), areas_.areas[static_cast<std::size_t>(area)].size);
  }

  /// Says whether sizes differ by at most the grade times the distance. The grid has such sizes, too.
  static bool is_even(const Areas& areas, const GradedSize& size) {
    constexpr double kMostGrade = 0.8;  // up to it is_near() finds all points within its radius
    return size.grade() <= kMostGrade && !size.has_field() &&
           std::all_of(areas.areas.begin(), areas.areas.end(), [&](const Area& a) { return a.size >= size.most(); });
  }

  [[nodiscard]] bool is_near(Vec3 p, double size) const {
    const double radius = kApart * size;
    if (!is_even_) return grid_.any_within(p, radius, 0.5 * radius, 4 * radius);
    const double differs = (1 + kRounding) * size_.grade() * radius;
    return grid_.any_within(p, radius, size - differs, size + differs);
  }
  /// Says that the place within `moved` of p is near a point, without its size: within `distance` of it the size is
  /// `size`. If it returns false, nothing is known.
  [[nodiscard]] bool is_surely_near(Vec3 p, double size, double distance, double moved) const {
    const double radius = (1 - kRounding) * kApart * (size - size_.grade() * distance) - moved;
    return is_even_ && radius > 0 && grid_.any_within(p, radius, size, size);
  }

  /// The apex of the triangle on a piece, on each side that is inside.
  void start_from(std::size_t i) {
    const Piece& piece = divided_.pieces[i];
    const Vec3 a = divided_.points[piece.ends[0]], b = divided_.points[piece.ends[1]];
    const Vec3 middle = surface_.below(0.5 * (a + b)),
               normal = surface_.to_the_left((1 / length(b - a)) * (b - a), middle);
    for (const int side : {0, 1}) {
      const std::int32_t area = areas_.sides[piece.edge][static_cast<std::size_t>(side)];
      if (area == kOutside) continue;
      const Vec3 inwards = side == 0 ? normal : -1.0 * normal;
      const double size = size_at(middle, area);
      for (const double height : kHeights) {
        const Vec3 apex = surface_.below(middle + (height * size) * inwards);
        if (is_surely_near(apex, size, height * size, 0) || !take(apex, middle, area, i)) continue;
        // The first proposal lies towards an end of the piece, so the next row makes equilateral triangles.
        front_.back().direction = -1.0 * surface_.direction(front_.back().at, a);
        break;
      }
    }
  }

  /// Returns the number of points of the front that exist already.
  std::size_t start_without_pieces() {
    for (const Vec3 p : divided_.points) front_.push_back({p, surface_.some_direction(p), 0, size_at(p, 0)});
    if (front_.empty()) {
      const Vec3 start = size_.start();
      const double size = size_at(start, 0);
      grid_.add(start, size);
      front_.push_back({start, surface_.some_direction(start), 0, size});
    }
    return divided_.points.size();
  }

  bool take(Vec3 p, Vec3 from, std::int32_t area, std::size_t own_piece) {
    const double size = size_at(p, area);
    if (is_near(p, size) || is_in_circle(p) || !is_clear(p, from, kClear * size, own_piece)) return false;
    grid_.add(p, size);
    front_.push_back({p, -1.0 * surface_.direction(p, from), area, size});
    return true;
  }

  [[nodiscard]] bool is_in_circle(Vec3 p) const {
    return !circles_.visit(BoundingBox{p, p}, [&](std::size_t i) {
      const Circle& c = divided_.corridors.circles[i];
      return squared_length(p - c.center) >= c.radius * c.radius;
    });
  }

  /// Says whether no piece is within the distance of p, or between p and its origin.
  [[nodiscard]] bool is_clear(Vec3 p, Vec3 from, double distance, std::size_t own_piece) const {
    const BoundingBox box = united(BoundingBox{p, p}.grown(distance), box_around(surface_, p, from));
    return tree_.visit(box, [&](std::size_t i) {
      const Vec3 a = divided_.points[divided_.pieces[i].ends[0]], b = divided_.points[divided_.pieces[i].ends[1]];
      if (surface_.squared_distance(p, a, b) < distance * distance) return false;
      return i == own_piece || !(surface_.orientation(a, b, p) != surface_.orientation(a, b, from) &&
                                 surface_.orientation(p, from, a) != surface_.orientation(p, from, b));
    });
  }

  const Surface& surface_;
  const DividedOutline& divided_;
  const Areas& areas_;
  const GradedSize& size_;
  Deadline& deadline_;
  bool is_even_;
  BoundingBoxTree tree_, circles_;
  PointGrid grid_;
  std::vector<Front> front_;
};

}  // namespace

std::vector<Vec3> place_points(const DividedOutline& divided, const Areas& areas, const GradedSize& size,
                               std::size_t most, Deadline& deadline) {
  return Placement(divided, areas, size, deadline).run(most);
}

}  // namespace temper::mesher
