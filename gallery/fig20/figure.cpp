// Figure 20: the outer iterations of the run of figure 19. What converges on the extrapolated energy is no longer
// optimal after flips, and the next round undoes it: a cycle of two.
#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

#include "experiments/domain.hpp"
#include "experiments/energies.hpp"
#include "experiments/mesh_picture.hpp"
#include "experiments/numbers.hpp"
#include "experiments/oscillating_horseshoe.hpp"
#include "experiments/text.hpp"
#include "figures.hpp"
#include "plot/plot.hpp"
#include "temper/detail/geometry.hpp"

namespace temper::gallery::fig20 {
namespace {

constexpr int kRows[] = {0, 1, 2, 5, 6};           // outer iterations, as in the paper
constexpr int kFirstWithNames = 5;                 // rows that name a and b
constexpr const char* kShownCollapseEnergy = "F";  // of the pictured run
constexpr std::size_t kMany = 1000;                // longer than any run

/// Orange: the vertices of `here` that the next outer iteration removes.
void mark_collapses(const Moment& here, const Moment& next, MeshPicture& picture) {
  for (const VertexId v : here.mesh.vertices()) {
    if (next.find(here.vertices[v]).valid()) continue;
    picture.marks.push_back({here.mesh.position(v), MarkColor::collapses_next});
  }
}

void name_oscillating(const Moment& m, MeshPicture& picture) {
  const auto [a, b] = oscillating_vertices();
  picture.marks.push_back({m.mesh.position(m.find(a)), MarkColor::moving, "a"});
  picture.marks.push_back({m.mesh.position(m.find(b)), MarkColor::moving, "b"});
}

std::string panel(const Moment& m, const Moment& other, const Moment* next) {
  const bool flipped = m.kind == Snapshot::Moment::after_flips;
  MeshPicture picture;
  picture.title = "outer " + std::to_string(m.outer) + (flipped ? ", flipped" : ", optimal") + ": " +
                  std::to_string(m.mesh.n_vertices()) + " vertices, E = " + digits(m.energy);
  picture.shades = cavities(m, other);
  if (next != nullptr) mark_collapses(m, *next, picture);
  if (m.outer >= kFirstWithNames) name_oscillating(m, picture);
  return mesh_picture_svg(m.mesh, picture);
}

Picture rows() {
  const auto optimal = oscillating_run().all(Snapshot::Moment::before_flips);
  const auto flipped = oscillating_run().all(Snapshot::Moment::after_flips);
  std::vector<std::string> panels;
  for (const int row : kRows) {
    const auto i = static_cast<std::size_t>(row);
    if (i >= flipped.size()) continue;
    panels.push_back(panel(*optimal[i], *flipped[i], nullptr));
    panels.push_back(panel(*flipped[i], *optimal[i], i + 1 < optimal.size() ? optimal[i + 1] : nullptr));
  }
  return {"fig20", grid_svg(panels, 2),
          "Left, the mesh when the inner iterations have converged; right, the same mesh after flips. Purple: the "
          "cavities that flip. Orange: vertices that collapse in the next outer iteration. The last two rows repeat."};
}

Table table(const std::vector<OrderedRun>& all) {
  Table t{
      "What the runs end in, by vertex order and collapse energy: the period of the cycle (1 would be a mesh that "
      "stays), its energies after flips, and how many triangles the flips make new. When both arms flip together the "
      "energies are far apart; when one arm flips while the other flips back they are nearly equal. Paper: 3.41 and "
      "4.08.",
      {"vertex order", "E_c", "vertices", "period", "from outer iteration", "least E", "greatest E", "new triangles"},
      {}};
  for (const OrderedRun& r : all) {
    const Oscillation& o = r.oscillation;
    t.rows.push_back({r.order, symbol(r.collapse_energy), digits(o.vertices), digits(o.period), digits(o.first),
                      digits(o.low), digits(o.high), digits(o.flipped)});
  }
  return t;
}

Claim oscillates(const std::vector<OrderedRun>& all) {
  const auto with_period = [&](std::size_t least, std::size_t most) {
    return static_cast<std::size_t>(std::ranges::count_if(
        all, [=](const OrderedRun& r) { return r.oscillation.period >= least && r.oscillation.period <= most; }));
  };
  const std::size_t cycles = with_period(2, kMany), of_two = with_period(2, 2), settle = with_period(1, 1);
  return {"20",
          "With deferred flips the outer loop oscillates for ever between two meshes.",
          "the last two rows repeat ad infinitum",
          "of " + digits(all.size()) + " runs " + digits(of_two) + " end in a cycle of two meshes, " +
              digits(cycles - of_two) + " in a longer one, " + digits(settle) + " in one mesh",
          !all.empty() && cycles == all.size() && 2 * of_two > all.size(),
          "Cycles are found by connectivity alone: the triangles after flips are those of one period before, over two "
          "periods and more. The paper does not say in which order it visits the vertices, so several were tried."};
}

Claim energies_agree(const std::vector<OrderedRun>& all) {
  const auto shown = std::ranges::find_if(all, [](const OrderedRun& r) {
    return r.order == shown_order().name && r.collapse_energy == kShownCollapseEnergy;
  });
  const Oscillation o = shown == all.end() ? Oscillation() : shown->oscillation;
  return {
      "20",
      "The two states of the oscillation have global energies 3.41 and 4.08.",
      "3.41 and 4.08",
      digits(o.low) + " and " + digits(o.high) + ", after flips",
      as_in_the_paper(o),
      "Within 5 %. Which vertices have collapsed before, and so the rest of the mesh, depends on the vertex order: see "
      "the table."};
}

Claim flips_raise_energy() {
  const Oscillation o = oscillation_of(oscillating_run());
  std::size_t rises = 0;
  for (std::size_t i = 0; i < o.after.size(); ++i) rises += o.after[i] > o.before[i] ? 1 : 0;
  return {"3.2.2",
          "Flips to restore regularity can raise the energy.",
          "0.986 → 1.49 in the patch of a",
          "E rose at the flips of " + digits(rises) + " of " + digits(o.after.size()) +
              " outer iterations, in the last " + digits(o.before.back()) + " → " + digits(o.after.back()),
          rises > 0,
          "Total energies immediately before and after the same flips."};
}

Claim collapses_come_early() {
  constexpr int kEarly = 5;  // sweeps
  std::size_t early = 0, all = 0;
  int begin = 0;
  std::string lengths;  // of the outer iterations with collapses
  for (const Moment* m : oscillating_run().all(Snapshot::Moment::before_flips)) {
    const std::size_t before = all;
    for (const TraceEvent& e : oscillating_run().events) {
      if (e.kind != EventKind::collapse || e.sweep <= begin || e.sweep > m->sweep) continue;
      ++all;
      if (e.sweep <= begin + kEarly) ++early;
    }
    if (all > before) lengths += (lengths.empty() ? "" : ", ") + std::to_string(m->sweep - begin);
    begin = m->sweep;
  }
  return {"20",
          "Most collapses happen early in the inner iterations of each outer iteration.",
          "most",
          digits(early) + " of " + digits(all) + " in the first " + std::to_string(kEarly) +
              " sweeps of their outer iteration",
          2 * early > all,
          "Collapses of the pictured run; its outer iterations with collapses take " + lengths + " sweeps."};
}

/// Relative errors of the energies of meshes before flips, against the true one after them.
struct Extrapolations {
  std::vector<double> t, dt;  ///< E_T and E_∂T, of the same meshes
};
/// Of the outer iterations of runs under one of the two, positions alone.
Extrapolations extrapolations(EnergyKind optimized, Effort effort) {
  EnergyModel theory = energy_dt();
  theory.kind = EnergyKind::T;
  Extrapolations e;
  for (const VertexOrder& order : vertex_orders(effort == Effort::full ? 5 : 0)) {
    OptimizeOptions options = positions_and_collapses();
    options.energy = optimized;
    options.paper.collapse_from = {};
    options.paper.outer = 4;
    visit_in(order, options);
    const Recording run = record(dense_horseshoe(), options, Keep::outer);
    const auto before = run.all(Snapshot::Moment::before_flips), after = run.all(Snapshot::Moment::after_flips);
    for (std::size_t i = 0; i < std::min(before.size(), after.size()); ++i) {
      if (triangles_not_in(*after[i], *before[i]).empty()) continue;
      const double truth = total_energy(after[i]->mesh, theory);  // E_∂T, too: the mesh is regular
      e.t.push_back(std::abs(total_energy(before[i]->mesh, theory) - truth) / truth);
      e.dt.push_back(std::abs(total_energy(before[i]->mesh, energy_dt()) - truth) / truth);
    }
  }
  return e;
}

std::string percent(const std::vector<double>& errors) { return digits(100 * median(errors), 2) + " %"; }

Claim theory_extrapolates_better(const Extrapolations& under_t, const Extrapolations& under_dt) {
  return {"2.3",
          "Under E_T the extrapolated energy is closer to the true one after flips than under the formula's, E_∂T.",
          "closer in the experiments",
          "median error of the energy that is optimized: E_T " + percent(under_t.t) + " over " +
              digits(under_t.t.size()) + " flips of whole meshes, E_∂T " + percent(under_dt.dt) + " over " +
              digits(under_dt.dt.size()),
          !under_t.t.empty() && !under_dt.dt.empty() && median(under_t.t) < median(under_dt.dt),
          "Meshes of the dense horseshoe before and after the flips of outer iterations, positions alone, in several "
          "vertex orders."};
}

Claim theory_is_better_on_one_mesh(const Extrapolations& under_t, const Extrapolations& under_dt) {
  return {"2.3",
          "E_T of one and the same mesh before flips is closer to its true energy after them than E_∂T.",
          "left open",
          "median errors of E_T and E_∂T: meshes optimal under E_T " + percent(under_t.t) + " and " +
              percent(under_t.dt) + ", under E_∂T " + percent(under_dt.t) + " and " + percent(under_dt.dt),
          median(under_t.t) < median(under_t.dt) && median(under_dt.t) < median(under_dt.dt),
          "What E_T gains is that a search under it stays near regular meshes: it pays for negative dual lengths that "
          "E_∂T seeks. The value that it puts on them, however, is far from that of the mesh after flips.",
          Author::temper};
}

/// With an angle above that, and at least the mean area.
bool is_large_obtuse(const Mesh& mesh, TriangleId t, double degrees) {
  const auto area = [&](TriangleId u) {
    const auto [a, b, c] = mesh.corners(u);
    return doubled_area(mesh.position(a), mesh.position(b), mesh.position(c)) / 2;
  };
  double sum = 0;
  for (const TriangleId u : mesh.triangles()) sum += area(u);
  if (area(t) * static_cast<double>(mesh.n_triangles()) < sum) return false;
  const auto corners = mesh.corners(t);
  for (std::size_t k = 0; k < 3; ++k) {
    const double angle = corner_angle(mesh.position(corners[k]), mesh.position(corners[(k + 1) % 3]),
                                      mesh.position(corners[(k + 2) % 3]));
    if (angle * 180 / std::numbers::pi > degrees) return true;
  }
  return false;
}

std::size_t count_large_obtuse(const Moment& m, const std::vector<TriangleId>& triangles, double degrees) {
  return static_cast<std::size_t>(
      std::ranges::count_if(triangles, [&](TriangleId t) { return is_large_obtuse(m.mesh, t, degrees); }));
}

Claim flips_remove_obtuse() {
  constexpr double kWide = 120;  // degrees
  const auto optimal = oscillating_run().all(Snapshot::Moment::before_flips);
  const auto flipped = oscillating_run().all(Snapshot::Moment::after_flips);
  std::size_t formed = 0, gone = 0, come = 0;
  std::string found;
  const auto all = [](const Moment& m) {
    std::vector<TriangleId> triangles;
    for (const TriangleId t : m.mesh.triangles()) triangles.push_back(t);
    return triangles;
  };
  for (std::size_t i = 0; i < flipped.size(); ++i) {
    const std::size_t before = count_large_obtuse(*optimal[i], all(*optimal[i]), kWide);
    formed += before;
    gone += count_large_obtuse(*optimal[i], triangles_not_in(*optimal[i], *flipped[i]), kWide);
    come += count_large_obtuse(*flipped[i], triangles_not_in(*flipped[i], *optimal[i]), kWide);
    found +=
        (i > 0 ? ", " : "") + digits(before) + " → " + digits(count_large_obtuse(*flipped[i], all(*flipped[i]), kWide));
  }
  return {"20",
          "Large obtuse triangles are formed, but flips remove them.",
          "flips remove these",
          digits(gone) + " of " + digits(formed) +
              " go with the flips; by outer iteration, before and after flips: " + found,
          formed > 0 && gone == formed,
          "Angles above " + digits(kWide, 3) + "° in triangles of at least the mean area, in the run of figure 20. " +
              digits(come) + " others come with the flips."};
}

}  // namespace

Page make(Effort effort) {
  const std::vector<OrderedRun>& all = oscillations_by_order(effort);
  const Extrapolations under_t = extrapolations(EnergyKind::T, effort),
                       under_dt = extrapolations(EnergyKind::dT, effort);
  return {{rows()},
          {table(all)},
          {oscillates(all), energies_agree(all), flips_raise_energy(), collapses_come_early(),
           theory_extrapolates_better(under_t, under_dt), theory_is_better_on_one_mesh(under_t, under_dt),
           flips_remove_obtuse()}};
}

}  // namespace temper::gallery::fig20
