// Figure 6: the hard barrier of one edge over (d, h), and the propositions of §4 about it.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "experiments/edge_energy.hpp"
#include "experiments/minimize.hpp"
#include "experiments/numbers.hpp"
#include "experiments/single_triangle.hpp"
#include "experiments/text.hpp"
#include "figures.hpp"
#include "temper/detail/geometry.hpp"

namespace temper::gallery::fig06 {
namespace {

constexpr double kHalfDigits = 1e-6;  // where a minimum is known to: about the root of a double's 1e-16, with a margin
constexpr double kRounding = 1e-9;    // of values

const EdgeEnergy kHard{EnergyKind::BH, 1, 0};

Claim least_value(std::size_t starts) {
  const MultiStart m = multi_start(kHard, 0, 3, starts);
  const double off = length(m.best - Vec2{0.5, 0.5});
  return {"6",
          "E_BH^1 of an edge is at least its value at d = h = ℓ/2, the only minimum",
          "≥ 4, at (ℓ/2, ℓ/2), unique",
          digits(starts) + " searches from random points ended at (" + digits(m.best.x, 6) + ", " +
              digits(m.best.y, 6) + ") ℓ, the farthest " + digits(m.spread, 1) +
              " ℓ away, with E = " + digits(m.value, 8),
          off < kHalfDigits && m.spread < kHalfDigits && m.rise < kRounding,
          "simplex searches on (0, ℓ) × (0, 3 ℓ), without derivatives"};
}

Claim factor() {
  const double here = kHard(0.5, 0.5);
  const Consistency c = consistency(EnergyKind::BH, 5000);
  return {"6",
          "The least E_BH^1 of an edge is 4 (eq. 11 leaves out the factor 1/3 of ★1)",
          "4",
          digits(3 * here, 10) + " in the paper's unit, " + digits(here, 10) + " = 4/3 with α = β = 1/3 kept",
          std::abs(3 * here - 4) < kRounding && c.worst < kRounding && c.triangles > 100,
          "three edge energies sum to the triangle's to " + digits(c.worst, 1) + " in " + digits(c.triangles) +
              " random triangles"};
}

Claim walls() {
  bool holds = true;
  std::array<double, 4> far = {1e300, 1e300, 1e300, 1e300};
  for (int k = 1; k < 20; ++k) {
    const double t = k / 20.0;
    const std::array<std::array<double, 2>, 4> pairs = {std::array<double, 2>{kHard(t, 1e-3), kHard(t, 1e-7)},
                                                        {kHard(1e-3, t), kHard(1e-7, t)},
                                                        {kHard(1 - 1e-3, t), kHard(1 - 1e-7, t)},
                                                        {kHard(t, 1e3), kHard(t, 1e7)}};
    for (std::size_t wall = 0; wall < 4; ++wall) {
      holds = holds && pairs[wall][1] > 50 * pairs[wall][0];
      far[wall] = std::min(far[wall], pairs[wall][1]);
    }
  }
  return {"6",
          "E_BH is a barrier: +∞ at h → 0, d → 0, d → ℓ and h/ℓ → ∞",
          "condition (1) of a barrier",
          "least values at h = 1e−7, d = 1e−7, ℓ − d = 1e−7 and h = 1e7: " + digits(far[0], 2) + ", " +
              digits(far[1], 2) + ", " + digits(far[2], 2) + ", " + digits(far[3], 2),
          holds,
          "19 places along each side of the domain, 1e4 nearer to it multiplies E by at least 50"};
}

Claim scale_free() {
  double worst = 0;
  for (const double scale : {1e-6, 0.3, 7.0, 1e6}) {
    const EdgeEnergy scaled{EnergyKind::BH, scale, 0};
    for (int k = 1; k < 20; ++k)
      worst = std::max(worst, std::abs(scaled(scale * k / 20, scale * 0.4) / kHard(k / 20.0, 0.4) - 1));
  }
  return {"6",
          "E_BH does not depend on scale",
          "invariant to scaling",
          "largest relative change over scales 1e−6 to 1e6: " + digits(worst, 1),
          worst < kRounding,
          "19 points at 4 scales"};
}

Claim not_convex(const ConvexityTest& test) {
  const Vec2 at = test.a + test.at * (test.b - test.a);
  return {"6",
          "E_BH^1 is not a convex function of (d, h)",
          "counter-examples exist (not printed)",
          "from (" + digits(test.a.x) + ", " + digits(test.a.y) + ") to (" + digits(test.b.x) + ", " +
              digits(test.b.y) + ") ℓ: E = " + digits(kHard(at)) + " at " + digits(test.at, 3) +
              " of the way, above the chord by " + digits(100 * test.worst_convex, 3) + " % of the larger end",
          test.worst_convex > kRounding,
          "the worst of " + digits(test.segments) + " random segments"};
}

Claim quasi_convex(const std::string& name, const ConvexityTest& test, const std::string& paper) {
  const bool holds = test.worst_quasi <= kRounding;
  return {"6",
          name + " is a quasi-convex function of (d, h)",
          paper,
          holds ? "on none of " + digits(test.segments) +
                      " random segments a point above the larger end; the closest "
                      "stays " +
                      digits(-test.worst_quasi, 2) + " of it below"
                : "a point of a segment exceeds the larger end by " + digits(test.worst_quasi, 2) + " of it",
          holds,
          "both ends random in the domain up to h = 3 ℓ, one random point on each segment"};
}

// The proof's step (13): B(d, h) = h χ(d) concave. A segment whose middle lies below its chord.
Claim proof_step(std::size_t tries) {
  const auto b_of = [](Vec2 p) { return p.y * std::sqrt(p.x * (1 - p.x)); };
  Random uniform(3);
  double worst = 0, root_worst = 0;
  Vec2 worst_p, worst_q;
  std::size_t indefinite = 0;
  for (std::size_t k = 0; k < tries; ++k) {
    const Vec2 p = {uniform(0, 1), uniform(0, 2)}, q = {uniform(0, 1), uniform(0, 2)}, m = 0.5 * (p + q);
    const double below = (b_of(p) + b_of(q)) / 2 - b_of(m);
    if (below > worst) worst = below, worst_p = p, worst_q = q;
    root_worst = std::max(root_worst, (std::sqrt(b_of(p)) + std::sqrt(b_of(q))) / 2 - std::sqrt(b_of(m)));
    // The paper's Hessian has B_hh = 0, so its determinant is −B_dh², B_dh = (1 − 2d)/(2χ).
    indefinite += 1 - 2 * p.x != 0;
  }
  return {"6",
          "The proof of quasi-convexity: B(d, h) = h χ(d) is concave, as its Hessian is negative semi-definite",
          "the determinant is negative, so the Hessian is negative semi-definite",
          "not concave: the mean of B at (" + digits(worst_p.x) + ", " + digits(worst_p.y) + ") and (" +
              digits(worst_q.x) + ", " + digits(worst_q.y) + ") ℓ exceeds B in the middle by " + digits(worst, 3) +
              " ℓ²",
          worst <= kRounding,
          "midpoints of " + digits(tries) + " random segments. A negative determinant, found at " + digits(indefinite) +
              " of the ends, makes a Hessian indefinite. The proposition still holds: √B, a geometric mean, is concave "
              "(largest violation in the same segments: " +
              digits(std::max(root_worst, 0.0), 1) +
              ") and √T is a norm of affine functions, so convex; E is the square of √T/√B"};
}

Claim shifted_minimizer(std::size_t starts) {
  double worst = 0;
  bool inside = true;
  std::string found;
  for (const double shift : {0.05, 0.15, 0.5, 2.0}) {
    const MultiStart m = multi_start({EnergyKind::BHs, 1, shift}, -shift, 3, starts);
    const double h = -shift + std::sqrt(shift * shift + 0.25);
    worst = std::max({worst, length(m.best - Vec2{0.5, h}), m.spread});
    inside = inside && m.best.y > -shift;
    found += (found.empty() ? "" : ", ") + digits(m.best.y, 5) + " (formula " + digits(h, 5) + ") at h° = −" +
             digits(shift, 2);
  }
  return {"6",
          "E_BHs has its minimum at d = ℓ/2, h = h° + √(h°² + ℓ²/4)",
          "the formula, inside the domain",
          "h/ℓ = " + found,
          worst < kHalfDigits && inside,
          digits(starts) + " random starts for each; all ended within " + digits(worst, 1) + " ℓ of the formula"};
}

// Eqs. 15 and 16 against geometry.hpp, and the weights that minimize the energy of one edge.
struct WeightFormulas {
  double equation = 0;  // worst difference of eqs. 15 and 16, of ℓ
  double minimum = 0;   // worst distance of (d, h) from (ℓ/2, ℓ/2), of ℓ
  std::size_t triangles = 0;
};
WeightFormulas check_weights(std::size_t tries) {
  Random uniform(9);
  WeightFormulas result;
  for (std::size_t n = 0; n < tries; ++n) {
    std::array<Vec2, 3> p;
    for (Vec2& v : p) v = {uniform(-1, 1), uniform(-1, 1)};
    if (doubled_area(p[0], p[1], p[2]) < 0.2) continue;
    const double l = length(p[1] - p[0]);
    const auto cot = [&](int a, int b, int c) { return 1 / std::tan(corner_angle(p[a], p[b], p[c])); };
    const double ci = cot(0, 1, 2), cj = cot(1, 2, 0), ck = cot(2, 0, 1);
    const auto dh = [&](double wi, double wj, double wk) {
      const WeightedPoint i{p[0].x, p[0].y, wi}, j{p[1].x, p[1].y, wj}, k{p[2].x, p[2].y, wk};
      return Vec2{dual_crossing(i, j), signed_height(i, j, k)};
    };
    const double wi = uniform(-1, 1), wj = uniform(-1, 1), wk = uniform(-1, 1);
    const Vec2 formula = {l / 2 + (wi - wj) / (2 * l),
                          l * ck / 2 + ci * (wj - wk) / (2 * l) + cj * (wi - wk) / (2 * l)};
    result.equation = std::max(result.equation, length(formula - dh(wi, wj, wk)) / l);
    const double best = (1 - ck) / (ci + cj) * l * l;
    result.minimum = std::max(result.minimum, length(dh(best, best, 0) - Vec2{l / 2, l / 2}) / l);
    ++result.triangles;
  }
  return result;
}

Claim equations(const WeightFormulas& w) {
  return {"6",
          "Eqs. 15 and 16 give d and h from weight differences and the angles' cotangents",
          "eqs. 15, 16",
          "differ from d and h of the triangle by at most " + digits(w.equation, 1) + " ℓ",
          w.equation < kRounding && w.triangles > 50,
          digits(w.triangles) + " random triangles with random weights, against orthocenters"};
}

Claim best_weights(const WeightFormulas& w) {
  return {"6",
          "E_BH of an edge is least at w_ik = w_jk = (1 − cot Θk)/(cot Θi + cot Θj) ℓ²",
          "unique; gives d = h = ℓ/2",
          "those weights put (d, h) within " + digits(w.minimum, 1) + " ℓ of (ℓ/2, ℓ/2)",
          w.minimum < kRounding && w.triangles > 50,
          digits(w.triangles) + " random triangles"};
}

/// Random segments between two points at which a function is finite: those with a point above both ends, and those with
/// one above the chord.
struct Segments {
  std::size_t all = 0, above_ends = 0, above_chord = 0;
  [[nodiscard]] std::string text() const {
    return digits(above_ends) + " of " + digits(all) + " segments have a point above both ends, " +
           digits(above_chord) + " one above the chord";
  }
};
constexpr std::size_t kPlaces = 64;  // of a segment that are looked at
/// make(random) gives a function of t in [0, 1].
template <class Make>
Segments sample_segments(std::uint64_t seed, std::size_t count, Make&& make) {
  constexpr double kMost = 1e4;  // at a wall h and d have lost their digits
  Random random(seed);
  Segments s;
  while (s.all < count) {
    const auto f = make(random);
    const double a = f(0.0), b = f(1.0);
    if (!(std::max(a, b) < kMost)) continue;
    const double t = random(0, 1), between = f(t), larger = std::max(a, b);
    ++s.all;
    s.above_ends += between > larger * (1 + kRounding);
    s.above_chord += between > a + t * (b - a) + larger * kRounding;
  }
  return s;
}

Corners between(const Corners& p, const Corners& q, double t) {
  Corners r = p;
  for (std::size_t i = 0; i < r.size(); ++i) {
    r[i] = {p[i].x + t * (q[i].x - p[i].x), p[i].y + t * (q[i].y - p[i].y), p[i].w + t * (q[i].w - p[i].w)};
  }
  return r;
}
Corners with_weights(Corners p, Random& random) {
  for (WeightedPoint& v : p) v.w = random(-1, 1);
  return p;
}

Claim quasi_convex_in_weights(std::size_t count) {
  const Segments s = sample_segments(61, count, [](Random& random) {
    const Corners p = random_triangle(random, 0), a = with_weights(p, random), b = with_weights(p, random);
    return [=](double t) {
      const Corners c = between(a, b, t);
      const EdgeEnergy e{EnergyKind::BH, length(c[1].position() - c[0].position()), 0};
      return e(dual_crossing(c[0], c[1]), signed_height(c[0], c[1], c[2]));
    };
  });
  return {"4 Quasi-convexity for Weights",
          "E_BH^1 of an edge is a quasi-convex function of the three weights",
          "level sets convex",
          s.text(),
          s.above_ends == 0,
          "segments between random weights of random triangles, one random point on each"};
}

Claim triangle_in_weights(std::size_t count) {
  const EnergyModel hard = paper_model(EnergyKind::BH);
  const Segments s = sample_segments(62, count, [&](Random& random) {
    const Corners p = random_triangle(random, 0), a = with_weights(p, random), b = with_weights(p, random);
    return [=](double t) {
      const Corners c = between(a, b, t);
      return triangle_energy(hard, c[0], c[1], c[2]);
    };
  });
  return {
      "7 Further Exploration",
      "E_BH^1 of a whole triangle is quasi-convex in its weights, too",
      "“needs to be extended”",
      s.text(),
      s.above_ends == 0,
      "the sum over three edges, segments as for one; a sample and no proof: sums of quasi-convex functions need not "
      "be so",
      Author::temper};
}

/// E_BH^1 of a triangle, of which corners from `first` on move; where `stays_acute`, only on segments along which it is
/// finite.
Segments segments_of_positions(std::uint64_t seed, std::size_t count, std::size_t first, bool stays_acute) {
  const EnergyModel hard = paper_model(EnergyKind::BH);
  return sample_segments(seed, count, [&](Random& random) {
    const Corners a = random_triangle(random, 0);
    Corners b = a;
    for (std::size_t i = first; i < b.size(); ++i) b[i] = {random(-1, 1), random(-1, 1), 0};
    const auto energy = [=](double t) {
      const Corners c = between(a, b, t);
      return triangle_energy(hard, c[0], c[1], c[2]);
    };
    bool finite = true;
    for (std::size_t i = 0; i <= kPlaces && stays_acute && finite; ++i)
      finite = std::isfinite(energy(static_cast<double>(i) / kPlaces));
    return [=](double t) { return finite ? energy(t) : std::numeric_limits<double>::infinity(); };
  });
}

Claim triangle_in_all_positions(std::size_t count) {
  const Segments one = segments_of_positions(64, count, 2, true), all = segments_of_positions(65, count, 0, true);
  return {"7 Further Exploration",
          "Where the triangle stays acute all along, E_BH^1 is quasi-convex in the positions of its vertices",
          "“investigate the convexity (or lack thereof)”",
          "one vertex: " + one.text() + "; all three: " + all.text(),
          one.above_ends + all.above_ends == 0,
          "segments between random acute triangles, finite at " + digits(kPlaces + 1) + " places of each",
          Author::temper};
}

Claim triangle_in_positions(std::size_t count) {
  const Segments one = segments_of_positions(63, count, 2, false);
  return {
      "7 Further Exploration",
      "E_BH^1 is quasi-convex in the position of a vertex",
      "“investigate the convexity (or lack thereof)”",
      one.text(),
      one.above_ends == 0,
      "one vertex of random acute triangles moves to another place where the triangle is acute. Between the two it may "
      "be obtuse, and E_BH infinite: the acute triangles over an edge are no convex set",
      Author::temper};
}

}  // namespace

Page make(Effort effort) {
  const bool full = effort == Effort::full;
  const std::size_t segments = full ? 400000 : 20000, starts = full ? 200 : 20;
  const ConvexityTest hard = sample_convexity(kHard, 0, 3, segments);
  const ConvexityTest shifted = sample_convexity({EnergyKind::BHs, 1, 0.3}, -0.3, 3, segments);
  const WeightFormulas weights = check_weights(full ? 20000 : 1000);
  EdgeLandscape landscape;
  landscape.title = "E_{BH} of an edge, ★1";
  landscape.h_low = 0;
  landscape.h_high = 1.5;
  landscape.samples = full ? 161 : 61;
  landscape.levels = {1.34, 1.4, 1.5, 1.6, 1.8, 2, 2.5, 3, 4, 6, 10};
  landscape.minimum = {0.5, 0.5};
  Page page;
  page.pictures = {
      {"fig06", edge_contours(kHard, landscape),
       "E_BH of an edge over (d, h), with the factor 1/3 of ★1: one minimum, 4/3 at d = h = ℓ/2, and walls at "
       "h = 0, d = 0 and d = ℓ. Each set below a level is convex, the function is not."}};
  page.claims = {least_value(starts),
                 factor(),
                 walls(),
                 scale_free(),
                 not_convex(hard),
                 quasi_convex("E_BH^1", hard, "Proposition: quasi-convex"),
                 proof_step(full ? 200000 : 20000),
                 shifted_minimizer(full ? 60 : 10),
                 quasi_convex("E_BHs^1", shifted, "established to be quasi-convex"),
                 equations(weights),
                 best_weights(weights),
                 quasi_convex_in_weights(full ? 50000 : 2000),
                 triangle_in_weights(full ? 50000 : 2000),
                 triangle_in_positions(full ? 50000 : 2000),
                 triangle_in_all_positions(full ? 20000 : 1000)};
  return page;
}

}  // namespace temper::gallery::fig06
