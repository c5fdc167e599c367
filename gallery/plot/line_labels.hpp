// The place along a contour line where its level is written: where the line is straight and nothing else is near.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "draw/frame.hpp"
#include "temper/detail/vec2.hpp"

namespace temper {

struct LabelPlace {
  Vec2 middle;       ///< pixels, y down
  double angle = 0;  ///< degrees, clockwise, in (−90, 90]: text is never upside down
};

/// The places that are drawn on already, in squares of a few pixels. Owners are small numbers: one a level.
class Occupancy {
 public:
  explicit Occupancy(const Box& area);

  void add_line(std::span<const Vec2> points, int owner);
  void add_disc(Vec2 center, double radius, int owner);
  /// Has anybody but `owner` drawn within about 1.5 squares of p? True outside the area.
  [[nodiscard]] bool others_near(Vec2 p, int owner) const;

 private:
  [[nodiscard]] bool find(Vec2 p, std::size_t& column, std::size_t& row) const;
  void add(Vec2 p, int owner);

  Box area_;
  std::size_t columns_ = 0, rows_ = 0;
  std::vector<std::uint64_t> owners_;  // a bit an owner, modulo 64
};

/// The best place on the line for a label of this size; nothing when it fits nowhere.
[[nodiscard]] std::optional<LabelPlace> place_label(std::span<const Vec2> line, double width, const Occupancy& drawn,
                                                    int owner);

}  // namespace temper
