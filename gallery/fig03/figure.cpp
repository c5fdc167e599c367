// Figure 3: E_F of ★0, ★1 and ★2 over the position of one vertex, without weights (§3.1.1).
#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/free_vertex.hpp"
#include "experiments/minimize.hpp"
#include "experiments/numbers.hpp"
#include "experiments/single_triangle.hpp"
#include "experiments/text.hpp"
#include "figures.hpp"

namespace temper::gallery::fig03 {
namespace {

double energy(int star, Vec2 p) { return free_vertex_energy(paper_model(EnergyKind::F, star), p); }

HalfCircle ring(int star, double radius) { return half_circle(paper_model(EnergyKind::F, star), radius); }

// The stationary point on the axis of symmetry.
struct Saddle {
  Vec2 at;
  double energy = 0;
  Curvature curvature;
};
std::optional<Saddle> axis_minimum(int star) {
  const auto least = scan_minimum([&](double y) { return energy(star, {0, y}); }, 0.05, 3, 300, true);
  if (!least) return std::nullopt;
  const Vec2 at = {0, least->at};
  return Saddle{at, least->value, curvature(paper_model(EnergyKind::F, star), at)};
}

Claim zero_at_collapse() {
  constexpr double kNear = 1e-3, kNearer = 1e-6;
  bool holds = true;
  std::string found;
  for (const int star : {0, 1, 2}) {
    const auto most = [&](double r) {
      return std::max(std::abs(ring(star, r).least), std::abs(ring(star, r).greatest));
    };
    const double near = most(kNear), nearer = most(kNearer);
    holds = holds && nearer < 2 * near * kNearer / kNear;  // at least in proportion to the distance
    found += (star == 0 ? "★" : ", ★") + std::to_string(star) + ": " + digits(near, 2) + " and " + digits(nearer, 2);
  }
  return {"3",    "E_F of a triangle tends to 0 when an edge collapses, for ★0, ★1 and ★2",
          "zero", "greatest |E_F| at distance 1e−3 and 1e−6 from a fixed vertex: " + found,
          holds,  "179 directions of approach, 1° apart; |E_F| falls in proportion to the distance"};
}

Claim collapse_is_minimum() {
  bool holds = true;
  std::string found;
  for (const double r : {0.3, 0.1, 1e-2, 1e-4}) {
    const double least = ring(1, r).least;
    holds = holds && least > 0;
    found += (found.empty() ? "" : ", ") + digits(least, 3) + " at " + digits(r, 1);
  }
  return {"3",
          "Moving the free vertex onto a fixed one is a local minimum of E_F^1, with value 0",
          "local minimum, 0",
          "least E_F^1 on half circles around the fixed vertex: " + found,
          holds,
          "positive on every half circle, 0 in the limit: a strict local minimum"};
}

Claim saddle_claim(const std::optional<Saddle>& saddle) {
  Claim claim{"3",
              "E_F^1 has a saddle at an obtuse isosceles triangle: least along y, greatest along x",
              "a saddle for an obtuse isosceles triangle",
              "",
              false,
              ""};
  if (!saddle) {
    claim.temper = "no stationary point on the axis";
    claim.why = "scan of E_F^1(0, y) for 0.05 < y < 3";
    return claim;
  }
  const Curvature& c = saddle->curvature;
  const double apex = apex_degrees(saddle->at);
  claim.holds = c.xx < 0 && c.yy > 0 && std::abs(c.xy) < 1e-4 * c.yy && apex > 90;
  claim.temper = "at (0, " + digits(saddle->at.y, 6) + "), apex angle " + digits(apex, 5) +
                 "°, E_F^1 = " + digits(saddle->energy, 5) + ", second derivatives " + digits(c.xx, 3) + " in x and " +
                 digits(c.yy, 3) + " in y";
  claim.why = "golden section along x = 0, then central differences; y = 1/√3 to " +
              digits(std::abs(saddle->at.y - 1 / std::sqrt(3.0)), 1);
  return claim;
}

Claim not_equilateral() {
  const Vec2 top = {0, std::sqrt(3.0)};
  const double here = energy(1, top), step = 0.05, below = energy(1, top - Vec2{0, step});
  const double collapsed = ring(1, 1e-6).greatest;
  return {"3",
          "The E_F^1-optimal triangle is not equilateral",
          "not equilateral",
          "E_F^1 = " + digits(here) + " for the equilateral triangle, " + digits(below) + " with the vertex " +
              digits(step, 1) + " lower, below " + digits(collapsed, 1) + " when it collapses",
          below < here && collapsed < here,
          "three evaluations: the equilateral triangle is not even stationary"};
}

Claim walls() {
  bool holds = true;
  double least = 1e300;
  int places = 0;
  for (const double x : {-3.0, -2.0, -1.5, -1.1, -0.9, -0.5, 0.0, 0.25, 0.5, 0.9, 1.1, 1.5, 2.0, 3.0}) {
    const std::array<double, 3> e = {energy(1, {x, 1e-2}), energy(1, {x, 1e-4}), energy(1, {x, 1e-6})};
    holds = holds && e[0] < e[1] && e[1] < e[2] && e[2] > 50 * e[1];
    least = std::min(least, e[2]);
    ++places;
  }
  return {"3",
          "Elsewhere, moving the free vertex towards the edge's line raises E_F^1 to +∞",
          "increases to infinity",
          "at " + std::to_string(places) +
              " places on and beside the edge E_F^1 grows a hundredfold with each hundredth of y; "
              "at y = 1e−6 it is at least " +
              digits(least, 3),
          holds,
          "y = 1e−2, 1e−4, 1e−6: E_F^1 goes like 1/y"};
}

Claim negative_star0() {
  std::size_t negative = 0, n = 0;
  double least = 0;
  for (int i = -19; i <= 19; ++i) {
    const double x = i / 20.0, e = energy(0, {x, 1e-3});
    negative += e < 0;
    least = std::min(least, e);
    ++n;
  }
  return {"3",
          "E_F^0 is negative for points close to the edge",
          "negative close to y = 0",
          "negative at " + digits(negative) + " of " + digits(n) + " places with |x| < 1 and y = 0.001, down to " +
              digits(least),
          negative == n,
          "E_F^0(x, 0.001) on a grid of x"};
}

Claim rising_star0(int per_unit) {
  std::size_t rising = 0, n = 0;
  double least = 1e300;
  for (int i = -2 * per_unit; i <= 2 * per_unit; ++i) {
    for (int j = 1; j <= 3 * per_unit; ++j) {
      const Vec2 p = {static_cast<double>(i) / per_unit, static_cast<double>(j) / per_unit};
      constexpr double kStep = 1e-5;
      const double slope = (energy(0, p + Vec2{0, kStep}) - energy(0, p - Vec2{0, kStep})) / (2 * kStep);
      least = std::min(least, slope);
      rising += slope > 0;
      ++n;
    }
  }
  return {"3",
          "E_F^0 increases with y everywhere, so it has no saddle",
          "no saddle; increases with y",
          "∂E_F^0/∂y > 0 at " + digits(rising) + " of " + digits(n) + " places, least " + digits(least, 3),
          rising == n,
          "central differences on a grid over |x| ≤ 2, 0 < y ≤ 3"};
}

Claim middle_of_edge() {
  double best = 0, least = 1e300;
  for (int i = -19; i <= 19; ++i) {
    const double x = i / 20.0, e = energy(0, {x, 1e-4});
    if (e < least) least = e, best = x;
  }
  const double times_y = 1e-6 * energy(0, {0, 1e-6});
  return {"3",
          "Collapsing the vertex into the middle of the opposite edge is a local minimum of E_F^0",
          "a local minimum",
          "least at x = " + digits(best, 2) + " of all |x| < 1, but as a pole and no minimum: there y · E_F^0 → " +
              digits(times_y, 4) + ", so that E_F^0 falls without bound and a search has nothing to end at",
          best == 0 && energy(0, {0, 1e-6}) < energy(0, {0, 1e-4}),
          "grid of x at y = 1e−4, and y → 1e−6 at x = 0, where E_F^0 goes like −1/(12 y)"};
}

// The most that E_F in the middle of a segment exceeds the mean of its ends.
Claim not_convex(std::size_t tries) {
  bool holds = true;
  std::string found;
  Random uniform(5);
  for (const int star : {0, 1, 2}) {
    double worst = -1e300;
    Vec2 worst_a, worst_b;
    for (std::size_t k = 0; k < tries; ++k) {
      const Vec2 a = {uniform(-2, 2), uniform(0.1, 3)}, b = {uniform(-2, 2), uniform(0.1, 3)};
      const double excess = energy(star, 0.5 * (a + b)) - (energy(star, a) + energy(star, b)) / 2;
      if (excess > worst) worst = excess, worst_a = a, worst_b = b;
    }
    holds = holds && worst > 0;
    found += (star == 0 ? "★" : "; ★") + std::to_string(star) + ": by " + digits(worst, 3) + " between (" +
             digits(worst_a.x, 3) + ", " + digits(worst_a.y, 3) + ") and (" + digits(worst_b.x, 3) + ", " +
             digits(worst_b.y, 3) + ")";
  }
  return {"3",
          "None of the HOT energies is convex in the position",
          "none is convex",
          "the middle of a segment exceeds the mean of its ends, " + found,
          holds,
          digits(tries) + " random segments each in |x| ≤ 2, 0.1 ≤ y ≤ 3"};
}

Claim star2_alike(const std::optional<Saddle>& saddle) {
  const double least = ring(2, 0.01).least, wall = energy(2, {0, 1e-6});
  const bool holds = saddle && saddle->curvature.xx < 0 && saddle->curvature.yy > 0 && least > 0 && wall > 1e3;
  std::string found = "no stationary point on the axis";
  if (saddle) {
    found = "a saddle at (0, " + digits(saddle->at.y, 5) + "), apex angle " + digits(apex_degrees(saddle->at), 4) +
            "°; positive around a collapsed edge (" + digits(least, 2) + " at 0.01), +∞ towards the rest of it";
  }
  return {"3",
          "The contours of E_F^2 are like those of E_F^1",
          "qualitatively similar",
          found,
          holds,
          "the same searches as for ★1: axis, half circles, approach to the edge"};
}

Picture contours(int star, const std::optional<Saddle>& saddle, std::size_t per_unit) {
  const std::array<std::vector<double>, 3> levels = {
      std::vector<double>{-8, -4, -2, -1, -0.5, -0.2, 0, 0.2, 0.5, 1, 1.5, 2},
      {0.1, 0.2, 0.3, 0.4, 0.6, 0.8, 1, 1.5, 2, 3, 5, 8},
      {0.05, 0.1, 0.2, 0.3, 0.4, 0.6, 1, 2, 4, 8}};
  PositionLandscape landscape;
  landscape.title = "E_{F}, ★" + std::to_string(star);
  landscape.per_unit = per_unit;
  landscape.levels = levels[static_cast<std::size_t>(star)];
  if (star != 0 && saddle) {
    landscape.levels.push_back(saddle->energy);
    std::sort(landscape.levels.begin(), landscape.levels.end());
    landscape.overlays = {{.points = {saddle->at}, .line = false, .label = "saddle"}};
  }
  const std::array<std::string, 3> captions = {
      "★0: no saddle; E_F rises with y, is negative near the edge and falls without bound towards its middle.",
      "★1: zero at both fixed vertices, a saddle between them at the triangle with an angle of 120°, a wall at the "
      "edge.",
      "★2: like ★1; its saddle is the right-angled triangle."};
  return {"fig03_star" + std::to_string(star), position_contours(paper_model(EnergyKind::F, star), landscape),
          captions[static_cast<std::size_t>(star)]};
}

}  // namespace

Page make(Effort effort) {
  const bool full = effort == Effort::full;
  const std::array<std::optional<Saddle>, 3> saddles = {axis_minimum(0), axis_minimum(1), axis_minimum(2)};
  Page page;
  for (const int star : {0, 1, 2}) {
    page.pictures.push_back(contours(star, saddles[static_cast<std::size_t>(star)], full ? 50 : 16));
  }
  page.claims = {zero_at_collapse(),
                 collapse_is_minimum(),
                 saddle_claim(saddles[1]),
                 not_equilateral(),
                 walls(),
                 negative_star0(),
                 rising_star0(full ? 40 : 10),
                 middle_of_edge(),
                 not_convex(full ? 20000 : 2000),
                 star2_alike(saddles[2])};
  return page;
}

}  // namespace temper::gallery::fig03
