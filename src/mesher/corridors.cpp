#include "mesher/corridors.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "mesher/face_sites.hpp"

namespace temper::mesher {
namespace {

/// A corner of a polygon, and its side to the next corner.
struct Corner {
  std::uint32_t site = 0;
  std::int32_t area = kOutside;  ///< beyond the side
  bool is_pair = false;          ///< the side has a face as its dual, and there is another polygon beyond
};

class CorridorMaker {
 public:
  CorridorMaker(const Problem& problem, const Domain& domain, const DividedOutline& divided)
      : domain_(domain),
        divided_(divided),
        distances_(problem.surface, divided),
        nodes_(face_nodes(divided)),
        sites_(face_sites(domain, divided, nodes_, distances_)) {}

  Laid run() {
    laid_.domain = domain_;
    leave_out_nodes();
    first_site_ = static_cast<std::uint32_t>(out().points.size());
    for (const FaceSite& site : sites_.sites) add(site);
    sites_of_lines_.assign(divided_.pieces.size(), {-1, -1});
    for (const FaceNode& node : nodes_.nodes) add_node(node);
    add_pieces();
    add_circles();
    for (const std::uint32_t point : sites_.crowded) add_too_long(*nodes_.at(point));
    find_disturbed();
    find_outside_cells();
    return std::move(laid_);
  }

 private:
  DividedOutline& out() { return laid_.divided; }
  [[nodiscard]] Vec2 at(std::uint32_t point) const {
    const Vec3 p = laid_.divided.points[point];
    return {p.x, p.y};
  }
  static LongPieces pieces_at(const FaceNode& node) { return {node.point, {node.at.x, node.at.y, 0}, node.size}; }
  void add_too_long(const FaceNode& node) { laid_.too_long.push_back(pieces_at(node)); }

  /// Numbers points without the nodes, in their order.
  void leave_out_nodes() {
    Arrangement& arrangement = laid_.domain.arrangement;
    const std::size_t n_places = arrangement.places.size();
    arrangement.places.clear(), arrangement.point.clear(), arrangement.origin.clear();
    for (std::size_t i = 0; i < divided_.points.size(); ++i) {
      const bool is_node = nodes_.of_point[i] >= 0;
      number_.push_back(is_node ? -1 : static_cast<std::int32_t>(out().points.size()));
      if (is_node) {
        out().corridors.points.push_back(divided_.points[i]);
        continue;
      }
      out().points.push_back(divided_.points[i]);
      if (i >= n_places) continue;
      arrangement.origin.push_back(static_cast<std::int32_t>(arrangement.places.size()));
      arrangement.places.push_back(divided_.points[i]);
      arrangement.point.push_back(domain_.arrangement.point[i]);
    }
    for (std::int32_t& place : arrangement.place_of_point) {
      if (place < 0) continue;
      const std::int32_t now = number_[static_cast<std::size_t>(place)];
      place = now < 0 ? Arrangement::kOnFace : now;
    }
    for (OutlineEdge& e : arrangement.edges) {
      for (std::int32_t& end : e.ends) end = number_[static_cast<std::size_t>(end)];
    }
    out().corridors.weights.assign(out().points.size(), 0);
    out().corridors.areas.assign(out().points.size(), kOutside);
  }

  std::uint32_t add(const FaceSite& site) {
    const auto point = static_cast<std::uint32_t>(out().points.size());
    out().points.push_back({site.at.x, site.at.y, 0});
    out().corridors.weights.push_back(site.weight);
    out().corridors.areas.push_back(site.area);
    node_of_site_.resize(out().points.size(), nullptr);
    return point;
  }

  void add_node(const FaceNode& node) {
    for (const Branch& b : node.branches) {
      if (b.is_face) continue;
      const Vec2 p = node.at + b.reach * b.direction;
      sites_of_lines_[b.piece].at(b.is_outwards ? 0 : 1) =
          static_cast<std::int32_t>(add({p, weight_at(node, p), kOutside}));
    }
    std::size_t first = 0, n = node.branches.size();
    while (first < n && node.branches[first].is_face) ++first;
    if (node.count_lines() < 2) return add_polygon(node, corners(node, first % n, n), nullptr);
    std::size_t second = first + 1;
    while (node.branches[second].is_face) ++second;
    // On each side of the line a polygon, if there are faces.
    const std::size_t between = second - first, beyond = n - between;
    add_side(node, first, between, beyond > 1);
    add_side(node, second, beyond, between > 1);
  }

