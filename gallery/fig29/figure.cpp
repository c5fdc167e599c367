// Figure 29: where the high-heat runs end, and the vertices in the center that the short-edge rule does not see.
#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "experiments/domain.hpp"
#include "experiments/energies.hpp"
#include "experiments/high_heat.hpp"
#include "experiments/mesh_picture.hpp"
#include "experiments/text.hpp"
#include "figures.hpp"
#include "plot/plot.hpp"
#include "temper/quality.hpp"

namespace temper::gallery::fig29 {
namespace {

struct Final {
  std::string name;
  const Recording& run;
  EnergyModel model;
};

std::vector<Final> finals() {
  return {{"BP", high_heat_bp(), model_of("BP", dense_horseshoe())},
          {"BHs", high_heat_bhs(), model_of("BHs", dense_horseshoe())}};
}

/// Inner vertices with four edges.
std::vector<VertexId> four_valent(const Mesh& mesh) {
  std::vector<VertexId> found;
  for (const VertexId v : mesh.vertices()) {
    if (!mesh.is_boundary(v) && valence(mesh, v) == 4) found.push_back(v);
  }
  return found;
}

std::string panel(const Final& f) {
  MeshPicture picture;
  picture.title = "E_" + f.name + ": " + std::to_string(f.run.result.n_vertices()) + " vertices";
  picture.weight_scale = 0.25;
  for (const VertexId v : four_valent(f.run.result)) {
    picture.marks.push_back({f.run.result.position(v), MarkColor::moving, "4"});
  }
  return mesh_picture_svg(f.run.result, picture);
}

Table summary() {
  Table t{
      "The final meshes. E_BP with γ = 1; −h° of E_BHs a quarter more than the least h of the input. The paper's "
      "figure shows the meshes and gives no numbers.",
      {"energy", "outer iterations", "iterations", "collapses", "vertices", "its energy", "well-centered",
       "least angle", "E_F", "E_T"},
      {}};
  for (const Final& f : finals()) {
    const Quality q = quality(f.run.result);
    t.rows.push_back({"E_" + f.name, digits(f.run.all(Snapshot::Moment::before_flips).size()),
                      std::to_string(f.run.report.sweeps), listed(collapses_by_outer(f.run)), digits(q.vertices),
                      digits(f.run.report.objective_after), digits(q.well_centered_fraction, 3),
                      digits(q.min_angle_deg, 3) + "°", digits(q.energy[0][1]), digits(q.energy[1][1])});
  }
  return t;
}

Claim final_meshes_are_valid() {
  std::string found;
  bool all = true;
  for (const Final& f : finals()) {
    const Quality q = quality(f.run.result);
    all = all && q.inverted_triangles == 0 && q.non_regular_edges == 0 && f.run.report.stopped == Stopped::converged;
    found += (found.empty() ? "" : "; ") + ("E_" + f.name) + ": inverted " + digits(q.inverted_triangles) +
             ", non-regular " + digits(q.non_regular_edges) + ", " + std::string(name(f.run.report.stopped));
  }
  return {"29",
          "Both barriers, with collapses, positions, weights and flips, end in a good mesh.",
          "final meshes for E_BP and E_BHs",
          found,
          all,
          "Exact tests on the final meshes of both runs."};
}

/// Counts of 4-valent vertices that the rule, or the patch test, misses.
struct Missed {
  std::size_t vertices = 0, not_by_rule = 0, farther_apart = 0, by_patch_test = 0;
  std::string numbers;  ///< of the distances
};

void add(Missed& m, const Mesh& mesh, const EnergyModel& model, VertexId v) {
  const ShortEdge rule = short_edge(mesh, v);
  ++m.vertices;
  if (!rule.collapses()) ++m.not_by_rule;
  if (rule.distance > rule.distance_now) ++m.farther_apart;
  if (energy_change_without(mesh, model, v) < 0) ++m.by_patch_test;
  m.numbers += (m.numbers.empty() ? "" : ", ") + ("nearest neighbor at " + digits(rule.distance_now, 3)) +
               ", at the E_F-optimal place " + digits(rule.distance, 3);
}

Missed missed_in_final_meshes() {
  Missed m;
  for (const Final& f : finals()) {
    for (const VertexId v : four_valent(f.run.result)) add(m, f.run.result, f.model, v);
  }
  return m;
}

/// Over the optimal meshes of all outer iterations and vertex orders.
struct Survey {
  std::size_t meshes = 0, with_pair = 0;
  Missed missed;
};

bool has_adjacent_pair(const Mesh& mesh, const std::vector<VertexId>& vertices) {
  return std::ranges::any_of(vertices, [&](VertexId v) {
    return std::ranges::any_of(vertices, [&](VertexId q) { return v < q && mesh.find_halfedge(v, q).valid(); });
  });
}

Survey survey(Effort effort) {
  Survey s;
  for (const OrderedHeat& heat : high_heat_by_order(effort)) {
    for (const Mesh& mesh : heat.optimal) {
      ++s.meshes;
      if (has_adjacent_pair(mesh, four_valent(mesh))) ++s.with_pair;
      for (const VertexId v : four_valent(mesh)) add(s.missed, mesh, model_of("BP", dense_horseshoe()), v);
    }
  }
  return s;
}

Claim pair_in_the_center(const Survey& s, Effort effort) {
  std::string counts;
  bool pairs = true;
  for (const Final& f : finals()) {
    const std::vector<VertexId> found = four_valent(f.run.result);
    pairs = pairs && has_adjacent_pair(f.run.result, found);
    counts += (counts.empty() ? "" : ", ") + digits(found.size()) + " under E_" + f.name;
  }
  return {
      "29",
      "Two adjacent 4-valent nodes remain in the center.",
      "in both final meshes",
      "inner vertices with four edges: " + counts,
      pairs,
      "Of " + digits(s.meshes) + " optimal meshes of outer iterations over " +
          digits(high_heat_by_order(effort).size()) + " vertex orders, " + digits(s.with_pair) +
          " have such a pair, and " + digits(s.missed.vertices) +
          " 4-valent inner vertices were counted: which are left follows from the collapses, those from the order."};
}

Claim rule_misses_them(const Missed& here, const Missed& m) {
  return {"29",
          "The short-edge rule does not catch 4-valent nodes: E_F puts them farther from their neighbors.",
          "the E_F-optimal positions are farther apart",
          (here.numbers.empty() ? std::string("none in the final meshes") : "final mesh: " + here.numbers) +
              "; over vertex orders " + digits(m.farther_apart) + " of " + digits(m.vertices) + " farther apart",
          here.vertices > 0 && here.not_by_rule == here.vertices && here.farther_apart == here.vertices &&
              2 * m.farther_apart > m.vertices,
          "Asked, by a simplex search, of every 4-valent inner vertex in the converged meshes of all outer iterations "
          "and vertex orders; the run's own three line searches caught none of them, and " +
              digits(m.not_by_rule) + " fail the rule also at the exact minimum."};
}

Claim patch_test_catches_them(const Missed& m) {
  return {"7 Conclusion",
          "The patch test removes 4-valent vertices that the short-edge rule misses.",
          "successful in these cases",
          digits(m.by_patch_test) + " of " + digits(m.vertices) + " have less energy without the vertex",
          m.vertices > 0 && m.by_patch_test == m.vertices,
          "E_BP of the whole mesh with the vertex taken out, against that with it; the same vertices as above."};
}

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

Claim replays() {
  const Recording& run = high_heat_bp();
  const auto again = replay(dense_horseshoe(), run.events);
  std::size_t same = 0;
  if (again && again->n_vertices() == run.result.n_vertices()) {
    for (const VertexId v : run.result.vertices()) {
      const WeightedPoint a = again->point(v), b = run.result.point(v);
      if (same_bits(a.x, b.x) && same_bits(a.y, b.y) && same_bits(a.w, b.w)) ++same;
    }
  }
  return {"29",
          "The whole high-heat run, written down event by event, replays to the same mesh.",
          "not in the paper",
          digits(run.events.size()) + " events; " + digits(same) + " of " + digits(run.result.n_vertices()) +
              " vertices with the same bits in x, y and w; connectivity " +
              (again && *again == run.result ? "the same" : "different"),
          again && *again == run.result && same == run.result.n_vertices() && !run.events.empty(),
          "Moves, weights, flips and collapses applied to the input without any energy.",
          Author::temper};
}

}  // namespace

Page make(Effort effort) {
  std::vector<std::string> panels;
  for (const Final& f : finals()) panels.push_back(panel(f));
  const Survey s = survey(effort);
  return {{{"fig29", grid_svg(panels, 2),
            "The final meshes under E_BP and E_BHs, regular and needing no flips. Weight circles at a quarter of their "
            "radius. Blue: inner vertices with four edges, which the patch test would remove."}},
          {summary()},
          {final_meshes_are_valid(), pair_in_the_center(s, effort),
           rule_misses_them(missed_in_final_meshes(), s.missed), patch_test_catches_them(s.missed), replays()}};
}

}  // namespace temper::gallery::fig29
