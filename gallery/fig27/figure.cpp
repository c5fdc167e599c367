// Figure 27: the outer iterations of the high-heat run: what has converged, and what flips make of it.
#include <string>
#include <vector>

#include "experiments/high_heat.hpp"
#include "experiments/mesh_picture.hpp"
#include "experiments/text.hpp"
#include "figures.hpp"
#include "plot/plot.hpp"
#include "temper/quality.hpp"

namespace temper::gallery::fig27 {
namespace {

std::string panel(const Moment& m, const Moment& other) {
  MeshPicture picture;
  const bool after = m.kind == Snapshot::Moment::after_flips;
  picture.title =
      "outer " + std::to_string(m.outer) + (after ? ", flipped" : ", optimal") + ": E_BP = " + digits(m.energy);
  picture.weight_scale = 0.25;
  picture.shades = cavities(m, other);
  return mesh_picture_svg(m.mesh, picture);
}

Picture panels() {
  std::vector<std::string> above, below;
  for (const std::size_t i : kShownOuter) {
    if (i >= high_heat_flipped().size()) continue;
    above.push_back(panel(*high_heat_optimal()[i], *high_heat_flipped()[i]));
    below.push_back(panel(*high_heat_flipped()[i], *high_heat_optimal()[i]));
  }
  const std::size_t columns = above.size();
  above.insert(above.end(), below.begin(), below.end());
  return {"fig27", grid_svg(above, columns),
          "Above, the mesh when the inner iterations have converged; below, after flips. Purple: cavities that flip. "
          "Weight circles at a quarter of their radius; weights are zero in outer iteration 0, which converges just "
          "before iteration 40."};
}

LinePlot energy_plot() {
  LinePlot plot;
  plot.title = "E_{BP} and triangles not well-centered";
  plot.x_label = "iteration";
  plot.width = 640;
  plot.y_label = "E_{BP} / 100, fraction";
  Series energy{"E_{BP} / 100", {}, SeriesStyle::line}, bad{"not well-centered", {}, SeriesStyle::dashed};
  for (const Moment& m : high_heat_bp().moments) {
    const double fraction = quality(m.mesh).well_centered_fraction;
    energy.points.push_back({static_cast<double>(m.sweep), m.energy / 100});
    bad.points.push_back({static_cast<double>(m.sweep), 1 - fraction});
    if (m.kind == Snapshot::Moment::after_flips) plot.vertical.push_back({static_cast<double>(m.sweep), ""});
  }
  plot.series = {energy, bad};
  return plot;
}

Table table() {
  Table t{"Outer iterations: the edges that flips have to mend, and the mesh after them.",
          {"outer iteration", "iterations so far", "collapses", "E_BP optimal", "E_BP flipped", "non-regular edges",
           "well-centered", "least angle"},
          {}};
  const std::vector<std::size_t> counts = collapses_by_outer(high_heat_bp());
  for (std::size_t i = 0; i < high_heat_flipped().size(); ++i) {
    const Quality before = quality(high_heat_optimal()[i]->mesh), after = quality(high_heat_flipped()[i]->mesh);
    t.rows.push_back({digits(i), std::to_string(high_heat_optimal()[i]->sweep), digits(counts[i]),
                      digits(high_heat_optimal()[i]->energy), digits(high_heat_flipped()[i]->energy),
                      digits(before.non_regular_edges), digits(after.well_centered_fraction, 3),
                      digits(after.min_angle_deg, 3) + "°"});
  }
  return t;
}

Claim stops_when_regular() {
  const Recording& run = high_heat_bp();
  const std::size_t rounds = high_heat_optimal().size();
  const std::size_t last = rounds == 0 ? 1 : quality(high_heat_optimal().back()->mesh).non_regular_edges;
  bool earlier_flipped = rounds > 1;
  for (std::size_t i = 0; i + 1 < rounds; ++i) {
    earlier_flipped = earlier_flipped && quality(high_heat_optimal()[i]->mesh).non_regular_edges > 0;
  }
  return {"27",
          "The run stops because its optimal mesh is regular and needs no flips.",
          "after the seventh outer iteration",
          "after " + digits(rounds) + " outer iterations, " + std::to_string(run.report.sweeps) +
              " iterations; non-regular edges before the last flips: " + digits(last),
          run.report.stopped == Stopped::converged && last == 0 && earlier_flipped,
          "All outer iterations before it ended with edges to flip. How many there are depends on the vertex order."};
}

Claim outer_iterations_help() {
  const Moment &first = *high_heat_flipped().front(), &last = *high_heat_flipped().back();
  const double before = quality(first.mesh).well_centered_fraction, after = quality(last.mesh).well_centered_fraction;
  return {"27",
          "Outer iterations significantly improve the mesh.",
          "significantly, near the bottom feet",
          "E_BP " + digits(first.energy) + " → " + digits(last.energy) + ", well-centered " + digits(before, 2) +
              " → " + digits(after, 2),
          last.energy < 0.9 * first.energy && after > before,
          "From outer iteration 0, after its flips, to the last; a tenth of the energy was asked for. The feet alone: "
          "figure 28."};
}

}  // namespace

Page make(Effort) {
  return {
      {panels(),
       {"fig27_energy", line_plot_svg(energy_plot()),
        "The energy and the fraction of triangles that are not well-centered over the whole run; vertical lines are "
        "flips. Weights join at iteration 40."}},
      {table()},
      {stops_when_regular(), outer_iterations_help()}};
}

}  // namespace temper::gallery::fig27
