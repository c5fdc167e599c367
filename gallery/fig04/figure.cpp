// Figure 4: E_F by the weight of one vertex of a triangle with sides 0.5 and 1 (§3.1.2).
//
// For ★1 the energy is a cubic in the weight, for ★2 a parabola (the second moment of the triangle about an
// orthocenter that moves along a line): extrema and leading coefficients are exact, not searched for.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "experiments/single_triangle.hpp"
#include "experiments/text.hpp"
#include "experiments/triangle_drawing.hpp"
#include "figures.hpp"
#include "plot/plot.hpp"

namespace temper::gallery::fig04 {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::array<double, 5> kAngles = {0.25, 1.0 / 3, 0.5, 2.0 / 3, 0.75};  // of π, drawn
constexpr std::array<double, 3> kDrawn = {1.0 / 3, 0.5, 2.0 / 3};               // of π, in the drawings
constexpr double kRoundedToZero = 1e-12;  // ★0 is stationary at w = 0, which the polynomial meets to rounding
constexpr double kObtuse = 2.0 / 3;       // of π, the one in the claims

double energy(int star, double theta, double w) {
  const Corners p = angle_triangle(theta, w);
  return triangle_energy(paper_model(EnergyKind::F, star), p[0], p[1], p[2]);
}

std::string angle_name(double of_pi) {
  for (const auto& [value, name] :
       {std::pair{0.25, "π/4"}, {1.0 / 3, "π/3"}, {0.5, "π/2"}, {2.0 / 3, "2π/3"}, {0.75, "3π/4"}}) {
    if (of_pi == value) return name;
  }
  return digits(of_pi, 3) + "π";
}

Picture curves(int star, int samples) {
  LinePlot plot;
  plot.title = "E_{F}, ★" + std::to_string(star);
  plot.x_label = "weight w";
  plot.y_label = "E_{F}";
  plot.x_range = PlotRange{-1.6, 1};
  plot.y_range = star == 1 ? PlotRange{-0.4, 0.8} : star == 0 ? PlotRange{-0.4, 0.6} : PlotRange{0, 0.6};
  plot.width = 400;
  plot.height = 330;
  plot.legend = LegendPlace::outside;
  for (const double angle : kAngles) {
    Series series{.name = "θ = " + angle_name(angle), .points = {}, .color = {}};
    for (int i = 0; i <= samples; ++i) {
      const double w = -1.6 + 2.6 * i / samples;
      series.points.push_back({w, energy(star, angle * kPi, w)});
    }
    plot.series.push_back(series);
    const auto cubic = weight_polynomial(star, angle * kPi);
    if (const auto at = extrema(cubic)) plot.marks.push_back({{at->minimum, evaluate(cubic, at->minimum)}, ""});
  }
  const std::array<std::string, 3> captions = {
      "★0 by the weight of the vertex at the angle θ: unbounded as ★1 is; dots are local minima, all at w = 0.",
      "★1: a local minimum (dots), shallower the larger the angle, and E_F → −∞ to its left.",
      "★2: parabolas, bounded; but for large angles the least value is reached outside 0 < d < ℓ."};
  return {"fig04_star" + std::to_string(star), line_plot_svg(plot), captions[static_cast<std::size_t>(star)]};
}

Picture drawings() {
  TriangleTable table;
  table.columns = {"★0, minimum", "★1, minimum", "★2, minimum", "w = −0.5", "w = −1"};
  table.low = {-1.05, -1.05};
  table.high = {1.15, 0.85};
  table.cell_width = 150;
  for (const double angle : kDrawn) {
    TriangleRow row{.label = angle_name(angle), .cells = {}, .captions = {}};
    const auto add = [&](int star, double w) {
      row.cells.push_back(angle_triangle(angle * kPi, w));
      row.captions.push_back("w = " + digits(w, 2) + ", E = " + digits(energy(star, angle * kPi, w), 2));
    };
    for (const int star : {0, 1, 2}) {
      const auto at = extrema(weight_polynomial(star, angle * kPi));
      const double w = at ? at->minimum : 0;
      add(star, std::abs(w) < kRoundedToZero ? 0 : w);
    }
    for (const double w : {-0.5, -1.0}) add(1, w);
    table.rows.push_back(row);
  }
  return {"fig04_triangles", triangle_table_svg(table),
          "Triangles and duals at the local minimum of each star, and with weights on the way to −∞ (E of ★1). Circles "
          "have the radius √|w|, dashed where w < 0. With ★2 and a large angle the dual of the left edge misses it "
          "(dashed)."};
}

// Where the leading coefficient of ★1 changes sign: sharper angles fall without bound at the other end.
double turning_angle() {
  double low = 0.05, high = 0.5;
  for (int k = 0; k < 60; ++k) {
    const double middle = (low + high) / 2;
    (weight_polynomial(1, middle * kPi)[3] > 0 ? high : low) = middle;
  }
  return high;
}

Claim unbounded() {
  bool holds = true;
  const double turning = turning_angle();
  for (int k = 1; k <= 99; ++k) {
    const double angle = k / 100.0;
    if (angle <= turning) continue;
    const double far = energy(1, angle * kPi, -100);
    holds = holds && weight_polynomial(1, angle * kPi)[3] > 0 && far < 0 && energy(1, angle * kPi, -1000) < 500 * far;
  }
  return {"4",
          "E_F^1 is unbounded: it tends to −∞ as one weight tends to −∞",
          "→ −∞",
          "for θ = 2π/3: " + digits(energy(1, kObtuse * kPi, -10)) + ", " + digits(energy(1, kObtuse * kPi, -100)) +
              ", " + digits(energy(1, kObtuse * kPi, -1000)) +
              " at w = −10, −100, −1000; a cubic with a positive leading "
              "coefficient for all angles above " +
              digits(turning, 4) + "π",
          holds,
          "coefficient and values at w = −100 and −1000 for each hundredth of π above that angle"};
}

Claim other_angles() {
  const double turning = turning_angle();
  std::size_t unbounded = 0, left = 0, with_minimum = 0, n = 0;
  for (int k = 1; k <= 99; ++k) {
    const double lead = weight_polynomial(1, k * kPi / 100)[3];
    const double value = energy(1, k * kPi / 100, lead > 0 ? -1e4 : 1e4);
    unbounded += value < -1e3;
    left += lead > 0;
    with_minimum += extrema(weight_polynomial(1, k * kPi / 100)).has_value();
    ++n;
  }
  return {"4",
          "Triangles with other angles behave alike: a local minimum, and no bound",
          "qualitatively similar",
          "alike but for the side: a local minimum at " + digits(with_minimum) + " and no bound at " +
              digits(unbounded) + " of " + digits(n) + " angles, but w → −∞ is the unbounded side at " + digits(left) +
              " only; at angles below " + digits(turning, 4) + "π it is w → +∞",
          unbounded == n && with_minimum == n,
          "extrema of the cubic, sign of the cubic's leading coefficient, and E_F^1 < −1000 on that side, each "
          "hundredth of π"};
}

Claim shallower() {
  const double turning = turning_angle();
  bool holds = true;
  double before = 1e300;
  std::size_t n = 0;
  for (int k = 1; k <= 99; ++k) {
    if (k / 100.0 <= turning) continue;
    const auto cubic = weight_polynomial(1, k * kPi / 100);
    const auto at = extrema(cubic);
    if (!at) {
      holds = false;
      continue;
    }
    const double depth = evaluate(cubic, at->maximum) - evaluate(cubic, at->minimum);
    holds = holds && depth > 0 && depth < before;
    before = depth;
    ++n;
  }
  std::string found;
  for (const double angle : kAngles) {
    const auto cubic = weight_polynomial(1, angle * kPi);
    const auto at = extrema(cubic);
    if (!at) continue;
    found += (found.empty() ? "" : ", ") + digits(evaluate(cubic, at->maximum) - evaluate(cubic, at->minimum), 3) +
             " at " + angle_name(angle);
  }
  return {"4",
          "E_F^1 has a local minimum in the weight, shallower the larger the angle",
          "shallower the larger the angle",
          "depth below the barrier to its left: " + found,
          holds && n > 70,
          "falls from each to the next of " + digits(n) + " angles above " + digits(turning, 4) +
              "π, a hundredth of π apart"};
}

Claim convex_star2() {
  bool holds = true;
  double least = 1e300, cubic_part = 0;
  for (int k = 1; k <= 99; ++k) {
    const auto c = weight_polynomial(2, k * kPi / 100);
    least = std::min(least, c[2]);
    cubic_part = std::max(cubic_part, std::abs(c[3]) / c[2]);
    holds = holds && c[2] > 0;
  }
  constexpr double kRounding = 1e-10;  // of the coefficients
  return {"4",
          "E_F^2 is convex in the weight and bounded",
          "convex, not unbounded",
          "a parabola at every angle: leading coefficient at least " + digits(least, 3) + ", cubic part at most " +
              digits(cubic_part, 1) + " of it",
          holds && cubic_part < kRounding,
          "coefficients at 99 angles: E_F^2 is the second moment about the orthocenter"};
}

Claim inside_but_negative_d() {
  std::size_t inside = 0, missed = 0, n = 0;
  double first_missed = 1;
  for (int k = 1; k <= 99; ++k) {
    const auto at = extrema(weight_polynomial(2, k * kPi / 100));
    if (!at) continue;
    const Margins m = margins(angle_triangle(k * kPi / 100, at->minimum));
    ++n;
    inside += m.min_h > 0;
    if (m.min_h > 0 && m.min_d < 0 && k > 50) first_missed = std::min(first_missed, k / 100.0), ++missed;
  }
  return {"4",
          "At the minimum of E_F^2 the orthocenter is often inside the triangle, but some d < 0 for large angles",
          "often inside; d < 0 for a large angle",
          "inside at " + digits(inside) + " of " + digits(n) +
              " angles; of these some d is negative from θ = " + digits(first_missed, 3) + "π on",
          2 * inside > n && missed > 0,
          "minimum of the parabola at each hundredth of π, signs of all h and d"};
}

Claim constraint_does_not_help() {
  const double theta = kObtuse * kPi;
  // d of the short side is 0 at w = −ℓ² = −0.25.
  const double at_zero = -0.25;
  bool falls = true;
  for (int k = 1; k <= 100; ++k) {
    falls = falls && energy(2, theta, at_zero * k / 100) < energy(2, theta, at_zero * (k - 1) / 100);
  }
  const Margins m = margins(angle_triangle(theta, at_zero * 0.999));
  return {"4",
          "Under the constraint d > 0 alone, E_F^2 keeps falling as d → 0",
          "keeps decreasing as d → 0",
          "for θ = 2π/3: " + digits(energy(2, theta, 0)) + " at w = 0, " + digits(energy(2, theta, at_zero)) +
              " at w = −0.25 where d = 0, falling all the way; least d just before: " + digits(m.min_d, 2),
          falls && m.min_d > 0 && m.min_d < 1e-3,
          "100 steps between the two weights"};
}

}  // namespace

Page make(Effort effort) {
  const int samples = effort == Effort::full ? 260 : 80;
  Page page;
  page.pictures = {drawings(), curves(0, samples), curves(1, samples), curves(2, samples)};
  Table table{.caption = "Local minima of E_F^1 in the weight",
              .header = {"angle", "w", "E_F^1", "least d", "least h", "depth"},
              .rows = {}};
  for (const double angle : kAngles) {
    const auto cubic = weight_polynomial(1, angle * kPi);
    const auto at = extrema(cubic);
    if (!at) continue;
    const Margins m = margins(angle_triangle(angle * kPi, at->minimum));
    table.rows.push_back({angle_name(angle), digits(at->minimum), digits(evaluate(cubic, at->minimum)),
                          digits(m.min_d, 3), digits(m.min_h, 3),
                          digits(evaluate(cubic, at->maximum) - evaluate(cubic, at->minimum), 3)});
  }
  page.tables = {table};
  page.claims = {unbounded(),    other_angles(),          shallower(),
                 convex_star2(), inside_but_negative_d(), constraint_does_not_help()};
  return page;
}

}  // namespace temper::gallery::fig04
