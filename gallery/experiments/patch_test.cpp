#include "experiments/patch_test.hpp"

#include <algorithm>

#include "experiments/domain.hpp"
#include "experiments/energies.hpp"
#include "experiments/high_heat.hpp"
#include "experiments/mesh_picture.hpp"
#include "experiments/text.hpp"
#include "plot/plot.hpp"
#include "temper/quality.hpp"

namespace temper::gallery {
namespace {

constexpr int kPatchOrders = 12;
// Vertices go in the first sweeps; the rest of a run only brings energies to rest.
constexpr int kSurveySweeps = 60;
constexpr std::size_t kColumns = 3;

Removals removed_with(const VertexOrder& order, Unknowns unknowns, RemovalRule rule) {
  OptimizeOptions options = immediate_options(unknowns, rule);
  visit_in(order, options);
  options.max_sweeps = kSurveySweeps;
  return removals(record(dense_horseshoe(), options, Keep::outer));
}

std::vector<RuleComparison> compare(Effort effort) {
  std::vector<RuleComparison> all;
  for (const VertexOrder& order : vertex_orders(effort == Effort::full ? kPatchOrders : 0)) {
    all.push_back({order.name, removed_with(order, Unknowns::positions, RemovalRule::patch),
                   removed_with(order, Unknowns::positions_and_weights, RemovalRule::patch),
                   removed_with(order, Unknowns::positions, RemovalRule::short_edge),
                   removed_with(order, Unknowns::positions_and_weights, RemovalRule::short_edge)});
  }
  return all;
}

/// Mean energy of a triangle, γ = 1.
double mean_energy(const Mesh& mesh) {
  return total_energy(mesh, model_of("BP", dense_horseshoe())) / static_cast<double>(mesh.n_triangles());
}

}  // namespace

OptimizeOptions immediate_options(Unknowns unknowns, RemovalRule rule) {
  OptimizeOptions options = *options_for("paper");
  options.unknowns = unknowns;
  options.flips = Flips::immediate;
  options.paper.inversion = Inversion::refuse;
  options.paper.collapse_energy = EnergyKind::F;
  if (rule != RemovalRule::patch) options.paper.removal = Removal::none;
  if (rule != RemovalRule::short_edge) options.paper.collapse_from = {};
  return options;
}

const Recording& patch_test_run(Unknowns unknowns) {
  const auto run = [](Unknowns moving) {
    return record(dense_horseshoe(), immediate_options(moving, RemovalRule::patch), Keep::sweeps);
  };
  static const Recording positions = run(Unknowns::positions);
  static const Recording both = run(Unknowns::positions_and_weights);
  return unknowns == Unknowns::positions ? positions : both;
}

Removals removals(const Recording& run) {
  Removals by_iteration;
  for (const TraceEvent& e : run.events) {
    if (e.kind == EventKind::collapse || e.kind == EventKind::removal) by_iteration[e.sweep - 1].push_back(e.vertex);
  }
  return by_iteration;
}

std::set<VertexId> all_of(const Removals& removals) {
  std::set<VertexId> all;
  for (const auto& [iteration, vertices] : removals) all.insert(vertices.begin(), vertices.end());
  return all;
}

double mean_iteration(const Removals& removals) {
  double sum = 0, count = 0;
  for (const auto& [iteration, vertices] : removals) {
    sum += iteration * static_cast<double>(vertices.size());
    count += static_cast<double>(vertices.size());
  }
  return count > 0 ? sum / count : 0;
}

const std::vector<RuleComparison>& rule_comparisons(Effort effort) {
  if (effort == Effort::full) {
    static const std::vector<RuleComparison> full = compare(Effort::full);
    return full;
  }
  static const std::vector<RuleComparison> reduced = compare(Effort::reduced);
  return reduced;
}

std::string removal_panels(const Recording& run, double weight_scale) {
  std::vector<std::string> panels;
  for (const auto& [iteration, vertices] : removals(run)) {
    const Moment& m = run.begin_of(iteration);
    MeshPicture picture;
    picture.title = "iteration " + std::to_string(iteration) + ": " + std::to_string(vertices.size()) + " of " +
                    std::to_string(m.mesh.n_vertices()) + " vertices go";
    picture.weight_scale = weight_scale;
    for (const VertexId v : vertices) picture.marks.push_back({m.mesh.position(m.find(v)), MarkColor::removed});
    panels.push_back(mesh_picture_svg(m.mesh, picture));
  }
  MeshPicture last;
  last.title = "final mesh: " + std::to_string(run.result.n_vertices()) +
               " vertices, E_BP = " + digits(run.report.objective_after);
  last.weight_scale = weight_scale;
  panels.push_back(mesh_picture_svg(run.result, last));
  return grid_svg(panels, std::min(panels.size(), kColumns));
}

Table removal_table(const Recording& run) {
  Table t{
      "Vertices removed by iteration, and the mesh at its end.",
      {"iteration", "removed", "vertices", "E_BP", "E_BP a triangle", "well-centered", "least angle", "greatest angle"},
      {}};
  const auto add = [&](const std::string& iteration, const std::string& removed, const Mesh& mesh) {
    const Quality q = quality(mesh);
    t.rows.push_back({iteration, removed, digits(q.vertices),
                      digits(total_energy(mesh, model_of("BP", dense_horseshoe()))), digits(mean_energy(mesh), 3),
                      digits(q.well_centered_fraction, 3), digits(q.min_angle_deg, 3) + "°",
                      digits(q.max_angle_deg, 4) + "°"});
  };
  add("input", "", dense_horseshoe());
  for (const auto& [iteration, vertices] : removals(run)) {
    add(std::to_string(iteration), digits(vertices.size()), run.begin_of(iteration + 1).mesh);
  }
  add("final, " + std::to_string(run.report.sweeps - 1), "", run.result);
  return t;
}

Claim coarse_but_good(Unknowns unknowns, const std::string& figure) {
  const Mesh& coarse = patch_test_run(unknowns).result;
  const Mesh full = record(dense_horseshoe(), immediate_options(unknowns, RemovalRule::none), Keep::outer).result;
  const Quality before = quality(dense_horseshoe()), after = quality(coarse), kept = quality(full);
  const double e0 = mean_energy(dense_horseshoe()), e1 = mean_energy(coarse), e_kept = mean_energy(full);
  const bool valid = after.inverted_triangles == 0 && after.non_regular_edges == 0;
  const auto course = [](const std::string& from, const std::string& to, const std::string& without) {
    return from + " → " + to + " (without removals " + without + ")";
  };
  return {figure,
          "The patch test gives a coarse mesh of high quality.",
          "coarse but high quality",
          "vertices " + digits(before.vertices) + " → " + digits(after.vertices) + ", least angle " +
              course(digits(before.min_angle_deg, 3) + "°", digits(after.min_angle_deg, 3) + "°",
                     digits(kept.min_angle_deg, 3) + "°") +
              ", well-centered " +
              course(digits(before.well_centered_fraction, 2), digits(after.well_centered_fraction, 2),
                     digits(kept.well_centered_fraction, 2)) +
              ", E_BP a triangle " + course(digits(e0, 3), digits(e1, 3), digits(e_kept, 3)),
          valid && 3 * after.vertices < 2 * before.vertices &&
              after.min_angle_deg > std::max(before.min_angle_deg, kept.min_angle_deg) &&
              after.well_centered_fraction > std::max(before.well_centered_fraction, kept.well_centered_fraction) &&
              e1 < std::min(e0, e_kept),
          "Preference than the input, and worse than without removals: where sums are compared a removal may raise the "
          "energy a "
          "triangle. Asked for: a third of the vertices gone, no edge to flip, and a greater least angle, a greater "
          "part of "
          "triangles well-centered and less energy a triangle than in the input and than the same optimization reaches "
          "without removals. The boundary vertices, which may not go, keep the angles at the feet sharp."};
}

}  // namespace temper::gallery
