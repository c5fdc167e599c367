// The face opposite the free vertex p is equilateral with sides of 2, and its corners have no weights. The pictures are
// slices in the plane of symmetry x = 0, in which the face is a segment:
//
//        z
//        |     p
//        |   .  ·
//        |.       ·
//    ----m---------s---- y      m = (q + r)/2,  q = (−1, 0, 0),  r = (1, 0, 0),  s = (0, √3, 0)
#include "fig08/tetrahedron.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "experiments/minimize.hpp"
#include "experiments/text.hpp"
#include "plot/plot.hpp"
#include "temper/tets/geometry.hpp"
#include "temper/tets/optimize.hpp"
#include "temper/tets/quality.hpp"

namespace temper::gallery::fig08 {
namespace {

using Corners = std::array<tets::WeightedPoint, 4>;

constexpr double kGamma = 1, kLastGamma = 0.003;  // of the first and of the last sweep of a run
constexpr double kRoot3 = std::numbers::sqrt3;
const Vec2 kRegular = {1 / kRoot3, std::sqrt(8.0 / 3)};  // the vertex of the regular tetrahedron, in the slice
constexpr double kHalfDigits = 1e-6;                     // where a minimum is known to, of a side of 2

/// p is a place in the slice.
Corners with_vertex(Vec2 p, double weight) {
  return {tets::WeightedPoint{-1, 0, 0, 0}, {1, 0, 0, 0}, {0, kRoot3, 0, 0}, {0, p.x, p.y, weight}};
}
double energy(Vec2 p, double weight, double gamma) {
  if (!(p.y > 0)) return std::numeric_limits<double>::infinity();
  return tets::tetrahedron_energy(with_vertex(p, weight), gamma);
}
bool is_inside(Vec2 p, double weight) { return tets::tetrahedron_quality(with_vertex(p, weight)).well_centered; }
double largest_dihedral(const Corners& c) {
  double largest = 0;
  for (const auto& [i, j, k, l] :
       {std::array<std::size_t, 4>{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}}) {
    const double angle = tets::dihedral_angle(c[i].position(), c[j].position(), c[k].position(), c[l].position());
    largest = std::max(largest, angle * 180 / std::numbers::pi);
  }
  return largest;
}
Minimum2 best_position(double weight, double gamma) {
  return simplex_minimum([&](Vec2 p) { return energy(p, weight, gamma); }, {0.8, 1.4}, 0.1, 300);
}

// --- pictures ------------------------------------------------------------------------------------

constexpr PlotRange kY = {-1, 2.5}, kZ = {0, 3.5};

/// The ends of the region with the orthocenter inside, on rays from a point in it, as far as the picture goes.
std::vector<Vec2> rim_of_inside(Vec2 from, double weight, int n) {
  std::vector<Vec2> rim;
  for (int i = 0; i <= n; ++i) {
    const double t = 2 * std::numbers::pi * i / n;
    const auto at = [&](double r) { return from + r * Vec2{std::cos(t), std::sin(t)}; };
    double low = 0, high = 5;
    for (int halving = 0; halving < 40; ++halving) {
      const double middle = 0.5 * (low + high);
      (at(middle).y > 0 && is_inside(at(middle), weight) ? low : high) = middle;
    }
    rim.push_back(at(low));
  }
  return rim;
}

struct Slice {
  const char* name;
  double weight, gamma;
  std::vector<double> levels;
  const char* caption;
};
const Slice kSlices[] = {
    {"fig08_tetrahedron",
     0,
     kGamma,
     {3.81, 3.9, 4, 4.2, 4.5, 5, 6, 8, 12, 20},
     "The energy of temper optimize for a tetrahedron, γ = 1, over the free vertex in a slice, without weights. The "
     "segment below is the fixed face. The orthocenter is inside where the dashed line encloses the vertex."},
    {"fig08_tetrahedron_last",
     0,
     kLastGamma,
     {6.5, 7, 8, 10, 15, 30, 100, 1000, 1e4, 1e5},
     "With the last γ of a run, 0.003, the energy has a wall at the dashed line."},
    {"fig08_tetrahedron_weight",
     1,
     kGamma,
     {3.81, 3.9, 4, 4.2, 4.5, 5, 6, 8, 12, 20},
     "The free vertex has the weight 1, a quarter of a squared side. The region with the orthocenter inside is "
     "another, "
     "but the minimum has hardly moved."},
};

Picture picture_of(const Slice& slice, bool full) {
  constexpr double kFloor = 1e-3;
  const auto& [name, weight, gamma, levels, caption] = slice;
  ContourPlot plot;
  plot.title = "E, w = " + digits(weight, 2) + ", γ = " + digits(gamma, 2);
  plot.x_label = "y";
  plot.y_label = "z";
  plot.x_range = kY;
  plot.y_range = kZ;
  plot.nx = plot.ny = full ? 141 : 36;
  plot.levels = levels;
  const auto place = [n = plot.nx](PlotRange range, std::size_t k) {
    return range.low + (range.high - range.low) * static_cast<double>(k) / static_cast<double>(n - 1);
  };
  for (std::size_t j = 0; j < plot.ny; ++j) {
    for (std::size_t i = 0; i < plot.nx; ++i) {
      const double e = energy({place(kY, i), std::max(place(kZ, j), kFloor)}, weight, gamma);
      plot.values.push_back(std::min(e, 2 * levels.back()));
    }
  }
  plot.equal_aspect = true;
  plot.width = 400;
  const Vec2 best = best_position(weight, gamma).at;
  plot.overlays = {{.points = {{0, 0}, {kRoot3, 0}}},
                   {.points = rim_of_inside(best, weight, full ? 720 : 90), .dots = false, .dashed = true},
                   {.points = {best}, .line = false, .label = "minimum"}};
  return {name, contour_plot_svg(plot), caption};
}

// --- claims --------------------------------------------------------------------------------------

Claim ours(std::string claim, std::string paper, std::string found, bool holds, std::string why) {
  return {"8", std::move(claim), std::move(paper), std::move(found), holds, std::move(why), Author::temper};
}

Claim regular() {
  double worst = 0;
  std::string list;
  for (const double gamma : {kGamma, 0.3, 0.1, kLastGamma}) {
    const Minimum2 m = best_position(0, gamma);
    worst = std::max(worst, length(m.at - kRegular));
    list += (list.empty() ? "E = " : ", ") + digits(m.value, 4) + " at γ = " + digits(gamma, 1);
  }
  return ours(
      "A tetrahedron whose face is equilateral is best when it is regular, for every γ",
      "triangles: equilateral for E_BH alone; for E_BP the apex grows with γ",
      "within " + digits(worst, 1) + " of the regular one; " + list, worst < kHalfDigits,
      "simplex search in the slice; heights are relative to their faces, and a term for the shape is least there");
}

Claim never_collapses() {
  constexpr std::size_t kDirections = 179;
  std::size_t rising = 0;
  for (std::size_t degrees = 1; degrees <= kDirections; ++degrees) {
    const double t = static_cast<double>(degrees) * std::numbers::pi / 180;
    const auto at = [&](double r) { return energy(Vec2{kRoot3, 0} + r * Vec2{std::cos(t), std::sin(t)}, 0, kGamma); };
    rising += at(1e-3) > at(0.1);
  }
  return ours("The energy grows where the free vertex meets a fixed one, from every direction",
              "triangles: E_F and E_T fall there",
              "from " + digits(rising) + " of " + digits(kDirections) + " directions", rising == kDirections,
              "E 0.1 and 0.001 from the vertex s, directions in the slice 1° apart");
}

/// Counts over positions of the free vertex in the slice.
struct Counts {
  std::size_t all = 0, finite = 0, inside = 0, acute_and_outside = 0, inside_and_obtuse = 0, with_a_weight = 0;
};

/// Says whether some weight of the free vertex brings the orthocenter inside: all heights are linear in it.
bool has_weight(Vec2 p) {
  double low = -std::numeric_limits<double>::infinity(), high = -low;
  const Corners none = with_vertex(p, 0), one = with_vertex(p, 1);
  for (const auto& [i, j, k, l] : {std::array<std::size_t, 4>{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}}) {
    const double h = tets::signed_height(none[i], none[j], none[k], none[l]);
    const double slope = tets::signed_height(one[i], one[j], one[k], one[l]) - h;
    if (slope > 0) low = std::max(low, -h / slope);
    if (slope < 0) high = std::min(high, -h / slope);
    if (slope == 0 && h <= 0) return false;
  }
  return low < high;
}

Counts count(bool full) {
  Counts n;
  const int steps = full ? 100 : 25;
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < steps; ++j) {
      const auto part = [&](PlotRange r, int k) { return r.low + (r.high - r.low) * (k + 0.37) / steps; };
      const Vec2 p = {part(kY, i), part(kZ, j)};
      const bool inside = is_inside(p, 0), acute = largest_dihedral(with_vertex(p, 0)) < 90;
      ++n.all;
      n.finite += std::isfinite(energy(p, 0, kLastGamma));
      n.inside += inside;
      n.acute_and_outside += acute && !inside;
      n.inside_and_obtuse += inside && !acute;
      n.with_a_weight += has_weight(p);
    }
  }
  return n;
}

}  // namespace