  /// The side of a line on the left of its branch `begin`, up to its other branch, which is `count` further.
  void add_side(const FaceNode& node, std::size_t begin, std::size_t count, bool has_polygon_beyond) {
    const std::size_t n = node.branches.size();
    const Branch &one = node.branches[begin], &other = node.branches[(begin + count) % n];
    if (count > 1) {
      const Branch* const chord = has_polygon_beyond ? nullptr : &other;
      add_polygon(node, corners(node, begin, count + 1), chord);
    }
    if (count == 1 || !has_polygon_beyond || begin > (begin + count) % n) return;
    out().corridors.chords.push_back({{site_of_line(one), site_of_line(other)}, divided_.pieces[one.piece].edge});
  }

  [[nodiscard]] std::uint32_t site_of_line(const Branch& b) const {
    return static_cast<std::uint32_t>(sites_of_lines_[b.piece].at(b.is_outwards ? 0 : 1));
  }
  [[nodiscard]] std::int32_t area_after(const Branch& b) const { return area_beside(domain_, divided_, b, true); }
  [[nodiscard]] std::uint32_t site_beside(const Branch& b, bool left) const {
    return first_site_ + sites_.beside(b, left);
  }

  /// The sites of these branches, counter-clockwise.
  [[nodiscard]] std::vector<Corner> corners(const FaceNode& node, std::size_t begin, std::size_t count) const {
    std::vector<Corner> all;
    for (std::size_t k = begin; k < begin + count; ++k) {
      const Branch& b = node.branches[k % node.branches.size()];
      if (!b.is_face) {
        all.push_back({site_of_line(b), area_after(b), false});
        continue;
      }
      const std::uint32_t right = site_beside(b, false);
      if (all.empty() || all.back().site != right) all.push_back({right, kOutside, false});
      all.back().is_pair = true;
      all.push_back({site_beside(b, true), area_after(b), false});
    }
    if (all.front().site == all.back().site) all.pop_back();
    return all;
  }

  /// `chord`: the last branch of a side of a line that has no polygon beyond; its last side is on that line. Null:
  /// none.
  void add_polygon(const FaceNode& node, const std::vector<Corner>& corners, const Branch* chord) {
    const bool is_open = node.count_lines() > 1;
    std::vector<std::uint32_t> polygon;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      polygon.push_back(corners[i].site);
      const bool is_last = i + 1 == corners.size();
      if (corners[i].is_pair || (is_last && is_open)) continue;
      const std::uint32_t next = corners[is_last ? 0 : i + 1].site;
      std::uint32_t from = corners[i].site;
      for (const Vec2 p : closing_places(node, from, next)) {
        const std::uint32_t to = add({p, weight_at(node, p), corners[i].area});
        add_side_piece(from, to, corners[i].area);
        polygon.push_back(to);
        from = to;
      }
      add_side_piece(from, next, corners[i].area);
    }
    if (chord != nullptr) add_chord(polygon.back(), polygon.front(), *chord);
    check_convex(node, polygon);
    for (const std::uint32_t site : polygon) {
      const FaceNode*& of_site = node_of_site_[site];
      if (of_site == nullptr || of_site->size < node.size) of_site = &node;
    }
    out().corridors.polygons.push_back(std::move(polygon));
  }

