// Figure 1: the distances in a triangle and its dual (§2.1), and what they say of a triangulation.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "experiments/hodge_error.hpp"
#include "experiments/labeled_triangle.hpp"
#include "experiments/single_triangle.hpp"
#include "experiments/text.hpp"
#include "figures.hpp"
#include "temper/detail/geometry.hpp"

namespace temper::gallery::fig01 {
namespace {

constexpr double kWeight = 0.3;      // of random triangles, whose edges are of length 1
constexpr double kRounding = 1e-10;  // of a few operations on them: areas are at least 0.05

/// The three edges of a triangle, each with the vertex across.
struct Edge {
  WeightedPoint i, j, k;
  [[nodiscard]] Vec2 along() const {
    const Vec2 e = j.position() - i.position();
    return (1 / length(e)) * e;
  }
};
std::array<Edge, 3> edges_of(const Corners& p) {
  return {Edge{p[0], p[1], p[2]}, Edge{p[1], p[2], p[0]}, Edge{p[2], p[0], p[1]}};
}

double power(const WeightedPoint& p, Vec2 x) { return squared_length(p.position() - x) - p.w; }

Claim equal_power(std::size_t tries) {
  Random random(101);
  double worst = 0;
  for (std::size_t n = 0; n < tries; ++n) {
    const Corners p = random_triangle(random, kWeight);
    const Vec2 o = orthocenter(p[0], p[1], p[2]);
    const auto [least, greatest] = std::minmax({power(p[0], o), power(p[1], o), power(p[2], o)});
    worst = std::max(worst, (greatest - least) / (1 + squared_length(o)));
  }
  return {"1",
          "The orthocenter has one weighted distance to all three vertices",
          "identical",
          "D² differs by at most " + digits(worst, 1) + " of 1 + |o|²",
          worst < kRounding,
          digits(tries) + " random weighted triangles, D² = |p − o|² − w"};
}

Claim midpoints(std::size_t tries) {
  Random random(102);
  double worst = 0;
  std::size_t wrong_side = 0;
  for (std::size_t n = 0; n < tries; ++n) {
    const Corners p = random_triangle(random, kWeight);
    const Vec2 o = orthocenter(p[0], p[1], p[2]);
    for (const Edge& e : edges_of(p)) {
      const double along = dot(o - e.i.position(), e.along()), up = cross(e.along(), o - e.i.position());
      const double h = signed_height(e.i, e.j, e.k), scale = 1 + length(o);
      worst = std::max(
          {worst, std::abs(along - dual_crossing(e.i, e.j)) / scale, std::abs(std::abs(up) - std::abs(h)) / scale});
      const double side = up * cross(e.along(), e.k.position() - e.i.position());  // o and p_k on one side
      if (std::abs(h) > kRounding && (side > 0) != (h > 0)) ++wrong_side;
    }
  }
  return {"1",
          "d = ℓ/2 + (w_i − w_j)/(2ℓ) is where the point of the edge's line that is closest to o stands, and |h| its "
          "distance from o, positive on the side of the third vertex",
          "d_ij, |h_k|, h_k > 0 on p_k's side",
          "from projecting o onto the lines d and |h| differ by at most " + digits(worst, 1) +
              "; h has the other sign at " + digits(wrong_side) + " of " + digits(3 * tries) + " edges",
          worst < kRounding && wrong_side == 0,
          digits(tries) + " random weighted triangles"};
}

Claim one_negative_crossing(std::size_t tries) {
  Random random(103);
  std::size_t one = 0, both = 0;
  double worst = 0;
  for (std::size_t n = 0; n < tries; ++n) {
    for (const Edge& e : edges_of(random_triangle(random, 2))) {
      const double d = dual_crossing(e.i, e.j), back = dual_crossing(e.j, e.i),
                   l = length(e.j.position() - e.i.position());
      worst = std::max(worst, std::abs(d + back - l) / (std::abs(d) + std::abs(back)));
      one += (d < 0) != (back < 0);
      both += d < 0 && back < 0;
    }
  }
  return {"1",
          "d_ij + d_ji = ℓ, so that at most one of the two is negative",
          "at most one",
          "of " + digits(3 * tries) + " edges one is negative at " + digits(one) + ", both at " + digits(both) +
              "; the sum differs from ℓ by at most " + digits(worst, 1),
          worst < kRounding && both == 0 && one > 0,
          "random triangles with weights up to twice the square of half their width"};
}

/// The parts of random triangles in which a little more weight at p_i moves m_ij, and o, away from p_i.
struct Push {
  std::size_t triangles = 0, midpoint = 0, center = 0, as_expected = 0;
};
Push push(std::size_t tries) {
  constexpr double kMore = 1e-4;
  Random random(104);
  Push result{tries};
  for (std::size_t n = 0; n < tries; ++n) {
    Corners p = random_triangle(random, 0);
    const auto distance = [&] { return length(orthocenter(p[0], p[1], p[2]) - p[0].position()); };
    const double d = dual_crossing(p[0], p[1]), from_center = distance();
    p[0].w = kMore;
    result.midpoint += dual_crossing(p[0], p[1]) > d;
    const bool farther = distance() > from_center;
    result.center += farther;
    const double j = corner_angle(p[1].position(), p[2].position(), p[0].position()),
                 k = corner_angle(p[2].position(), p[0].position(), p[1].position());
    result.as_expected += farther == (std::abs(j - k) < std::numbers::pi / 2);
  }
  return result;
}

Claim weight_pushes(std::size_t tries) {
  const Push p = push(tries);
  return {"2.1",
          "A positive weight pushes the midpoint and the orthocenter farther away",
          "“push” both farther away",
          "midpoint farther in " + digits(p.midpoint) + " of " + digits(p.triangles) + " triangles, orthocenter in " +
              digits(p.center),
          p.midpoint == p.triangles && p.center == p.triangles,
          "a little weight on one vertex of random unweighted triangles. The orthocenter moves at right angles to the "
          "opposite edge, towards it; it gets farther from the vertex exactly when the other two angles differ by less "
          "than 90° (true of " +
              digits(p.as_expected) + " of " + digits(p.triangles) + ")"};
}

Claim dual_length(std::size_t tries) {
  Random random(105);
  double worst = 0;
  std::size_t wrong = 0, negative = 0, n = 0;
  while (n < tries) {
    const Corners p = random_triangle(random, kWeight);
    const WeightedPoint l = {random(-1, 1), random(-1, 1), random(-kWeight, kWeight)};
    if (doubled_area(p[1].position(), p[0].position(), l.position()) < 0.1) continue;
    ++n;
    const double dual = signed_height(p[0], p[1], p[2]) + signed_height(p[1], p[0], l);
    const double apart = length(orthocenter(p[0], p[1], p[2]) - orthocenter(p[1], p[0], l));
    worst = std::max(worst, std::abs(std::abs(dual) - apart) / (1 + apart));
    const Sign conflict = power_test(p[0], p[1], p[2], l);
    negative += dual < 0;
    wrong += std::abs(dual) > kRounding && (dual < 0) != (conflict == Sign::positive);
  }
  return {"2.1",
          "The dual of edge ij has length h_k + h_l; where that is negative the triangulation is not regular",
          "negative: to be flipped",
          "|h_k + h_l| differs from the distance of the two orthocenters by at most " + digits(worst, 1) +
              "; it is negative at " + digits(negative) + " of " + digits(tries) +
              " edges, and its sign contradicts the exact power test at " + digits(wrong),
          worst < kRounding && wrong == 0 && negative > 0 && negative < tries,
          "random pairs of triangles at one edge; power_test is exact"};
}

/// A fan of triangles around (0, 0) that winds around it twice.
std::vector<Corners> double_fan() {
  constexpr int kTriangles = 9;
  std::vector<Corners> fan;
  const auto rim = [](int i) {
    const double t = 4 * std::numbers::pi * (i % kTriangles) / kTriangles;
    return WeightedPoint{std::cos(t), std::sin(t), 0};
  };
  for (int i = 0; i < kTriangles; ++i) fan.push_back({WeightedPoint{}, rim(i), rim(i + 1)});
  return fan;
}

Claim positive_duals_not_regular() {
  const std::vector<Corners> fan = double_fan();
  double least_dual = 1e300, area = 0;
  std::size_t conflicts = 0;
  for (std::size_t i = 0; i < fan.size(); ++i) {
    const Corners &here = fan[i], &next = fan[(i + 1) % fan.size()];
    least_dual = std::min({least_dual, signed_height(here[1], here[2], here[0]),
                           signed_height(here[2], here[0], here[1]) + signed_height(next[0], next[1], next[2])});
    area += doubled_area(here[0].position(), here[1].position(), here[2].position()) / 2;
    conflicts += std::ranges::any_of(
        fan, [&](const Corners& other) { return power_test(here[0], here[1], here[2], other[1]) == Sign::positive; });
  }
  const double hull = 9 * std::sin(2 * std::numbers::pi / 9) / 2;
  return {"2.1",
          "A triangulation can have positive dual lengths everywhere and not be regular",
          "inside-out or overlapping triangles",
          "nine triangles that wind twice around a point: least dual length " + digits(least_dual, 3) + ", area " +
              digits(area, 3) + " over a polygon of " + digits(hull, 3) + "; " + digits(conflicts) +
              " of 9 have another vertex in their orthocircle",
          least_dual > 0 && area > 1.5 * hull && conflicts == fan.size(),
          "corners of a regular nonagon, each joined to the next but one and to the middle; conflicts by exact power "
          "tests"};
}

Claim definition_is_formula(const std::vector<Mesh>& meshes) {
  bool holds = true;
  std::string found, counts;
  for (const int star : {0, 1, 2}) {
    const StarComparison c = compare_definition(meshes, star);
    holds = holds && c.simplices > 0 && c.worst < kRounding && c.coupling < kRounding;
    found += (star > 0 ? ", ★" : "★") + std::to_string(star) + " " + digits(c.worst, 1);
    counts += (star > 0 ? ", " : "") + digits(c.simplices);
    if (star == 1) found += " (over couplings " + digits(c.coupling, 1) + ")";
  }
  return {"2.2",
          "Eq. 1, transport of a simplex to its dual, is eq. 2 with (α, β) = (1/4, 1/12), (1/3, 1/3), (1/12, 1/4)",
          "reduces to eq. 2",
          "differ at an inner simplex by at most, relative: " + found,
          holds && meshes.size() == kWeightedMeshes,
          digits(meshes.size()) + " regular weighted meshes, " + counts +
              " vertices, edges and triangles; costs by quadrature over the power cells, dual edges and triangles "
              "themselves. An edge and its dual are at right angles, so that every way to move one to the other costs "
              "the same: parts spread evenly, in order, or in reverse"};
}

Claim energy_bounds_error(const std::vector<Mesh>& meshes, std::size_t densities) {
  bool holds = true;
  std::string found;
  for (const int star : {0, 1, 2}) {
    const ErrorBound b = error_over_bound(meshes, star, densities);
    holds = holds && b.cases > 0 && b.worst <= 1 && b.worst > 0.01;
    found += (star > 0 ? ", ★" : "★") + std::to_string(star) + " " + digits(b.least, 2) + " to " + digits(b.worst, 2);
  }
  return {
      "2.2",
      "HOT is an upper bound on the error of the diagonal Hodge star",
      "upper bound",
      "squared error over HOT: " + found,
      holds && meshes.size() == kWeightedMeshes,
      digits(densities) +
          " random waves of slope at most 1 on each of the same meshes; Σ |*σ| |σ| (mean on σ − mean on *σ)², "
          "simplices inside the domain; of 1-forms what the direction of the edge sees. A ratio above 1 would refute, "
          "one below 0.01 everywhere would make the bound idle"};
}

}  // namespace

Page make(Effort effort) {
  const std::vector<Mesh> meshes = weighted_meshes(effort);
  const std::size_t tries = effort == Effort::full ? 20000 : 2000;
  const LabeledTriangle drawing = {.corners = {WeightedPoint{0, 0, 0.5}, {4, 0, -0.25}, {1.5, 3.1, 0.15}}};
  return {
      {{"fig01", labeled_triangle_svg(drawing),
        "Triangle ijk, its orthocenter o and the weighted midpoints m, at distance d along the edges and h from them. "
        "Circles: radius √|w|, green positive, red dashed negative."}},
      {},
      {equal_power(tries), midpoints(tries), one_negative_crossing(tries), weight_pushes(tries), dual_length(tries),
       positive_duals_not_regular(), definition_is_formula(meshes),
       energy_bounds_error(meshes, effort == Effort::full ? 100 : 10)}};
}

}  // namespace temper::gallery::fig01