void add_tetrahedron(Page& page, bool full) {
  for (const Slice& slice : kSlices) page.pictures.push_back(picture_of(slice, full));
  Table table{
      .caption = "The best free vertex of a tetrahedron over an equilateral face with sides of 2, for weights w",
      .header = {"w", "y", "z", "E"},
      .rows = {}};
  for (const double weight : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
    const Minimum2 m = best_position(weight, kGamma);
    table.rows.push_back({digits(weight, 2), digits(m.at.x, 5), digits(m.at.y, 5), digits(m.value, 5)});
  }
  page.tables.push_back(table);
  const Counts n = count(full);
  const std::string positions = digits(n.all) + " positions in the slice";
  page.claims.push_back(regular());
  page.claims.push_back(never_collapses());
  page.claims.push_back(ours("The energy has a value at every positive tetrahedron", "triangles: E_BP, but not E_BH",
                             "at " + digits(n.finite) + " of " + positions, n.finite == n.all, "γ = 0.003"));
  page.claims.push_back(ours("Acute dihedral angles are neither enough for an orthocenter inside, nor needed",
                             "triangles: acute ones are those with the circumcenter inside",
                             "inside at " + digits(n.inside) + ", of which " + digits(n.inside_and_obtuse) +
                                 " have an angle of 90° or more; outside and acute at " + digits(n.acute_and_outside),
                             n.inside_and_obtuse > 0 && n.acute_and_outside > 0, positions + ", no weights"));
  page.claims.push_back(
      ours("With the right weight of the free vertex the orthocenter is inside, wherever the vertex is",
           "triangles: the same", "at " + digits(n.with_a_weight) + " of " + positions, n.with_a_weight == n.all,
           "the orthocenter moves along the line through the center of the face, perpendicular to it"));
}

}  // namespace temper::gallery::fig08
