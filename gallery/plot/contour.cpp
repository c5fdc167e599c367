#include "plot/contour.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace temper {
namespace {

// A point of a contour or of the boundary of the domain, named by what it lies on.
struct Node {
  std::uint64_t name = 0;
  Vec2 at;
};

struct Link {
  Node from, to;
};

struct Links {
  std::vector<Link> level;     // along f = level
  std::vector<Link> boundary;  // along the boundary of the domain, where f ≥ level
};

struct Corner {
  std::size_t i = 0, j = 0;
  double f = 0;
};

// The corners of one cell that are in the domain, counter-clockwise; fewer than three: no cell.
struct Cell {
  std::array<Corner, 4> corners;
  std::size_t n = 0;
};

class Marcher {
 public:
  Marcher(const SampleGrid& grid, double level) : grid_(grid), level_(level) {}

  Links march() {
    for (std::size_t j = 0; j + 1 < grid_.ny; ++j) {
      for (std::size_t i = 0; i + 1 < grid_.nx; ++i) visit(cell(i, j));
    }
    return std::move(links_);
  }

 private:
  [[nodiscard]] bool inside(double f) const { return f >= level_; }

  [[nodiscard]] Cell cell(std::size_t i, std::size_t j) const {
    Cell cell;
    for (const auto& [di, dj] : {std::array<std::size_t, 2>{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
      const double f = grid_.at(i + di, j + dj);
      if (std::isfinite(f)) cell.corners[cell.n++] = {i + di, j + dj, f};
    }
    return cell;
  }

  // Does the cell with lower left corner (i, j) belong to the domain? Arguments may wrap around below 0.
  [[nodiscard]] bool in_domain(std::size_t i, std::size_t j) const {
    return i + 1 < grid_.nx && j + 1 < grid_.ny && i + 1 > i && j + 1 > j && cell(i, j).n >= 3;
  }

  [[nodiscard]] std::uint64_t sample_name(const Corner& c) const { return 4 * (c.j * grid_.nx + c.i); }

  [[nodiscard]] Node corner_node(const Corner& c) const {
    return {sample_name(c), {static_cast<double>(c.i), static_cast<double>(c.j)}};
  }

  // On the side between a and b: the same name and the same bits from either cell.
  [[nodiscard]] Node crossing(const Corner& a, const Corner& b) const {
    const bool ordered = sample_name(a) < sample_name(b);
    const Corner &low = ordered ? a : b, &high = ordered ? b : a;
    const double t = (0.5 * level_ - 0.5 * low.f) / (0.5 * high.f - 0.5 * low.f);  // halves do not overflow
    const Vec2 from = corner_node(low).at, to = corner_node(high).at;
    const bool along_x = low.j == high.j, along_y = low.i == high.i;
    // A cell has at most one diagonal side; it is named by the cell's lower left sample.
    const Corner cell_corner = {std::min(low.i, high.i), low.j, 0};
    const std::uint64_t name = along_x   ? sample_name(low) + 1
                               : along_y ? sample_name(low) + 2
                                         : sample_name(cell_corner) + 3;
    return {name, from + t * (to - from)};
  }

  // Is there domain on the other side of a → b, where this cell is on the left?
  [[nodiscard]] bool is_boundary(const Corner& a, const Corner& b) const {
    if (a.i != b.i && a.j != b.j) return true;
    const std::size_t i = std::min(a.i, b.i), j = std::min(a.j, b.j);
    if (a.j == b.j) return !(b.i > a.i ? in_domain(i, j - 1) : in_domain(i, j));
    return !(b.j > a.j ? in_domain(i, j) : in_domain(i - 1, j));
  }

  // Walks around the cell; where the walk leaves f ≥ level, the level line leads to where it comes back.
  void visit(const Cell& cell) {
    if (cell.n < 3) return;
    std::array<Node, 2> exits, entries;
    std::size_t n_exits = 0, n_entries = 0;
    bool exit_first = false;
    for (std::size_t k = 0; k < cell.n; ++k) {
      const Corner &a = cell.corners[k], &b = cell.corners[(k + 1) % cell.n];
      const bool from = inside(a.f), to = inside(b.f);
      if (from != to) {
        const Node at = crossing(a, b);
        if (n_exits + n_entries == 0) exit_first = from;
        (from ? exits[n_exits++] : entries[n_entries++]) = at;
        if (is_boundary(a, b)) links_.boundary.push_back(from ? Link{corner_node(a), at} : Link{at, corner_node(b)});
      } else if (from && is_boundary(a, b)) {
        links_.boundary.push_back({corner_node(a), corner_node(b)});
      }
    }
    if (n_exits == 1) links_.level.push_back({exits[0], entries[0]});
    if (n_exits == 2) visit_saddle(cell, exits, entries, exit_first);
  }

  void visit_saddle(const Cell& cell, const std::array<Node, 2>& exits, const std::array<Node, 2>& entries,
                    bool exit_first) {
    const auto& c = cell.corners;
    const double saddle = (c[0].f * c[2].f - c[1].f * c[3].f) / (c[0].f + c[2].f - c[1].f - c[3].f);
    // Joined inside: each exit leads to the entry that the walk comes to next, around an outside corner. Else to
    // the one it came from, around an inside corner.
    const std::size_t next_of_first = exit_first ? 0 : 1;
    const std::size_t entry = inside(saddle) ? next_of_first : 1 - next_of_first;
    links_.level.push_back({exits[0], entries[entry]});
    links_.level.push_back({exits[1], entries[1 - entry]});
  }

  const SampleGrid& grid_;
  double level_;
  Links links_;
};

// Joins links end to start: chains that begin where no link ends, and loops.
class Joiner {
 public:
  explicit Joiner(std::vector<Link> links) : links_(std::move(links)), used_(links_.size(), false) {
    std::stable_sort(links_.begin(), links_.end(),
                     [](const Link& a, const Link& b) { return a.from.name < b.from.name; });
  }

  // Loops repeat their first point.
  std::vector<std::vector<Vec2>> join() {
    std::vector<std::uint64_t> ends;
    ends.reserve(links_.size());
    for (const Link& link : links_) ends.push_back(link.to.name);
    std::sort(ends.begin(), ends.end());
    std::vector<std::vector<Vec2>> result;
    for (const bool whole_loops : {false, true}) {
      for (std::size_t k = 0; k < links_.size(); ++k) {
        const bool starts = !std::binary_search(ends.begin(), ends.end(), links_[k].from.name);
        if (!used_[k] && (whole_loops || starts)) result.push_back(follow(k));
      }
    }
    return result;
  }

 private:
  std::vector<Vec2> follow(std::size_t k) {
    std::vector<Vec2> points = {links_[k].from.at};
    const std::uint64_t first = links_[k].from.name;
    for (;;) {
      used_[k] = true;
      points.push_back(links_[k].to.at);
      if (links_[k].to.name == first) return points;
      const auto next = find_unused(links_[k].to.name);
      if (next == links_.size()) return points;
      k = next;
    }
  }

  [[nodiscard]] std::size_t find_unused(std::uint64_t name) const {
    auto at = std::lower_bound(links_.begin(), links_.end(), name,
                               [](const Link& link, std::uint64_t n) { return link.from.name < n; });
    for (; at != links_.end() && at->from.name == name; ++at) {
      const auto k = static_cast<std::size_t>(at - links_.begin());
      if (!used_[k]) return k;
    }
    return links_.size();
  }

  std::vector<Link> links_;
  std::vector<bool> used_;
};

}  // namespace

std::vector<std::vector<Vec2>> contour_lines(const SampleGrid& grid, double level) {
  return Joiner(Marcher(grid, level).march().level).join();
}

std::vector<std::vector<Vec2>> superlevel_loops(const SampleGrid& grid, double level) {
  Links links = Marcher(grid, level).march();
  links.boundary.insert(links.boundary.end(), links.level.begin(), links.level.end());
  std::vector<std::vector<Vec2>> loops = Joiner(std::move(links.boundary)).join();
  for (auto& loop : loops) loop.pop_back();
  return loops;
}

}  // namespace temper
