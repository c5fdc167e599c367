// Figure 30: the patch test with positions alone, and how it compares with the short-edge rule.
#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

#include "experiments/domain.hpp"
#include "experiments/energies.hpp"
#include "experiments/high_heat.hpp"
#include "experiments/patch_test.hpp"
#include "experiments/short_edge.hpp"
#include "experiments/summary_matrix.hpp"
#include "experiments/text.hpp"
#include "figures.hpp"
#include "plot/plot.hpp"
#include "temper/generate.hpp"
#include "temper/quality.hpp"
#include "temper/topology.hpp"

namespace temper::gallery::fig30 {
namespace {

/// Vertices removed so far, by iteration.
Series cumulative(const std::string& name, const Removals& removals, int last) {
  Series series{name, {}, SeriesStyle::step};
  double count = 0;
  for (int iteration = 0; iteration <= last; ++iteration) {
    const auto found = removals.find(iteration);
    if (found != removals.end()) count += static_cast<double>(found->second.size());
    series.points.push_back({static_cast<double>(iteration), count});
  }
  return series;
}

Picture plot() {
  constexpr int kLast = 50;
  LinePlot plot;
  plot.x_label = "iteration";
  plot.y_label = "vertices removed so far";
  plot.width = 720;
  plot.series = {
      cumulative("patch test, positions", removals(patch_test_run(Unknowns::positions)), kLast),
      cumulative("patch test, positions and weights", removals(patch_test_run(Unknowns::positions_and_weights)), kLast),
      cumulative("short-edge rule, deferred flips", removals(high_heat_bp()), kLast)};
  return {"fig30_count", line_plot_svg(plot),
          "Vertices removed so far by the patch test of figures 30 and 31, and by the short-edge rule in the run of "
          "figure 26. The boundary's " +
              digits(dense_horseshoe().n_vertices() - count_interior(dense_horseshoe())) +
              " vertices are never removed."};
}

std::size_t in_common(const std::set<VertexId>& some, const std::set<VertexId>& others) {
  return static_cast<std::size_t>(std::ranges::count_if(some, [&](VertexId v) { return others.contains(v); }));
}

/// The sizes of the sets that two rules remove, and of what they share.
struct Overlap {
  std::size_t by_short_edge = 0, by_patch = 0, common = 0, runs = 0, runs_with_more = 0;
  void add(const Removals& short_edge, const Removals& patch) {
    const std::set<VertexId> some = all_of(short_edge), more = all_of(patch);
    by_short_edge += some.size();
    by_patch += more.size();
    common += in_common(some, more);
    ++runs;
    if (more.size() > some.size()) ++runs_with_more;
  }
};

Overlap overlap(Effort effort) {
  Overlap o;
  for (const RuleComparison& c : rule_comparisons(effort)) {
    o.add(c.short_edge_positions, c.patch_positions);
    o.add(c.short_edge_weights, c.patch_weights);
  }
  o.add(removals(high_heat_bp()), removals(patch_test_run(Unknowns::positions_and_weights)));
  return o;
}

Table comparison_table(Effort effort) {
  Table t{"Vertices removed by each rule, flips at once, by vertex order; in brackets the mean iteration.",
          {"vertex order", "patch test, positions", "patch test, positions and weights", "short edges, positions",
           "short edges, positions and weights"},
          {}};
  const auto cell = [](const Removals& r) {
    const std::size_t count = all_of(r).size();
    return digits(count) + (count > 0 ? " (" + digits(mean_iteration(r), 2) + ")" : "");
  };
  for (const RuleComparison& c : rule_comparisons(effort)) {
    t.rows.push_back({c.order, cell(c.patch_positions), cell(c.patch_weights), cell(c.short_edge_positions),
                      cell(c.short_edge_weights)});
  }
  return t;
}

Claim removes_more(const Overlap& o) {
  return {
      "30",
      "The patch test removes more vertices than the short-edge rule.",
      "more",
      digits(o.by_patch) + " against " + digits(o.by_short_edge) + " over " + digits(o.runs) +
          " pairs of runs; more in " + digits(o.runs_with_more) + " of them",
      o.runs > 0 && o.runs_with_more == o.runs,
      "The same options but for the rule, with and without weights, in several vertex orders; and the run of figure "
      "26 against that of figure 31."};
}

Claim same_and_more(const Overlap& o) {
  return {"30",
          "The patch test usually removes the vertices that the short-edge rule removes, plus many more.",
          "usually",
          digits(o.common) + " of the " + digits(o.by_short_edge) +
              " vertices removed by the short-edge rule go by the patch test too",
          o.by_short_edge > 0 && 10 * o.common >= 9 * o.by_short_edge,
          "Compared by their numbers, run by run; nine of ten were asked for."};
}

/// One combination of the survey of validity.
struct Case {
  const Mesh* mesh;
  Unknowns unknowns;
  Flips timing;
  RemovalMeasure measure;
  double gamma;  ///< of the length scale of the mesh's edges
  VertexOrder order;
};

struct Validity {
  std::size_t runs = 0, inverted = 0, non_regular = 0, failed = 0, removed = 0;
  std::size_t improved = 0;  ///< runs that ended with less energy than they began with
};

void run_case(const Case& c, Validity& v) {
  OptimizeOptions options = immediate_options(c.unknowns, RemovalRule::patch);
  options.flips = c.timing;
  options.paper.removal_measure = c.measure;
  options.paper.gamma = LengthParameter{c.gamma, LengthScale::relative};
  visit_in(c.order, options);
  options.max_sweeps = 15;
  Mesh mesh = *c.mesh;
  const auto report = optimize(mesh, options);
  ++v.runs;
  if (!report || mesh.validate()) {
    ++v.failed;
    return;
  }
  const Quality q = quality(mesh);
  v.inverted += q.inverted_triangles;
  v.non_regular += q.non_regular_edges;
  v.removed += report->vertices_removed;
  if (report->objective_after < report->objective_before) ++v.improved;
}

Validity survey_validity(Effort effort) {
  const bool full = effort == Effort::full;
  std::vector<Mesh> meshes = {dense_horseshoe()};
  if (auto ring = annulus({.around = full ? 24 : 16, .rings = 4})) meshes.push_back(*std::move(ring));
  if (auto points = random_mesh({.vertices = full ? 80U : 40U})) meshes.push_back(*std::move(points));
  std::vector<VertexOrder> orders = vertex_orders(0);
  if (!full) orders.resize(1);
  Validity v;
  for (const Mesh& mesh : meshes) {
    for (const Unknowns unknowns : {Unknowns::positions, Unknowns::positions_and_weights}) {
      for (const Flips timing : {Flips::immediate, Flips::deferred}) {
        for (const RemovalMeasure measure : {RemovalMeasure::sum, RemovalMeasure::mean, RemovalMeasure::excess}) {
          for (const double gamma : full ? std::vector{0.02, 0.3, 2.0} : std::vector{0.3}) {
            for (const VertexOrder& order : orders) {
              run_case({&mesh, unknowns, timing, measure, gamma, order}, v);
            }
          }
        }
      }
    }
  }
  return v;
}

Claim always_valid(Effort effort) {
  const Validity v = survey_validity(effort);
  return {"30",
          "E_BP with removal always gives a valid mesh.",
          "stable in all combinations",
          digits(v.runs) + " runs, " + digits(v.removed) + " vertices removed: inverted triangles " +
              digits(v.inverted) + ", non-regular edges " + digits(v.non_regular) + ", failures " + digits(v.failed) +
              "; less energy than before in " + digits(v.improved),
          v.runs > 0 && v.inverted == 0 && v.non_regular == 0 && v.failed == 0 && 10 * v.improved > 9 * v.runs,
          "Three meshes (dense horseshoe, annulus, random points), with and without weights, flips at once and "
          "deferred, three measures of a patch, several γ (relative to each edge) and vertex orders. Exact tests; nine "
          "of ten runs had to lower the energy, so that "
          "untouched inputs do not count as success."};
}

/// Good meshes among the runs of one rule in the matrix of figure 32.
struct Good {
  std::size_t good = 0, runs = 0;
  [[nodiscard]] bool all() const { return good == runs && runs > 0; }
  [[nodiscard]] std::string text() const { return digits(good) + " of " + digits(runs); }
};
Good good_runs(const Matrix& matrix, std::string_view energy, RemovalRule rule) {
  Good g;
  for (const Unknowns unknowns : kUnknowns) {
    const Cell& cell = matrix.at(energy, unknowns, rule);
    g.good += cell.count(Verdict::good);
    g.runs += cell.endings.size();
  }
  return g;
}

Claim only_bp_without_removal(const Matrix& matrix) {
  bool bp = false, others = false;
  std::string found;
  for (const std::string_view energy : kFiveEnergies) {
    const Good g = good_runs(matrix, energy, RemovalRule::none);
    (energy == "BP" ? bp : others) |= g.all();
    found += (found.empty() ? "" : ", ") + symbol(energy) + " " + g.text();
  }
  return {"7 Conclusion",
          "Where no nodes may be removed, only E_BP is robust.",
          "only E_BP",
          "good meshes: " + found,
          bp && !others,
          "Runs of figure 32 without removals, with and without weights. E_BHs has the same walls, and is counted as "
          "another energy."};
}

Claim any_metric_with_patch_test(const Matrix& matrix) {
  bool all = true;
  std::string found;
  for (const std::string_view energy : kFiveEnergies) {
    std::string parts;
    for (const Unknowns unknowns : kUnknowns) {
      const Cell& cell = matrix.at(energy, unknowns, RemovalRule::patch);
      all = all && cell.count(Verdict::good) == cell.endings.size();
      parts +=
          (parts.empty() ? "" : " and ") + digits(cell.count(Verdict::good)) + " of " + digits(cell.endings.size());
    }
    found += (found.empty() ? "" : ", ") + symbol(energy) + " " + parts;
  }
  return {
      "7 Conclusion",
      "For removing vertices by the patch test any metric can be used.",
      "any metric",
      "good meshes with positions alone, and with weights: " + found,
      all,
      "Runs of figure 32 with the patch test. Every energy removes vertices; under E_F and E_∂T the weights still run "
      "away where they may change."};
}

/// Vertices put into the triangles of an optimized mesh, one at a time: what each rule says of them.
struct Inserted {
  std::size_t vertices = 0, by_short_edge = 0, by_patch = 0;
  [[nodiscard]] std::string text() const {
    return "the short-edge rule removes " + digits(by_short_edge) + " of " + digits(vertices) + ", the patch test " +
           digits(by_patch);
  }
};
/// At barycentric coordinates; `share` of the largest.
Inserted insert_everywhere(const Mesh& mesh, std::array<double, 3> share) {
  const EnergyModel model = model_of("BP", dense_horseshoe());
  Inserted result;
  for (const TriangleId t : mesh.triangles()) {
    const auto corners = mesh.corners(t);
    WeightedPoint p;
    for (std::size_t k = 0; k < 3; ++k) {
      const WeightedPoint q = mesh.point(corners[k]);
      p = {p.x + share[k] * q.x, p.y + share[k] * q.y, p.w + share[k] * q.w};
    }
    Mesh with = mesh;
    const VertexId v = insert_in_triangle(with, t, p);
    ++result.vertices;
    result.by_short_edge += short_edge(with, v).collapses();
    result.by_patch += energy_change_without(with, model, v) < 0;
  }
  return result;
}

Claim small_and_three_valent() {
  const Mesh& mesh = high_heat_bp().result;
  constexpr double kNear = 0.05;
  const Inserted three = insert_everywhere(mesh, {1.0 / 3, 1.0 / 3, 1.0 / 3});
  const Inserted obtuse = insert_everywhere(mesh, {(1 - kNear) / 2, (1 - kNear) / 2, kNear});
  const auto missed = [](const Inserted& i) { return i.by_short_edge < i.vertices && i.by_patch == i.vertices; };
  return {
      "7 Conclusion",
      "The short-edge rule fails to collapse some small obtuse triangles and 3-valent vertices; the patch test removes "
      "them.",
      "fails; successful in these cases",
      "3-valent vertices at centroids: " + three.text() +
          "; near the middle of an edge, with a small obtuse triangle: " + obtuse.text(),
      missed(three) && missed(obtuse),
      "One vertex put into each triangle of the final mesh of figure 29 in turn, with the weight interpolated there; "
      "the obtuse triangles have a height of " +
          digits(kNear, 2) + " of their triangle's."};
}

}  // namespace

Page make(Effort effort) {
  const Recording& run = patch_test_run(Unknowns::positions);
  const Overlap o = overlap(effort);
  return {{{"fig30", removal_panels(run, 0),
            "The mesh with which each iteration begins, the vertices that it removes in red, and the final mesh. "
            "Positions alone under E_BP with γ = 1, flips at once, vertices visited as numbered."},
           plot()},
          {removal_table(run), comparison_table(effort)},
          {coarse_but_good(Unknowns::positions, "30"), removes_more(o), same_and_more(o), always_valid(effort),
           only_bp_without_removal(summary_matrix(effort, Inversion::refuse)),
           any_metric_with_patch_test(summary_matrix(effort, Inversion::refuse)), small_and_three_valent()}};
}

}  // namespace temper::gallery::fig30