  /// Places of closing sites if two neighbors are too far around the node.
  [[nodiscard]] std::vector<Vec2> closing_places(const FaceNode& node, std::uint32_t from, std::uint32_t to) const {
    constexpr double kWidest = 150 * std::numbers::pi / 180, kStep = 110 * std::numbers::pi / 180;
    constexpr double kFar = 0.7;  // of the shortest piece: about as the sites at its other sides
    const Vec2 first = at(from) - node.at;
    const double gap = angle_between(first, at(to) - node.at);
    if (gap <= kWidest) return {};
    const double n = std::ceil(gap / kStep), begin = std::atan2(first.y, first.x);
    std::vector<Vec2> places;
    for (double k = 1; k < n; ++k) {
      const Vec2 direction = {std::cos(begin + gap * k / n), std::sin(begin + gap * k / n)};
      const double t = distances_.free_way(node.at, direction, kFar * node.size, node.point, node.point);
      places.push_back(node.at + t * direction);
    }
    const bool is_beyond = places.empty() || cross(at(to) - at(from), places.front() - at(from)) < 0;
    if (gap < std::numbers::pi && !is_beyond) return {};  // another line is near, and the polygon needs no site there
    return places;
  }

  /// The polygon is on the left.
  void add_side_piece(std::uint32_t from, std::uint32_t to, std::int32_t area) {
    const auto [known, is_new] = side_of_area_.try_emplace(area, laid_.domain.arrangement.edges.size());
    if (is_new) {
      laid_.domain.arrangement.edges.push_back({{-1, -1}, {}, {}, 0, LineKind::faces});
      laid_.domain.areas.sides.push_back({kOutside, area});
    }
    out().pieces.push_back({{from, to}, static_cast<std::uint32_t>(known->second), false});
  }

  /// The side of a polygon on the line of a branch.
  void add_chord(std::uint32_t from, std::uint32_t to, const Branch& last) {
    const std::uint32_t edge = divided_.pieces[last.piece].edge;
    if (area_after(last) == kOutside) {
      out().corridors.chords.push_back({{from, to}, edge});
      return;
    }
    OutlineEdge of_line = domain_.arrangement.edges[edge];
    of_line.ends = {-1, -1};
    out().pieces.push_back({{from, to}, static_cast<std::uint32_t>(laid_.domain.arrangement.edges.size()), false});
    laid_.domain.arrangement.edges.push_back(std::move(of_line));
    laid_.domain.areas.sides.push_back({kOutside, area_after(last)});
  }

  /// The pieces that are no faces, from and to sites instead of nodes; and the pairs of the others.
  void add_pieces() {
    for (std::size_t i = 0; i < divided_.pieces.size(); ++i) {
      const Piece& piece = divided_.pieces[i];
      if (piece.is_face) {
        const auto [left, right] = sites_.of_piece[i];
        out().corridors.faces.push_back(
            {{first_site_ + static_cast<std::uint32_t>(left), first_site_ + static_cast<std::uint32_t>(right)},
             piece.edge});
        continue;
      }
      Piece now = piece;
      for (const std::size_t end : {0, 1}) {
        const std::int32_t site = sites_of_lines_[i].at(end), number = number_[piece.ends.at(end)];
        now.ends.at(end) = static_cast<std::uint32_t>(site >= 0 ? site : number);
      }
      out().pieces.push_back(now);
    }
  }

  void add_circles() {
    constexpr double kWider = 1.25;  // the dual crosses an edge to a site between 1/2 and 0.82 of its length
    std::vector<Circle>& circles = out().corridors.circles;
    for (const FaceNode& node : nodes_.nodes) circles.push_back({{node.at.x, node.at.y, 0}, node.radius});
    for (std::size_t i = 0; i < out().points.size(); ++i) {
      const double weight = out().corridors.weights[i];
      if (weight != 0) circles.push_back({out().points[i], kWider * std::sqrt(std::abs(weight))});
    }
  }

  /// A site at a corner that is not convex would have no cell. Only the two sites of a branch may reach as far along it
  /// as they do: the polygon has a side across the branch.
  void check_convex(const FaceNode& node, const std::vector<std::uint32_t>& polygon) {
    constexpr double kShort = 1e-3;  // of the reach
    constexpr double kFlat = 1e-6;   // sine of the turn at a corner
    for (std::size_t i = 0, n = polygon.size(); i < n; ++i) {
      const Vec2 b = at(polygon[(i + 1) % n]), to = b - at(polygon[i]), on = at(polygon[(i + 2) % n]) - b;
      if (cross(to, on) < kFlat * length(to) * length(on)) return add_too_long(node);
    }
    for (const Branch& b : node.branches) {
      std::size_t n_far = 0;
      for (const std::uint32_t site : polygon)
        n_far += dot(at(site) - node.at, b.direction) > (1 - kShort) * b.reach ? 1 : 0;
      if (n_far > (b.is_face ? 2u : 1u)) return add_too_long(node);
    }
  }

