// See flip_flat_triangles() in temper/detail/file_cures.hpp.
//
//        d                 d
//      /   \             / | \        b is on ac, so abc has no area. The flip of ac gives both new triangles a part of
//     a-----c    --->   a--b--c       acd. If d is on this line, too, the new triangles are shorter, and the next flips
//      \ b /                          find a triangle above the line. If b has come to lie in acd, abc is turned over,
//                                     and the same flip cures it.
#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <queue>
#include <utility>

#include "io/conversion/follow.hpp"
#include "io/text/failure.hpp"
#include "temper/detail/file_cures.hpp"
#include "temper/detail/geometry.hpp"

namespace temper::io {
namespace {

// Per bad triangle, far more than flips need if triangles have no area: then lengths fall. Others may go in a circle.
constexpr std::size_t kTriesOfFlips = 64;

class FlatFlips {
  using Corners = std::array<std::int32_t, 3>;
  using Ends = std::pair<std::int32_t, std::int32_t>;

 public:
  explicit FlatFlips(MeshFile& file) : file_(file), from_(file.triangles.size()), stays_(file.triangles.size(), true) {
    std::iota(from_.begin(), from_.end(), std::size_t{0});
  }

  std::size_t run() {
    for (std::size_t t = 0; t < triangles().size(); ++t) start(t);
    const std::vector<Corners> as_they_came = triangles();
    orient_all();
    for (std::size_t t = 0; t < triangles().size(); ++t) {
      if (stays_[t] && is_bad(t)) push(t);
    }
    const std::size_t n_flat = flat_.size() + n_dropped_;
    std::size_t left = 0, tries = kTriesOfFlips * (n_flat + 1);
    for (; !flat_.empty() && tries > 0; --tries) {
      const std::size_t t = flat_.top().second;
      flat_.pop();
      if (stays_[t] && is_bad(t) && !cure(t)) ++left;
    }
    if (n_flat == 0) {
      triangles() = as_they_came;
      return 0;
    }
    divide_lines();
    take_contents(file_.triangles, from_);
    keep_triangles(file_, stays_);
    return n_flat - std::min(left + flat_.size(), n_flat);
  }

 private:
  static Ends ends_of(std::int32_t a, std::int32_t b) { return std::minmax({a, b}); }
  std::vector<Corners>& triangles() { return file_.triangles.corners; }
  [[nodiscard]] Vec2 at(std::int32_t p) const { return file_.points[static_cast<std::size_t>(p)]; }
  /// Without area, or turned over. Precondition: all are oriented.
  [[nodiscard]] bool is_bad(std::size_t t) const {
    const auto [a, b, c] = file_.triangles[t];
    return orient2d(at(a), at(b), at(c)) != Sign::positive;
  }

  /// Orients each part of the mesh along its edges, so that most of its area is counter-clockwise.
  void orient_all() {
    std::vector<bool> seen(triangles().size());
    for (std::size_t first = 0; first < seen.size(); ++first) {
      if (seen[first] || !stays_[first]) continue;
      std::vector<std::size_t> part = {first};
      seen[first] = true;
      double area = 0;
      for (std::size_t i = 0; i < part.size(); ++i) {
        const auto [a, b, c] = triangles()[part[i]];
        area += cross(at(b) - at(a), at(c) - at(a));
        for (const Ends& edge : {Ends(a, b), Ends(b, c), Ends(c, a)}) {
          for (const std::size_t next : of_edge_[ends_of(edge.first, edge.second)]) {
            if (seen[next]) continue;
            seen[next] = true;
            if (has_directed(next, edge)) turn(next);
            part.push_back(next);
          }
        }
      }
      if (area < 0) std::ranges::for_each(part, [this](std::size_t t) { turn(t); });
    }
  }
  [[nodiscard]] bool has_directed(std::size_t t, const Ends& edge) const {
    const auto [a, b, c] = file_.triangles[t];
    return edge == Ends(a, b) || edge == Ends(b, c) || edge == Ends(c, a);
  }
  void turn(std::size_t t) { std::swap(triangles()[t][1], triangles()[t][2]); }

  void start(std::size_t t) {
    const auto [a, b, c] = triangles()[t];
    if (a == b || b == c || c == a) {
      stays_[t] = false;  // its neighbors share the edge that is left
      ++n_dropped_;
      return;
    }
    for (const Ends& edge : {ends_of(a, b), ends_of(b, c), ends_of(c, a)}) of_edge_[edge].push_back(t);
  }

