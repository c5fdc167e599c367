// See flat_triangles.hpp.
//
//        d                 d
//      /   \             / | \        b is on ac, so abc has no area. The flip of ac gives both new triangles a part of
//     a-----c    --->   a--b--c       acd. If d is on this line, too, the new triangles are shorter, and the next flips
//      \ b /                          find a triangle above the line. If b has come to lie in acd, abc is turned over,
//                                     and the same flip cures it.
#include "files/flat_triangles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <queue>
#include <utility>
#include <variant>

#include "exit.hpp"
#include "temper/detail/geometry.hpp"

namespace temper::app {
namespace {

// Per bad triangle, far more than flips need if triangles have no area: then lengths fall. Others may go in a circle.
constexpr std::size_t kTries = 64;

using Corners = std::array<std::int32_t, 3>;
using Ends = std::pair<std::int32_t, std::int32_t>;

Ends ends_of(std::int32_t a, std::int32_t b) { return std::minmax({a, b}); }

/// The values of the elements that are listed.
template <class T>
std::vector<T> listed_values(const std::vector<T>& values, const std::vector<std::size_t>& from,
                             std::size_t components) {
  std::vector<T> result;
  result.reserve(from.size() * components);
  for (const std::size_t i : from) {
    for (std::size_t k = 0; k < components; ++k) result.push_back(values[i * components + k]);
  }
  return result;
}

/// Gives elements the data of those that they come from.
void take_data(std::vector<io::DataArray>& arrays, const std::vector<std::size_t>& from) {
  for (io::DataArray& array : arrays) {
    const auto components = static_cast<std::size_t>(array.components);
    std::visit([&](auto& values) { values = listed_values(values, from, components); }, array.values);
  }
}

class Flips {
 public:
  explicit Flips(io::MeshFile& file) : file_(file), from_(file.triangles.size()), stays_(file.triangles.size(), true) {
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
    std::size_t left = 0, tries = kTries * (n_flat + 1);
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
    if (!file_.triangles.tags.empty()) file_.triangles.tags = listed_values(file_.triangles.tags, from_, 1);
    take_data(file_.triangles.data, from_);
    keep_triangles(file_, stays_);
    return n_flat - std::min(left + flat_.size(), n_flat);
  }

 private:
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
      throw Failure(Exit::bad_input, fmt::format("{}: {} has two corners at x = {}, y = {}. Next: add --merge 0",
                                                 file_.path, name(t), at(b).x, at(b).y));
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
      std::ranges::rotate(corners, corners.begin() + 1);
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

  /// Flips the longest edge of a flat triangle t, which `other` is beyond.
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
    file_.lines.tags = listed_values(file_.lines.tags, from, 1);
    take_data(file_.lines.data, from);
    file_.lines.corners = std::move(lines);
  }

  io::MeshFile& file_;
  std::vector<std::size_t> from_;  // whose region and data a triangle has
  std::vector<bool> stays_;
  std::size_t n_dropped_ = 0;
  std::map<Ends, std::vector<std::size_t>> of_edge_;
  std::priority_queue<std::pair<double, std::size_t>> flat_;
  std::map<Ends, std::int32_t> middle_;  // of edges that are gone: the point on them
};

}  // namespace

void keep_triangles(io::MeshFile& file, const std::vector<bool>& stays) {
  std::vector<std::size_t> from;
  for (std::size_t t = 0; t < stays.size(); ++t) {
    if (stays[t]) from.push_back(t);
  }
  if (from.size() == stays.size()) return;
  file.triangles.corners = listed_values(file.triangles.corners, from, 1);
  if (!file.triangles.tags.empty()) file.triangles.tags = listed_values(file.triangles.tags, from, 1);
  take_data(file.triangles.data, from);
  file.numbering = nullptr;  // triangles have other numbers now
}

std::size_t flip_flat_triangles(io::MeshFile& file) { return Flips(file).run(); }

}  // namespace temper::app