  /// No other point may be within the circle of a node, with its weight. If two nodes disturb each other, the one with
  /// longer pieces has to give way.
  void find_disturbed() {
    constexpr double kMargin = 1e-2, kEqual = 1e-6;  // of R²; sites of the node itself are equal up to rounding
    const std::vector<double>& weights = out().corridors.weights;
    std::vector<BoundingBox> boxes;
    for (std::size_t i = 0; i < out().points.size(); ++i)
      boxes.push_back(BoundingBox{out().points[i], out().points[i]}.grown(std::sqrt(std::max(0.0, weights[i]))));
    const BoundingBoxTree tree(boxes);
    for (const FaceNode& node : nodes_.nodes) {
      const Vec3 q = {node.at.x, node.at.y, 0};
      tree.visit(BoundingBox{q, q}.grown(node.radius), [&](std::size_t i) {
        const double r2 = node.radius * node.radius;
        const double power = weight_at(node, at(static_cast<std::uint32_t>(i))) - weights[i];  // less R²
        if (power >= kMargin * r2 || std::abs(power) < kEqual * r2) return true;
        const FaceNode* const other = node_of_site_[i];
        add_too_long(other != nullptr && other->size > node.size ? *other : node);
        return true;
      });
    }
  }

  /// A site a is in its own cell if |ab|² > w(b) − w(a) for all other sites b. The one with the larger weight gives
  /// way: weights fall with the square of the pieces' length.
  void find_outside_cells() {
    constexpr double kMost = 0.9;  // of |ab|²: then the face is 0.05 |ab| or more before a
    const std::vector<double>& weights = out().corridors.weights;
    if (weights.empty()) return;
    std::vector<BoundingBox> boxes;
    for (const Vec3 p : out().points) boxes.push_back({p, p});
    const BoundingBoxTree tree(boxes);
    const double least = *std::ranges::min_element(weights);
    for (std::uint32_t b = 0; b < weights.size(); ++b) {
      const Vec3 from = out().points[b];
      tree.visit(BoundingBox{from, from}.grown(std::sqrt((weights[b] - least) / kMost)), [&](std::size_t i) {
        const auto a = static_cast<std::uint32_t>(i);
        if (weights[b] - weights[a] <= kMost * squared_length(at(a) - at(b))) return true;
        const FaceNode* const node = node_of_site_[std::abs(weights[a]) > std::abs(weights[b]) ? a : b];
        if (node != nullptr) laid_.outside_cells.push_back(pieces_at(*node));
        return true;
      });
    }
  }

  const Domain& domain_;
  const DividedOutline& divided_;
  PieceDistances distances_;
  FaceNodes nodes_;
  FaceSites sites_;
  std::uint32_t first_site_ = 0;                             // its point
  std::vector<const FaceNode*> node_of_site_;                // the one of longest pieces; of other points null
  std::vector<std::int32_t> number_;                         // of each point of divided_, or -1
  std::vector<std::array<std::int32_t, 2>> sites_of_lines_;  // at the ends of each piece that are nodes, or -1
  std::map<std::int32_t, std::size_t> side_of_area_;         // edges of sides of polygons
  Laid laid_;
};

}  // namespace

bool has_faces(const Domain& domain) {
  return std::ranges::any_of(domain.arrangement.edges, [](const OutlineEdge& e) { return e.as == LineKind::faces; });
}

Laid lay_corridors(const Problem& problem, const Domain& domain, const DividedOutline& divided) {
  return CorridorMaker(problem, domain, divided).run();
}

}  // namespace temper::mesher
