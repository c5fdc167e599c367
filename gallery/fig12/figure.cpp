// Figure 12: positions of the sparse horseshoe, with collapses and without.
#include <algorithm>
#include <array>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "experiments/closeness.hpp"
#include "experiments/energies.hpp"
#include "experiments/sparse_runs.hpp"
#include "experiments/text.hpp"
#include "figures.hpp"
#include "plot/plot.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/energy.hpp"
#include "temper/generate.hpp"
#include "temper/quality.hpp"

namespace temper::gallery::fig12 {
namespace {

constexpr Vec2 kP1 = {0, 2};

/// One run for each energy, positions only, no collapses.
struct FiveRuns {
  std::array<SparseRun, kFiveEnergies.size()> runs;
  [[nodiscard]] const SparseRun& of(std::string_view energy) const { return runs[position_of(energy)]; }
};
FiveRuns position_runs() {
  FiveRuns five;
  for (std::size_t i = 0; i < kFiveEnergies.size(); ++i) five.runs[i] = run_sparse({.energy = kFiveEnergies[i]});
  return five;
}

double distance_to_p1(const SparseRun& run) { return length(run.last().p4 - kP1); }

/// The energy with p_4 at (0, y).
double energy_at(const EnergyModel& model, double y) {
  Mesh mesh = sparse_horseshoe();
  mesh.set_point(VertexId(std::size_t{4}), {0, y, 0});
  return total_energy(mesh, model);
}

std::string energy_plot() {
  LinePlot plot;
  plot.title = "p_{4} on the axis";
  plot.x_label = "y of p_{4}";
  plot.y_label = "E(y) / E(3)";
  plot.x_range = {0.5, 3.95};
  plot.y_range = {0, 2};
  plot.vertical = {{kP1.y, "p_{1}"}};
  for (const std::string_view energy : kFiveEnergies) {
    const EnergyModel model = model_of(energy, sparse_horseshoe());
    Series series;
    series.name = plot_symbol(energy);
    const double start = energy_at(model, 3);
    for (int i = 0; i <= 345; ++i) {
      const double y = 0.5 + 0.01 * i;
      series.points.push_back({y, energy_at(model, y == kP1.y ? y + 1e-9 : y) / start});
    }
    plot.series.push_back(series);
  }
  return line_plot_svg(plot);
}

/// The places where p_4 ends, by γ or −h°.
std::vector<Vec2> heights_by(std::string_view energy, const std::vector<double>& length_parameters) {
  std::vector<Vec2> points;
  for (const double s : length_parameters) {
    points.push_back({s, run_sparse({.energy = energy, .length_parameter = s}).last().p4.y});
  }
  return points;
}
std::vector<Vec2> heights_by_gamma() {
  return heights_by("BP", {0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 0.75, 1, 1.5, 2, 3, 4, 5});
}
std::vector<Vec2> heights_by_shift() {
  std::vector<double> shifts;
  for (const double factor : {0.82, 0.9, 1.0, 1.2, 1.4, 1.6}) {  // from just beyond the worst h of the input
    shifts.push_back(factor * shift_beyond(sparse_horseshoe()).value);
  }
  return heights_by("BHs", shifts);
}

std::string parameter_plot() {
  LinePlot plot;
  plot.title = "where p_{4} ends";
  plot.x_label = "γ, −h°";
  plot.y_label = "y of p_{4}";
  plot.horizontal = {{kP1.y, "p_{1}"}};
  plot.series = {{.name = "E_{BP} by γ", .points = heights_by_gamma(), .style = SeriesStyle::line_markers},
                 {.name = "E_{BHs} by −h°", .points = heights_by_shift(), .style = SeriesStyle::line_markers}};
  return line_plot_svg(plot);
}

std::string panels(const FiveRuns& five) {
  std::vector<std::string> svgs;
  for (std::size_t i = 0; i < kFiveEnergies.size(); ++i) {
    const SparseSweep& last = five.runs[i].last();
    svgs.push_back(sparse_picture(last.mesh, symbol(kFiveEnergies[i]), "y = " + digits(last.p4.y, 6)));
  }
  const SparseRun collapsed = run_sparse({.energy = "BP", .collapse_energy = "dT"});
  svgs.push_back(sparse_picture(collapsed.last().mesh, "any energy, with collapses",
                                digits(collapsed.last().mesh.n_vertices()) + " vertices"));
  return grid_svg(svgs, 3);
}

Claim hot_collapses(const FiveRuns& five) {
  bool holds = true;
  std::string found;
  for (const std::string_view energy : kHotEnergies) {
    const SparseRun& run = five.of(energy);
    holds = holds && run.nearly_collapses() && distance_to_p1(run) < kNearlyCoincident * length(kP1 - Vec2{2, 0});
    found += (found.empty() ? "" : ", ") + symbol(energy) + " " + digits(distance_to_p1(run), 2);
  }
  return {"12",
          "Under E_F, E_∂T and E_T the position of p_4 nearly collapses edge 41",
          "all three nearly collapse it",
          "distance of p_4 from p_1: " + found,
          holds,
          "positions only, no collapses; nearly: within 0.05 of the shorter perimeter edge at p_1. Steps stop short of "
          "inversion, at about 1e−6 of the patch radius"};
}

Claim differences_are_minor(const FiveRuns& five) {
  double most = 0;
  for (const std::string_view a : kHotEnergies) {
    for (const std::string_view b : kHotEnergies) {
      most = std::max(most, length(five.of(a).last().p4 - five.of(b).last().p4));
    }
  }
  return {"12",        "E_F, E_∂T and E_T differ little there",
          "minor",     "p_4 differs by at most " + digits(most, 2),
          most < 1e-3, "the same runs"};
}

Claim barriers_stay_open(const FiveRuns& five) {
  bool holds = true;
  std::string found;
  for (const std::string_view energy : kBarriers) {
    const SparseRun& run = five.of(energy);
    holds = holds && !run.nearly_collapses();
    found += (found.empty() ? "" : "; ") + symbol(energy) + ": p_4 at y = " + digits(run.last().p4.y, 5) +
             ", distance over perimeter edge " + digits(run.last().closeness, 3);
  }
  return {"12",
          "E_BP and E_BHs leave no element nearly collapsed",
          "superior meshes, nothing nearly collapsed",
          found,
          holds,
          "γ = 1 and −h° = " + digits(shift_beyond(sparse_horseshoe()).value, 3) +
              ", 1.25 of the worst h of the input; nearly collapsed is less than 0.05"};
}

Claim depends_on_parameters() {
  const std::vector<Vec2> gamma = heights_by_gamma(), shift = heights_by_shift();
  const auto rises = [](const std::vector<Vec2>& points) {
    return std::ranges::adjacent_find(points, [](Vec2 a, Vec2 b) { return b.y <= a.y; }) == points.end();
  };
  const auto range = [](const std::vector<Vec2>& points) {
    return "y from " + digits(points.front().y, 4) + " to " + digits(points.back().y, 4) + " as it goes from " +
           digits(points.front().x, 3) + " to " + digits(points.back().x, 3);
  };
  return {"12",
          "Where p_4 ends depends on the parameters γ and h°",
          "p_4's y depends on them",
          "γ: " + range(gamma) + "; −h°: " + range(shift),
          rises(gamma) && rises(shift),
          digits(gamma.size() + shift.size()) + " runs; y rises with each parameter, and tends to p_1 with γ"};
}

Claim any_energy_collapses() {
  std::size_t all = 0, gone = 0;
  int latest = 0;
  for (const std::string_view energy : kFiveEnergies) {
    for (const std::string_view collapse_energy : kHotEnergies) {
      const int sweep = run_sparse({.energy = energy, .collapse_energy = collapse_energy}).collapsed_in();
      ++all;
      if (sweep > 0) ++gone;
      latest = std::max(latest, sweep);
    }
  }
  return {"12",
          "With discrete collapses any energy removes p_4",
          "any energy collapses edge 41",
          digits(gone) + " of " + digits(all) + " runs remove it, the latest in sweep " + std::to_string(latest),
          gone == all,
          "five energies, each with E_c = E_F, E_∂T and E_T"};
}

Claim better_without() {
  const Mesh mesh = sparse_horseshoe();
  const auto least_angle = [&](std::size_t a, std::size_t b, std::size_t c) {
    const Vec2 p = mesh.position(VertexId(a)), q = mesh.position(VertexId(b)), r = mesh.position(VertexId(c));
    const double angle = std::min({corner_angle(p, q, r), corner_angle(q, r, p), corner_angle(r, p, q)});
    return angle * 180 / std::numbers::pi;
  };
  const double whole = least_angle(1, 2, 3), lower = least_angle(1, 2, 4), upper = least_angle(4, 2, 3);
  return {"12",
          "Triangle 123 is better shaped than 124 and 423",
          "better shaped than either",
          "least angle " + digits(whole, 4) + "°, against " + digits(lower, 4) + "° and " + digits(upper, 4) + "°",
          whole > lower && whole > upper,
          "angles at the input positions"};
}

/// The factor by which a triangle that is turned over counts, times the energy of its mirror image.
enum class Inverted { like_others = 1, left_out = 0, negative = -1 };

/// E_F with p_4 at (0, y).
double extrapolated_energy(double y, Inverted rule) {
  Mesh mesh = sparse_horseshoe();
  mesh.set_point(VertexId(std::size_t{4}), {0, y, 0});
  const EnergyModel model = model_of("F", sparse_horseshoe());
  double sum = 0;
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    const WeightedPoint p = mesh.point(a), q = mesh.point(b), r = mesh.point(c);
    const bool inverted = doubled_area(p.position(), q.position(), r.position()) < 0;
    sum += inverted ? static_cast<int>(rule) * triangle_energy(model, p, r, q) : triangle_energy(model, p, q, r);
  }
  return sum;
}

Claim extrapolation_decides() {
  bool holds = false;
  std::string found;
  for (const auto& [rule, words] :
       {std::pair{Inverted::like_others, "counted like others"}, std::pair{Inverted::left_out, "left out"},
        std::pair{Inverted::negative, "counted negative"}}) {
    const double near = extrapolated_energy(-10, rule), middle = extrapolated_energy(-100, rule);
    const double far = extrapolated_energy(-1000, rule);
    holds = holds || (far < middle && middle < near);
    found += (found.empty() ? "" : "; ") + std::string(words) + " " + digits(near, 2) + ", " + digits(middle, 2) +
             ", " + digits(far, 2);
  }
  const SparseRun allowed = run_sparse({.energy = "dT", .inversion = Inversion::allow});
  return {
      "12",
      "Depending on how inverted triangles are extrapolated, optimization can send p_4's y to −∞",
      "can send y → −∞",
      "E_F at y = −10, −100, −1000 with inverted triangles " + found,
      holds,
      "whatever they count, triangles 423 and 430 grow faster with −y than 014 and 124, so E_F rises for each of the "
      "three rules. What happens when steps may invert: E_∂T takes p_4 past p_1, over the wall in the next picture, "
      "to y = " +
          digits(allowed.last().p4.y, 2) + ", where " + digits(quality(allowed.last().mesh).inverted_triangles) +
          " triangles are turned over, and leaves it there"};
}

}  // namespace

Page make(Effort) {
  const FiveRuns five = position_runs();
  Page page;
  page.pictures.push_back(
      {"fig12", panels(five),
       "Positions only, γ = 1. Without a barrier p_4 ends on p_1 (red: nearly coincident; yellow: "
       "within 0.1 of the perimeter edge); with one it stays away. Last: with collapses p_4 goes."});
  page.pictures.push_back({"fig12_energy", energy_plot(),
                           "The five energies with p_4 at (0, y), over their value at the input. E_F, E_∂T and E_T "
                           "are least at p_1 from above; the barriers rise to +∞ there."});
  page.pictures.push_back({"fig12_parameters", parameter_plot(), "The barriers' optimum moves with their parameters."});
  page.claims = {hot_collapses(five),     differences_are_minor(five), barriers_stay_open(five),
                 depends_on_parameters(), any_energy_collapses(),      better_without(),
                 extrapolation_decides()};
  return page;
}

}  // namespace temper::gallery::fig12
