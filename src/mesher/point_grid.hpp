// Points with sizes, and whether one of them is near a place: a hashed grid with one level for each power of two.
//
// A point lies in the level of its size. A query looks at levels whose points may be that near: sizes grow no faster
// than distances, so these are the levels around its radius.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "temper/detail/vec3.hpp"

namespace temper::mesher {

class PointGrid {
 public:
  /// `flat`: all points have z = 0.
  explicit PointGrid(bool flat) : flat_(flat) {}

  void add(Vec3 p, double size) {
    if (2 * (points_.size() + 1) > slots_.size()) grow();
    const int level = std::ilogb(size);
    lowest_ = points_.empty() ? level : std::min(lowest_, level);
    highest_ = points_.empty() ? level : std::max(highest_, level);
    points_.push_back({p, level, kNone});
    insert(static_cast<std::uint32_t>(points_.size() - 1));
  }

  /// Looks at points whose size is between a quarter and four times the radius, and at all that are larger or smaller
  /// in neighbouring levels of these.
  [[nodiscard]] bool any_within(Vec3 p, double radius) const {
    const int level = std::ilogb(radius);
    const Vec3 reach = {radius, radius, flat_ ? 0 : radius};
    for (int l = std::max(lowest_, level - 1); l <= std::min(highest_, level + 2); ++l) {
      const Cell low = cell(p - reach, l), high = cell(p + reach, l);
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
    int level;
    std::uint32_t next;
  };
  struct Cell {
    std::int64_t x, y, z;
    int level;
    friend bool operator==(const Cell&, const Cell&) = default;
  };

  [[nodiscard]] Cell cell(Vec3 p, int level) const {
    // In space a query would look at 729 cells of the least level, nearly all of them off the sphere.
    const int wide = flat_ ? level : level + 2;
    const auto along = [wide](double x) { return static_cast<std::int64_t>(std::floor(std::ldexp(x, -wide))); };
    return {along(p.x), along(p.y), along(p.z), level};
  }
  [[nodiscard]] std::size_t slot(const Cell& c) const {
    std::uint64_t hash = static_cast<std::uint64_t>(c.x) * 0x9e3779b97f4a7c15u;
    hash = (hash ^ (hash >> 29) ^ static_cast<std::uint64_t>(c.y)) * 0xbf58476d1ce4e5b9u;
    hash = (hash ^ (hash >> 31) ^ static_cast<std::uint64_t>(c.z)) * 0xd6e8feb86659fd93u;
    hash = (hash ^ (hash >> 32) ^ static_cast<std::uint64_t>(std::int64_t{c.level})) * 0x94d049bb133111ebu;
    return static_cast<std::size_t>(hash ^ (hash >> 31)) & (slots_.size() - 1);
  }
  /// The slot of the cell: where its first point is, or the empty one where it would be.
  [[nodiscard]] std::size_t find(const Cell& c) const {
    std::size_t s = slot(c);
    while (slots_[s] != kNone && !(cell(points_[slots_[s]].at, points_[slots_[s]].level) == c)) {
      s = (s + 1) & (slots_.size() - 1);
    }
    return s;
  }
  [[nodiscard]] std::uint32_t first(const Cell& c) const { return slots_.empty() ? kNone : slots_[find(c)]; }
  void insert(std::uint32_t i) {
    const std::size_t s = find(cell(points_[i].at, points_[i].level));
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

}  // namespace temper::mesher
