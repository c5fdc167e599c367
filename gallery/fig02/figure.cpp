// Figure 2: which of the distances d and h of a triangle can be negative, with and without weights.
#include <algorithm>
#include <cmath>
#include <string>

#include "experiments/single_triangle.hpp"
#include "experiments/text.hpp"
#include "experiments/triangle_drawing.hpp"
#include "figures.hpp"
#include "temper/detail/geometry.hpp"

namespace temper::gallery::fig02 {
namespace {

constexpr double kWeight = 1;

/// Of one triangle: how many of its h, and of its six d, are negative; exact.
struct Signs {
  std::size_t negative_h = 0, negative_d = 0;
};
Signs signs(const Corners& p) {
  Signs s;
  for (std::size_t k = 0; k < 3; ++k) {
    const WeightedPoint &a = p[k], &b = p[(k + 1) % 3], &c = p[(k + 2) % 3];
    s.negative_h += signed_height_sign(a, b, c) == Sign::negative;
    s.negative_d += (dual_crossing_sign(a, b) == Sign::negative) + (dual_crossing_sign(b, a) == Sign::negative);
  }
  return s;
}

bool is_obtuse(const Corners& p) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 a = p[k].position();
    if (dot(p[(k + 1) % 3].position() - a, p[(k + 2) % 3].position() - a) < 0) return true;
  }
  return false;
}

Claim obtuse_has_one_negative_height(std::size_t tries) {
  Random random(201);
  std::size_t obtuse = 0, one = 0, acute_none = 0;
  for (std::size_t n = 0; n < tries; ++n) {
    const Corners p = random_triangle(random, 0);
    const std::size_t negative = signs(p).negative_h;
    obtuse += is_obtuse(p);
    one += is_obtuse(p) && negative == 1;
    acute_none += !is_obtuse(p) && negative == 0;
  }
  return {"2",
          "An unweighted obtuse triangle has one h < 0, as its circumcenter is outside",
          "one h < 0",
          "one of the three h is negative in " + digits(one) + " of " + digits(obtuse) + " obtuse triangles; none in " +
              digits(acute_none) + " of " + digits(tries - obtuse) + " others",
          obtuse > 0 && obtuse < tries && one == obtuse && acute_none == tries - obtuse,
          "random triangles, obtuse by the scalar products of their sides; signs of h exact"};
}

Claim unweighted_crossings(std::size_t tries) {
  Random random(202);
  std::size_t negative = 0;
  for (std::size_t n = 0; n < tries; ++n) negative += signs(random_triangle(random, 0)).negative_d;
  return {"2",           "An unweighted triangle has all d > 0",
          "all d > 0",   digits(negative) + " of " + digits(6 * tries) + " are negative",
          negative == 0, "random triangles, exact signs"};
}

Claim weighted_signs(std::size_t tries) {
  Random random(203);
  std::size_t only_d = 0, only_h = 0, both = 0;
  for (std::size_t n = 0; n < tries; ++n) {
    const Signs s = signs(random_triangle(random, kWeight));
    only_d += s.negative_d > 0 && s.negative_h == 0;
    only_h += s.negative_d == 0 && s.negative_h > 0;
    both += s.negative_d > 0 && s.negative_h > 0;
  }
  return {"2",
          "A weighted triangle can have some d < 0 with all h > 0, and both a d < 0 and an h < 0",
          "can have",
          "of " + digits(tries) + " triangles " + digits(only_d) + " have some d < 0 and all h > 0, " + digits(both) +
              " have both, " + digits(only_h) + " some h < 0 alone",
          only_d > 0 && both > 0,
          "random corners in a square of width 2, weights in ±1, exact signs"};
}

/// Weights that put the orthocenter of a triangle to o: p_k's is its squared distance, up to a constant.
Corners with_orthocenter(Corners p, Vec2 o) {
  const double w0 = squared_length(p[2].position() - o);
  for (WeightedPoint& v : p) v.w = squared_length(v.position() - o) - w0;
  return p;
}

Claim orthocenter_anywhere(std::size_t tries) {
  constexpr double kFar = 10, kRounding = 1e-9;
  Random random(204);
  double worst = 0;
  for (std::size_t n = 0; n < tries; ++n) {
    const Vec2 o = {random(-kFar, kFar), random(-kFar, kFar)};
    const Corners p = with_orthocenter(random_triangle(random, 0), o);
    worst = std::max(worst, length(orthocenter(p[0], p[1], p[2]) - o));
  }
  return {"2",
          "The orthocenter of three points can be put anywhere by their weights",
          "anywhere in the plane",
          digits(tries) + " random triangles and places in a square ten times as wide: missed by at most " +
              digits(worst, 1),
          worst < kRounding,
          "w_k = |p_k − o|² up to one constant, then the library's orthocenter"};
}

Picture drawings() {
  const Corners obtuse = {WeightedPoint{-0.5, 0, 0}, {1, 0, 0}, {-0.1, 0.45, 0}};
  const Corners acute = {WeightedPoint{-0.5, 0, 0}, {0.9, 0, 0}, {0.1, 0.9, 0}};
  TriangleTable table;
  table.cell_width = 190;
  table.low = {-0.9, -0.65}, table.high = {1.3, 1.05};
  table.columns = {"no weights, acute", "no weights, obtuse", "some d < 0, all h > 0", "some d < 0, some h < 0"};
  table.rows = {
      {"", {acute, obtuse, with_orthocenter(obtuse, {0.45, 0.08}), with_orthocenter(obtuse, {0.65, -0.12})}, {}}};
  for (const auto& cell : table.rows[0].cells) {
    const Signs s = signs(*cell);
    table.rows[0].captions.push_back(digits(s.negative_d) + " d and " + digits(s.negative_h) + " h negative");
  }
  return {
      "fig02", triangle_table_svg(table),
      "Blue: from the orthocenter to the edges' lines, dashed where they miss the edge (d < 0). Circles: radius √|w|, "
      "green positive, red dashed negative."};
}

}  // namespace

Page make(Effort effort) {
  const std::size_t tries = effort == Effort::full ? 20000 : 2000;
  return {{drawings()},
          {},
          {obtuse_has_one_negative_height(tries), unweighted_crossings(tries), weighted_signs(tries),
           orthocenter_anywhere(tries)}};
}

}  // namespace temper::gallery::fig02
