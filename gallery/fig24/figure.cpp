// Figure 24: the energy by iteration of the nine policies of figure 23.
#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "experiments/text.hpp"
#include "experiments/weight_policies.hpp"
#include "figures.hpp"
#include "plot/plot.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/draw.hpp"

namespace temper::gallery::fig24 {
namespace {

constexpr std::size_t kAtOnce = 0, kAllDeferred = 2;  // columns

std::string panel(const PolicyRun& run) {
  LinePlot plot;
  plot.title = run.policy.limit_name + ": " + run.policy.update_name;
  plot.x_label = "iteration";
  plot.y_label = "E_{∂T}";
  plot.width = 330, plot.height = 230;
  Series series{"", {}, SeriesStyle::line_markers};
  for (std::size_t i = 0; i < run.energies.size(); ++i) {
    series.points.push_back({static_cast<double>(i), run.energies[i]});
  }
  plot.series = {series};
  return line_plot_svg(plot);
}

Picture panels() {
  std::vector<std::string> svgs;
  for (const PolicyRun& run : policy_runs()) svgs.push_back(panel(run));
  return {
      "fig24", grid_svg(svgs, kPolicyColumns),
      "E_∂T after each sweep over the weights, and after its flips. Deferred weights (right) do not settle. Jumps come "
      "with vertices that become hidden."};
}

Table table() {
  Table t{
      "How the nine runs of " + digits(policy_runs().front().energies.size() - 1) +
          " sweeps go: sweeps after which the energy was higher; the part of all weight changes that go back on the "
          "vertex's last one; the sweep from which on the energy is within " +
          digits(PolicyRun::kSettled) + " of its last value, relative.",
      {"limit", "updates", "last energy", "rises", "reversed changes", "settled at sweep"},
      {}};
  for (const PolicyRun& r : policy_runs()) {
    t.rows.push_back({r.policy.limit_name, r.policy.update_name, digits(r.energy()), digits(r.rises),
                      digits(r.reversals, 2), std::to_string(r.settled)});
  }
  return t;
}

Claim deferred_weights_oscillate() {
  double least_deferred = 1, most_immediate = 0;
  std::size_t rises = 0, rises_immediate = 0;
  for (std::size_t i = 0; i < policy_runs().size(); ++i) {
    const PolicyRun& r = policy_runs()[i];
    if (i % kPolicyColumns == kAllDeferred) {
      least_deferred = std::min(least_deferred, r.reversals);
      rises += r.rises;
    } else {
      most_immediate = std::max(most_immediate, r.reversals);
      rises_immediate += r.rises;
    }
  }
  constexpr double kOften = 0.25;  // of all changes
  return {"24",
          "Deferring weight updates exhibits oscillations.",
          "oscillatory weights",
          "at least " + digits(100 * least_deferred, 2) +
              " % of the weight changes go back on the last one (immediate: at "
              "most " +
              digits(100 * most_immediate, 2) + " %); the energy rose after " + digits(rises) + " sweeps (" +
              digits(rises_immediate) + ")",
          least_deferred > kOften && least_deferred > most_immediate && rises > rises_immediate,
          "The three runs with deferred weights against the six with immediate ones."};
}

Claim deferred_weights_are_slowest() {
  bool slowest = true;
  std::string measured;
  for (const FlipLimit limit : kPolicyRows) {
    const PolicyRun& deferred = policy_run(policy_runs(), limit, kAllDeferred);
    measured += (measured.empty() ? "" : "; ") + deferred.policy.limit_name + " " + std::to_string(deferred.settled) +
                " against immediate";
    for (std::size_t column = 0; column < kAllDeferred; ++column) {
      const PolicyRun& other = policy_run(policy_runs(), limit, column);
      slowest = slowest && deferred.settled > other.settled;
      measured += (column > 0 ? " and " : " ") + std::to_string(other.settled);
    }
  }
  return {"24",
          "Deferring weights and flips converges slowest.",
          "the slowest convergence",
          "all deferred settle at sweep (immediate: flips at once, and flips deferred): " + measured,
          slowest,
          "From that sweep on the energy is within " + digits(PolicyRun::kSettled) + " of its value at sweep " +
              digits(policy_runs().front().energies.size() - 1) + "."};
}

Claim after_converges_quickest() {
  const auto sweep = [](FlipLimit limit) { return policy_run(policy_runs(), limit, kAtOnce).settled; };
  // As low as stopping before ever gets: both are then measured against one energy.
  const double target = policy_run(policy_runs(), FlipLimit::before, kAtOnce).energy();
  const auto reached = [&](FlipLimit limit) {
    const auto& energies = policy_run(policy_runs(), limit, kAtOnce).energies;
    return std::ranges::find_if(energies, [&](double e) { return e <= target; }) - energies.begin();
  };
  const auto after = reached(FlipLimit::after);
  return {"24",
          "With immediate updates stopping after converges quickest.",
          "quickest",
          "it is below the last energy of stopping before (" + digits(target) + ") after " + std::to_string(after) +
              " sweeps, unlimited weights after " + std::to_string(reached(FlipLimit::unlimited)) +
              ", stopping before after " + std::to_string(reached(FlipLimit::before)),
          after < reached(FlipLimit::unlimited) && after < reached(FlipLimit::before),
          "Each measured against its own last energy, they settle at sweep " + std::to_string(sweep(FlipLimit::after)) +
              ", " + std::to_string(sweep(FlipLimit::unlimited)) + " and " + std::to_string(sweep(FlipLimit::before)) +
              "."};
}

Claim after_is_minutely_better() {
  const double after = policy_run(policy_runs(), FlipLimit::after, kAllDeferred).energy(),
               before = policy_run(policy_runs(), FlipLimit::before, kAllDeferred).energy();
  constexpr double kMinute = 0.01;  // relative
  return {"6.6.2",
          "With weights and flips deferred the mesh of stopping after is minutely better than that of stopping before.",
          "minutely better",
          "energies " + digits(after, 5) + " after and " + digits(before, 5) + " before, " +
              digits(100 * (after - before) / before, 2) + " %",
          after < before && before - after < kMinute * before,
          "Last energies of the two runs; minutely: by less than one part in a hundred."};
}

/// How much two meshes over the same vertices differ.
struct Difference {
  std::size_t triangles = 0;  ///< of the first that the other has not
  double orthocenters = 0;    ///< largest distance of those of a triangle of both, over the domain's width
};

using Triangle = std::array<VertexId, 3>;
std::map<Triangle, Vec2> orthocenters_by_triangle(const PolicyRun& run) {
  std::map<Triangle, Vec2> all;
  for (const TriangleId t : run.end.triangles()) {
    const auto corners = run.end.corners(t);
    Triangle names;
    std::ranges::transform(corners, names.begin(), [&](VertexId v) { return run.vertices[v.index]; });
    std::ranges::sort(names);
    all[names] = orthocenter(run.end.point(corners[0]), run.end.point(corners[1]), run.end.point(corners[2]));
  }
  return all;
}

Difference difference(const PolicyRun& one, const PolicyRun& other) {
  const auto others = orthocenters_by_triangle(other);
  double left = std::numeric_limits<double>::infinity(), right = -left;
  for (const VertexId v : one.end.vertices()) {
    left = std::min(left, one.end.position(v).x);
    right = std::max(right, one.end.position(v).x);
  }
  Difference d;
  for (const auto& [corners, center] : orthocenters_by_triangle(one)) {
    const auto found = others.find(corners);
    if (found == others.end()) {
      ++d.triangles;
    } else {
      d.orthocenters = std::max(d.orthocenters, length(center - found->second) / (right - left));
    }
  }
  return d;
}

Claim after_looks_like_before() {
  constexpr double kVisible = 0.005;  // of the width: the line of an edge in a picture
  const Difference d = difference(policy_run(policy_runs(), FlipLimit::after, kAllDeferred),
                                  policy_run(policy_runs(), FlipLimit::before, kAllDeferred));
  return {"6.6.2",
          "With weights and flips deferred the meshes of stopping after and before look the same.",
          "visually indistinguishable",
          digits(d.triangles) + " triangles differ, orthocenters of the others by at most " +
              digits(100 * d.orthocenters, 2) + " % of the domain's width",
          d.triangles == 0 && d.orthocenters < kVisible,
          "Triangles by their vertices; a dual is visibly elsewhere when it has moved by " + digits(100 * kVisible) +
              " % of the picture."};
}

Claim edges_flip_back() {
  const PolicyRun& run = policy_run(policy_runs(), FlipLimit::unlimited, kAtOnce);
  std::size_t back = 0;
  for (const auto& [vertex, flips] : run.flips_back_by_vertex) back += flips;
  return {"6.6.2",
          "With immediate updates and unlimited weights some vertices make edges flip back and forth.",
          "a handful of 37 flips",
          digits(back) + " of " + digits(run.flips) + " flips bring back an edge that was flipped away, by " +
              digits(run.flips_back_by_vertex.size()) + " vertices",
          back > 0,
          "A flip is counted for the vertex whose weight changed last before it; edges by their two ends."};
}

Claim few_vertices_flip_twice() {
  const PolicyRun& run = policy_run(policy_runs(), FlipLimit::after, kAtOnce);
  std::size_t more = 0, most = 0;
  for (const auto& [vertex, flips] : run.flips_by_vertex) more += flips > 1, most = std::max(most, flips);
  return {"6.6.2",
          "With immediate updates and stopping after, only two vertices cause more than one flip.",
          "13 flips, two vertices",
          digits(run.flips) + " flips by " + digits(run.flips_by_vertex.size()) + " vertices; " + digits(more) +
              " of them cause more than one, the first among them " + digits(most),
          more == 2,
          "A flip is counted for the vertex whose weight changed last before it."};
}

}  // namespace

Page make(Effort) {
  return {{panels()},
          {table()},
          {deferred_weights_oscillate(), deferred_weights_are_slowest(), after_converges_quickest(),
           after_is_minutely_better(), after_looks_like_before(), edges_flip_back(), few_vertices_flip_twice()}};
}

}  // namespace temper::gallery::fig24
