// Figure 8: the ★1 energies over the position of one vertex, without weights (§6.1.1).
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "experiments/energies.hpp"
#include "experiments/free_vertex.hpp"
#include "experiments/minimize.hpp"
#include "experiments/single_triangle.hpp"
#include "experiments/text.hpp"
#include "fig08/tetrahedron.hpp"
#include "figures.hpp"

namespace temper::gallery::fig08 {
namespace {

constexpr double kHalfDigits = 1e-5;        // where a minimum of three energies' sum is known to, of a side of 2
constexpr double kGamma = 1, kShift = 0.3;  // of the pictures: γ and −h°

EnergyModel model(EnergyKind kind, double length_parameter) {
  EnergyModel m = paper_model(kind);
  m.gamma.value = m.h0.value = length_parameter;
  return m;
}

EnergyModel drawn_model(EnergyKind kind) { return model(kind, kind == EnergyKind::BHs ? kShift : kGamma); }

Minimum2 best_position(const EnergyModel& m, Vec2 start = {0.1, 1.5}) {
  return simplex_minimum([&](Vec2 p) { return free_vertex_energy(m, p); }, start, 0.1, 300);
}

std::string place(Vec2 p) {
  const auto part = [](double v) { return digits(std::abs(v) < kHalfDigits ? 0 : v, 5); };
  return "(" + part(p.x) + ", " + part(p.y) + ")";
}

/// One of the figure's six energies.
struct Contours {
  EnergyKind kind;
  std::vector<double> levels;
  const char* caption;
};
const Contours kContours[] = {
    {EnergyKind::F,
     {0.1, 0.2, 0.3, 0.4, 0.5132, 0.7, 1, 1.5, 2, 3, 5, 8},
     "E_F: zero where the free vertex meets a fixed one."},
    {EnergyKind::T,
     {0.1, 0.2, 0.3, 0.5, 0.7, 1, 1.5, 2, 3, 5, 8, 15},
     "E_T: like E_F, but steeper where the triangle is obtuse: |h| on all three edges."},
    {EnergyKind::dT,
     {0.1, 0.2, 0.3, 0.5, 0.7, 1, 1.5, 2, 3, 5, 8, 15},
     "E_∂T: all edges of a lone triangle are boundary edges, so it equals E_T."},
    {EnergyKind::BH,
     {4.7, 5, 5.5, 6, 7, 8, 10, 15, 30},
     "E_BH: +∞ (white) unless the triangle is acute; least at the equilateral one."},
    {EnergyKind::BHs, {3.1, 3.3, 3.6, 4, 4.5, 5, 6, 8, 12, 30}, "E_BHs with h° = −0.3: the walls are moved outwards."},
    {EnergyKind::BP,
     {3.05, 3.2, 3.5, 4, 5, 6, 8, 12, 20, 50, 200},
     "E_BP with γ = 1: finite everywhere, but very large at the edge."},
};

Picture contour_picture(const Contours& contours, bool full) {
  const EnergyInfo& info = energies()[static_cast<std::size_t>(contours.kind)];
  // Hard walls end at a sample: enough of them that the boundary of the domain is smooth.
  const bool hard_wall = info.barrier && info.kind != EnergyKind::BP;
  PositionLandscape landscape;
  landscape.title = plot_symbol(info.name) + ", ★1";
  landscape.per_unit = !full ? 14 : hard_wall ? 120 : 45;
  landscape.levels = contours.levels;
  if (info.barrier) {
    landscape.overlays = {{.points = {best_position(drawn_model(info.kind)).at}, .line = false, .label = "minimum"}};
  }
  return {"fig08_" + std::string(info.name), position_contours(drawn_model(info.kind), landscape), contours.caption};
}

/// Directions, 1° apart, from which E is less 1e−7 from the fixed vertex than 0.1 from it.
std::size_t falling_directions(const EnergyModel& energy) {
  std::size_t falling = 0;
  for (int degrees = 1; degrees < 180; ++degrees) {
    const double t = degrees * std::numbers::pi / 180;
    const auto at = [&](double r) { return free_vertex_energy(energy, kRight + r * Vec2{std::cos(t), std::sin(t)}); };
    falling += at(1e-7) < at(0.1);
  }
  return falling;
}

Claim collapsed_minima() {
  constexpr std::size_t kDirections = 179;
  bool holds = true;
  std::string found;
  for (const EnergyKind kind : {EnergyKind::F, EnergyKind::T}) {
    const EnergyModel energy = paper_model(kind);
    const std::size_t falling = falling_directions(energy);
    const auto [least, most] = half_circle(energy, 1e-7);
    holds = holds && falling == kDirections && least >= 0;
    found += std::string(found.empty() ? "E_F" : "; E_T") + " falls from " + digits(falling) + " of " +
             digits(kDirections) + " directions, to " + digits(least, 1) + " … " + digits(most, 1) + " at 1e−7";
  }
  return {"8",
          "E_F and E_T have minima where the free vertex coincides with a fixed one",
          "minima there",
          found,
          holds,
          "E 0.1 and 1e−7 from the vertex, directions 1° apart. E_F tends to 0 from every direction. E_T does so from "
          "straight "
          "above only: |h| of the long edges keeps it up elsewhere, and over the outside of the edge it grows without "
          "bound"};
}

Claim equilateral() {
  double worst = 0, value = 0;
  std::size_t starts = 0;
  Vec2 at;
  for (const double x : {-0.5, 0.0, 0.3, 0.8}) {
    for (const double y : {1.2, 1.7, 2.5}) {
      if (!std::isfinite(free_vertex_energy(paper_model(EnergyKind::BH), {x, y}))) continue;
      const Minimum2 m = best_position(paper_model(EnergyKind::BH), {x, y});
      worst = std::max(worst, length(m.at - Vec2{0, std::sqrt(3.0)}));
      at = m.at;
      value = m.value;
      ++starts;
    }
  }
  return {"8",
          "The E_BH-optimal triangle is equilateral",
          "equilateral",
          "free vertex at " + place(at) + ", within " + digits(worst, 1) + " of (0, √3), E_BH^1 = " + digits(value, 10),
          worst < kHalfDigits && starts > 3,
          digits(starts) + " simplex searches from different acute triangles"};
}

struct Apex {
  bool rising = true, isosceles = true;
  double first = 0, last = 0;
  std::string list;
};
Apex apex_by(EnergyKind kind, double times, std::size_t count) {
  Apex apex;
  double before = 0, length_parameter = 1e-3;
  for (std::size_t k = 0; k < count; ++k, length_parameter *= times) {
    const Minimum2 m = best_position(model(kind, length_parameter));
    const double angle = apex_degrees(m.at);
    apex.isosceles = apex.isosceles && std::abs(m.at.x) < kHalfDigits;
    apex.rising = apex.rising && angle > before;
    if (k == 0) apex.first = angle;
    apex.last = before = angle;
    if (k % (count / 6) == 0)
      apex.list += (apex.list.empty() ? "" : ", ") + digits(angle, 4) + "° at " + digits(length_parameter, 2);
  }
  return apex;
}

Claim isosceles(std::size_t count, double times) {
  constexpr double kStated = 80, kAbout = 5;  // degrees
  const Apex a = apex_by(EnergyKind::BP, times, count);
  return {"8",
          "The E_BP-optimal triangle is isosceles; its apex angle grows with γ up to about 80°",
          "up to about 80°",
          a.list + " = γ; no more than " + digits(a.last, 4) + "°",
          a.isosceles && a.rising && std::abs(a.last - kStated) < kAbout && std::abs(a.first - 60) < 0.1,
          digits(count) + " values of γ from 0.001 up, each " + digits(times, 3) +
              " times the one before; simplex search for each"};
}

Claim shifted(std::size_t count, double times) {
  const Apex a = apex_by(EnergyKind::BHs, times, count);
  return {"8",
          "E_BHs with h° = 0 is E_BH, and moving h° changes the optimum as γ changes that of E_BP",
          "in a similar way",
          "apex " + a.list + " = −h°; no more than " + digits(a.last, 4) + "°",
          a.isosceles && a.rising && std::abs(a.first - 60) < 0.1,
          digits(count) + " values of −h° from 0.001 up"};
}

Claim limits() {
  double worst_bp = 0, worst_bhs = 0;
  std::size_t n = 0;
  for (int i = -9; i <= 9; ++i) {
    for (int j = 1; j <= 20; ++j) {
      const Vec2 p = {i / 10.0, 0.05 + j / 7.0};
      const double hard = free_vertex_energy(paper_model(EnergyKind::BH), p);
      if (!std::isfinite(hard)) continue;
      worst_bp = std::max(worst_bp, std::abs(free_vertex_energy(model(EnergyKind::BP, 1e-9), p) / hard - 1));
      worst_bhs = std::max(worst_bhs, std::abs(free_vertex_energy(model(EnergyKind::BHs, 0), p) / hard - 1));
      ++n;
    }
  }
  constexpr double kNearly = 1e-9;  // γ = 1e−9 changes φ by γ²/h², far less
  return {
      "8",
      "With γ = 0, E_BP = E_BH; with h° = 0, E_BHs = E_BH",
      "equal",
      "largest relative difference " + digits(worst_bp, 1) + " (γ = 1e−9) and " + digits(worst_bhs, 1) + " (h° = 0)",
      worst_bp < kNearly && worst_bhs < kNearly && n > 50,
      digits(n) + " acute triangles"};
}

Claim domains() {
  std::size_t hard = 0, shifted = 0, pseudo = 0, acute = 0, n = 0;
  double largest = 0;
  for (int i = -40; i <= 40; ++i) {
    for (int j = 1; j <= 60; ++j) {
      const Vec2 p = {i / 20.0 + 0.007, j / 20.0 + 0.013};  // off the right-angled triangles, where h is rounding
      const Vec2 l = kLeft - p, r = kRight - p, base = kRight - kLeft;
      acute += dot(l, r) > 0 && dot(base, p - kLeft) > 0 && dot(-1.0 * base, p - kRight) > 0;
      hard += std::isfinite(free_vertex_energy(drawn_model(EnergyKind::BH), p));
      shifted += std::isfinite(free_vertex_energy(drawn_model(EnergyKind::BHs), p));
      const double e = free_vertex_energy(drawn_model(EnergyKind::BP), p);
      pseudo += std::isfinite(e);
      if (std::isfinite(e)) largest = std::max(largest, e);
      ++n;
    }
  }
  return {"8",
          "E_BH and E_BHs have no value in parts of the plane; E_BP has one everywhere, only very large",
          "white regions",
          "of " + digits(n) + " positions E_BH has a value at " + digits(hard) +
              " (the acute triangles: " + digits(acute) + "), E_BHs at " + digits(shifted) + ", E_BP at all " +
              digits(pseudo) + ", up to " + digits(largest, 2),
          hard == acute && shifted > hard && shifted < n && pseudo == n,
          "grid over |x| ≤ 2, 0 < y ≤ 3"};
}

}  // namespace

Page make(Effort effort) {
  const bool full = effort == Effort::full;
  Page page;
  for (const Contours& contours : kContours) page.pictures.push_back(contour_picture(contours, full));
  Table table{.caption = "The best free vertex, its apex angle and its energy (★1)",
              .header = {"energy", "parameter", "free vertex", "apex angle", "E"},
              .rows = {}};
  const auto add = [&](EnergyKind kind, const char* name, const std::string& parameter, double length_parameter) {
    const Minimum2 m = best_position(model(kind, length_parameter));
    table.rows.push_back({name, parameter, place(m.at), digits(apex_degrees(m.at), 4) + "°", digits(m.value, 5)});
  };
  add(EnergyKind::BH, "E_BH", "", 0);
  for (const double h : {0.1, 0.3, 1.0}) add(EnergyKind::BHs, "E_BHs", "h° = −" + digits(h, 2), h);
  for (const double g : {0.1, 0.3, 1.0, 3.0, 100.0}) add(EnergyKind::BP, "E_BP", "γ = " + digits(g, 3), g);
  page.tables = {table};
  const std::size_t count = full ? 48 : 12;
  const double times = std::pow(1e7, 1.0 / static_cast<double>(count - 1));
  page.claims = {collapsed_minima(),    equilateral(), isosceles(count, times),
                 shifted(count, times), limits(),      domains()};
  add_tetrahedron(page, full);
  return page;
}

}  // namespace temper::gallery::fig08