  /// The longest first: a neighbor across the longest edge is then no longer, and flips end.
  void push(std::size_t t) {
    const auto [a, b, c] = turned_to_middle(t);
    if (at(a) == at(b) || at(b) == at(c)) {
      fail(ErrorCode::zero_area, file_.path, name(t), " has two corners at x = ", at(b).x, ", y = ", at(b).y,
           ". Next: add --merge 0");
    }
    flat_.emplace(length(at(c) - at(a)), t);
  }
  [[nodiscard]] std::string name(std::size_t t) const {
    return file_.numbering ? file_.numbering->triangle(from_[t]) : InputNames().triangle(from_[t]);
  }

  /// The corners in their cycle, with the one across the longest edge in the middle.
  [[nodiscard]] Corners turned_to_middle(std::size_t t) const {
    Corners corners = file_.triangles[t], best = corners;
    for (int i = 0; i < 2; ++i) {
      std::rotate(corners.begin(), corners.begin() + 1, corners.end());
      if (length(at(corners[2]) - at(corners[0])) > length(at(best[2]) - at(best[0]))) best = corners;
    }
    return best;
  }

  bool cure(std::size_t t) {
    const auto [a, b, c] = turned_to_middle(t);
    const std::vector<std::size_t>& sides = of_edge_[ends_of(a, c)];
    if (sides.size() == 1) {
      for (const Ends& edge : {ends_of(a, b), ends_of(b, c), ends_of(c, a)}) std::erase(of_edge_[edge], t);
      stays_[t] = false;
    } else if (sides.size() != 2 || !flip(t, sides[0] == t ? sides[1] : sides[0], {a, b, c})) {
      return false;
    }
    middle_.emplace(ends_of(a, c), b);
    return true;
  }

  /// FlatFlips the longest edge of a flat triangle t, which `other` is beyond.
  bool flip(std::size_t t, std::size_t other, const Corners& corners) {
    const auto [a, b, c] = corners;
    Corners with_c = triangles()[other];
    const auto apex = std::ranges::find_if(with_c, [a = a, c = c](std::int32_t p) { return p != a && p != c; });
    const std::int32_t d = *apex;
    if (d == b || !of_edge_[ends_of(b, d)].empty()) return false;
    Corners with_a = with_c;
    std::ranges::replace(with_c, a, b);
    std::ranges::replace(with_a, c, b);
    triangles()[t] = with_a;
    triangles()[other] = with_c;
    from_[t] = from_[other];
    of_edge_.erase(ends_of(a, c));
    of_edge_[ends_of(b, d)] = {t, other};
    std::ranges::replace(of_edge_[ends_of(b, c)], t, other);
    std::ranges::replace(of_edge_[ends_of(d, a)], other, t);
    for (const std::size_t half : {t, other}) {
      if (is_bad(half)) push(half);
    }
    return true;
  }

  /// Lines along edges that are gone follow the points on them.
  void divide_lines() {
    std::vector<std::size_t> from;
    std::vector<std::array<std::int32_t, 2>> lines;
    for (std::size_t i = 0; i < file_.lines.size(); ++i) {
      std::vector<std::array<std::int32_t, 2>> open = {file_.lines[i]};
      while (!open.empty()) {
        const auto [a, b] = open.back();
        open.pop_back();
        const auto found = middle_.find(ends_of(a, b));
        if (found == middle_.end()) {
          lines.push_back({a, b});
          from.push_back(i);
        } else {
          open.push_back({found->second, b});
          open.push_back({a, found->second});
        }
      }
    }
    take_contents(file_.lines, from);
    file_.lines.corners = std::move(lines);
  }

  MeshFile& file_;
  std::vector<std::size_t> from_;  // whose region and data a triangle has
  std::vector<bool> stays_;
  std::size_t n_dropped_ = 0;
  std::map<Ends, std::vector<std::size_t>> of_edge_;
  std::priority_queue<std::pair<double, std::size_t>> flat_;
  std::map<Ends, std::int32_t> middle_;  // of edges that are gone: the point on them
};

}  // namespace

void keep_triangles(MeshFile& file, const std::vector<bool>& stays) {
  std::vector<std::size_t> from;
  for (std::size_t t = 0; t < stays.size(); ++t) {
    if (stays[t]) from.push_back(t);
  }
  if (from.size() == stays.size()) return;
  file.triangles.corners = at(file.triangles.corners, from);
  take_contents(file.triangles, from);
  file.numbering = nullptr;  // triangles have other numbers now
}

Expected<std::size_t> flip_flat_triangles(MeshFile& file) {
  return guarded<std::size_t>(file.path, [&] {
    if (file.sphere() != nullptr || file.periodic() != nullptr) {
      fail(
          ErrorCode::unsupported, file.path,
          "is a mesh of the sphere or of a periodic plane, and --flip-flat is for a plane without periods. Next: leave "
          "it out");
    }
    return FlatFlips(file).run();
  });
}

}  // namespace temper::io
