// Figure 5: the sub-triangle with legs d_ij and h_k, and what dividing HOT by areas gives (§2.3, §4).
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "experiments/free_vertex.hpp"
#include "experiments/labeled_triangle.hpp"
#include "experiments/minimize.hpp"
#include "experiments/single_triangle.hpp"
#include "experiments/text.hpp"
#include "figures.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/energy.hpp"

namespace temper::gallery::fig05 {
namespace {

constexpr double kAlpha = 1.0 / 3, kBeta = 1.0 / 3;  // of ★1
constexpr double kRounding = 1e-9;                   // relative

/// Eq. 2.
double hot_half(double d, double h) { return kAlpha * d * d * d * h + kBeta * d * h * h * h; }
double divided_half(double d, double h) { return hot_half(d, h) / (d * d * h * h); }
/// Both halves of an edge of length 1, without χ.
double divided_edge(double d, double h) { return divided_half(d, h) + divided_half(1 - d, h); }

/// f(d, h) over the six half-edges of a triangle.
template <class F>
double sum_halves(const Corners& p, F&& f) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const WeightedPoint &a = p[k], &b = p[(k + 1) % 3], &c = p[(k + 2) % 3];
    const double h = signed_height(a, b, c), d = dual_crossing(a, b), back = dual_crossing(b, a);
    sum += f(d, back, h) + f(back, d, h);
  }
  return sum;
}

Claim divided_by_the_sub_triangle(std::size_t tries) {
  const EnergyModel hard = paper_model(EnergyKind::BH);
  Random random(501);
  double worst = 0;
  std::size_t inside = 0;
  for (std::size_t n = 0; n < tries; ++n) {
    const Corners p = random_triangle(random, 0.3);
    const double energy = triangle_energy(hard, p[0], p[1], p[2]);
    if (!(energy < 1e4)) continue;  // outside the barrier, or so near that h has lost its digits
    ++inside;
    const double divided =
        sum_halves(p, [](double d, double back, double h) { return divided_half(d, h) * d / std::sqrt(d * back); });
    worst = std::max(worst, std::abs(divided - energy) / energy);
  }
  return {"5",
          "The hard barrier is E_F divided by d_ij² h_k², one d_ij replaced by √(d_ij d_ji)",
          "eq. 4 from eq. 2",
          "sums over triangles differ from E_BH^1 by at most " + digits(worst, 1) + ", relative",
          worst < kRounding && 10 * inside > tries,
          digits(inside) + " random triangles inside the barrier"};
}

/// The least value of the divided energy on a line d = at, or h = at.
double least_on_wall(bool of_d, double at) {
  const auto value = [&](double log_other) {
    const double other = std::exp(log_other);
    return of_d ? divided_edge(at, other) : divided_edge(other / (1 + other), at);
  };
  const auto least = scan_minimum(value, -30, 30, 600);
  return least ? least->value : 1e300;
}

Claim chi_makes_the_barrier() {
  struct Wall {
    const char* name;
    bool of_d;
    double near, at;
  };
  constexpr Wall kWalls[] = {{"d", true, 1e-3, 1e-9},
                             {"ℓ − d", true, 1 - 1e-3, 1 - 1e-9},
                             {"h", false, 1e-3, 1e-9},
                             {"h → ∞", false, 1e3, 1e9}};
  bool barrier = true;
  std::string found;
  for (const Wall& wall : kWalls) {
    const double near = least_on_wall(wall.of_d, wall.near), at = least_on_wall(wall.of_d, wall.at);
    barrier = barrier && at > 100 * near;
    found += (found.empty() ? "" : "; ") + std::string(wall.name) + ": " + digits(near, 2) + ", " + digits(at, 2);
  }
  const Minimum2 minimum = simplex_minimum(
      [](Vec2 p) { return p.x > 0 && p.x < 1 && p.y > 0 ? divided_edge(p.x, p.y) : 1e300; }, {0.3, 0.8}, 0.1);
  return {
      "2.3",
      "Dividing by d_ij² h_k² alone gives no barrier: to provide one, a d_ij is replaced by √(d_ij d_ji)",
      "“to actually provide a barrier”",
      "without it the least values of an edge's energy a thousandth and 1e−9 of ℓ from each wall (1e3 and 1e9 ℓ for "
      "h → ∞) are " +
          found,
      !barrier,
      "it is a barrier without χ, too: α ℓ/h + β h ℓ/(d (ℓ − d)) with ℓ = 1, least at (" + digits(minimum.at.x, 3) +
          ", " + digits(minimum.at.y, 3) + ") with the value " + digits(minimum.value, 5) +
          " that E_BH^1 has there. What χ adds is that nothing real is left beyond d = 0, where the other form is "
          "negative"};
}

Claim whole_area_is_no_barrier() {
  const EnergyModel hot = paper_model(EnergyKind::F);
  const auto least = [&](double radius) {
    double smallest = 1e300;
    for (int degrees = 1; degrees < 180; ++degrees) {
      const double t = degrees * std::numbers::pi / 180;
      const Vec2 p = kRight + radius * Vec2{std::cos(t), std::sin(t)};
      const double area = doubled_area(kLeft, kRight, p) / 2;
      smallest = std::min(smallest, free_vertex_energy(hot, p) / (area * area));
    }
    return smallest;
  };
  const double far = least(0.1), near = least(1e-3), nearest = least(1e-5);
  return {"4 Barriers",
          "Divided by the square of the triangle's area, HOT tends to zero where an edge collapses: no barrier",
          "goes to zero",
          "least E_F^1/area² on half circles around a fixed vertex: " + digits(far, 3) + " at 0.1, " + digits(near, 3) +
              " at 1e−3, " + digits(nearest, 3) + " at 1e−5",
          nearest < near && near < far,
          "179 directions, the triangle of figure 3. It tends to infinity: E_F^1 falls with the length of the "
          "collapsing edge, "
          "the area's square with the square of that length"};
}

Claim sub_triangles_tile(std::size_t tries) {
  Random random(502);
  double worst = 0;
  for (std::size_t n = 0; n < tries; ++n) {
    const Corners p = random_triangle(random, 1);
    const double area = doubled_area(p[0].position(), p[1].position(), p[2].position()) / 2;
    double all = 0;
    const double sum = sum_halves(p, [&](double d, double, double h) {
      all += std::abs(d * h) / 2;
      return d * h / 2;
    });
    worst = std::max(worst, std::abs(sum - area) / (all + area));
  }
  return {"5",
          "The six sub-triangles of a triangle add up to it, with the signs of d and h, whatever its weights",
          "not in the paper",
          "Σ d h / 2 differs from the area by at most " + digits(worst, 1) + " of the parts",
          worst < kRounding,
          digits(tries) + " random triangles, weights in ±1",
          Author::temper};
}

}  // namespace

Page make(Effort effort) {
  const std::size_t tries = effort == Effort::full ? 20000 : 2000;
  const LabeledTriangle drawing = {.corners = {WeightedPoint{0, 0, 0.35}, {4, 0, 0}, {1.8, 3.4, -0.2}},
                                   .sub_triangle = true};
  return {{{"fig05", labeled_triangle_svg(drawing),
            "The sub-triangle of the half-edge from i to j: its legs are d_ij and h_k, its area d_ij h_k / 2."}},
          {},
          {divided_by_the_sub_triangle(tries), chi_makes_the_barrier(), whole_area_is_no_barrier(),
           sub_triangles_tile(tries)}};
}

}  // namespace temper::gallery::fig05
