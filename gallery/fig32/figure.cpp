// Figure 32: the summary, computed: which energies end in a good mesh, with and without weights, with and without
// removals.
#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/closeness.hpp"
#include "experiments/domain.hpp"
#include "experiments/energies.hpp"
#include "experiments/high_heat.hpp"
#include "experiments/mesh_picture.hpp"
#include "experiments/summary_matrix.hpp"
#include "experiments/text.hpp"
#include "figures.hpp"
#include "plot/plot.hpp"
#include "reading.hpp"
#include "temper/quality.hpp"

namespace temper::gallery::fig32 {
namespace {

constexpr std::array<std::string_view, 3> kRuleNames = {"no removal", "short edges", "patch test"};
constexpr std::array<std::string_view, 2> kUnknownNames = {"positions", "positions and weights"};

// --- the table as a picture ------------------------------------------------------------------------

constexpr double kLabelWidth = 70, kCellWidth = 128, kCellHeight = 46, kHeadHeight = 52;

std::string_view tint(Verdict verdict) {
  constexpr std::array<std::string_view, kVerdicts> kTints = {"#f2a58a", "#f6c9a4", "#fdf0b5", "#b9cdea"};
  return kTints[static_cast<std::size_t>(verdict)];
}

std::string text_at(double x, double y, std::string_view text, std::string_view style = "") {
  return "<text text-anchor=\"middle\" x=\"" + digits(x, 6) + "\" y=\"" + digits(y, 6) + "\" " + std::string(style) +
         ">" + std::string(text) + "</text>\n";
}

/// "E" with what follows set lower.
std::string lowered(std::string_view energy) {
  const std::string name = symbol(energy);
  return "E<tspan dy=\"4\" font-size=\"11\">" + name.substr(2) + "</tspan>";
}

std::string agreement(const Cell& cell) {
  return digits(cell.count(cell.verdict())) + " of " + digits(cell.endings.size()) + " orders";
}

std::string cell_svg(const Cell& cell, double x, double y) {
  return "<rect x=\"" + digits(x, 6) + "\" y=\"" + digits(y, 6) + "\" width=\"" + digits(kCellWidth, 6) +
         "\" height=\"" + digits(kCellHeight, 6) + "\" fill=\"" + std::string(tint(cell.verdict())) +
         "\" stroke=\"#ffffff\" stroke-width=\"2\"/>\n" +
         text_at(x + kCellWidth / 2, y + 20, name(cell.verdict()), "font-weight=\"600\"") +
         text_at(x + kCellWidth / 2, y + 36, agreement(cell), "font-size=\"11\" fill=\"#444444\"");
}

std::string summary_svg(const Matrix& matrix) {
  const double width = kLabelWidth + kCellWidth * static_cast<double>(kUnknowns.size() * kRules.size());
  const double height = kHeadHeight + kCellHeight * static_cast<double>(kFiveEnergies.size());
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + digits(width, 6) + "\" height=\"" +
                    digits(height, 6) + "\" viewBox=\"0 0 " + digits(width, 6) + " " + digits(height, 6) +
                    "\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"14\">\n";
  const double group = kCellWidth * static_cast<double>(kRules.size());
  for (std::size_t u = 0; u < kUnknowns.size(); ++u) {
    const double left = kLabelWidth + group * static_cast<double>(u);
    svg += text_at(left + group / 2, 18, kUnknownNames[u], "font-weight=\"600\"");
    for (std::size_t r = 0; r < kRules.size(); ++r) {
      svg += text_at(left + kCellWidth * (static_cast<double>(r) + 0.5), 42, kRuleNames[r]);
    }
  }
  for (std::size_t i = 0; i < matrix.cells.size(); ++i) {
    const std::size_t columns = kUnknowns.size() * kRules.size(), row = i / columns, column = i % columns;
    const double y = kHeadHeight + kCellHeight * static_cast<double>(row);
    if (column == 0) svg += text_at(kLabelWidth / 2, y + 28, lowered(matrix.cells[i].energy));
    svg += cell_svg(matrix.cells[i], kLabelWidth + kCellWidth * static_cast<double>(column), y);
  }
  return svg + "</svg>\n";
}

std::string mesh_svg(const Cell& cell) {
  const Ending& e = cell.endings.front();
  MeshPicture picture;
  picture.width = 180;
  picture.title = symbol(cell.energy) + ", " +
                  (cell.unknowns == Unknowns::positions ? std::string("x") : std::string("x and w")) + ", " +
                  std::string(kRuleNames[static_cast<std::size_t>(cell.rule)]);
  picture.footer = std::string(name(e.verdict)) + ", " + std::to_string(e.mesh.n_vertices()) + " vertices";
  picture.weight_scale = 0.25;
  for (Mark mark : closeness_marks(e.mesh)) picture.marks.push_back(mark);
  return mesh_picture_svg(e.mesh, picture);
}

std::string meshes_svg(const Matrix& matrix) {
  std::vector<std::string> svgs;
  for (const Cell& cell : matrix.cells) svgs.push_back(mesh_svg(cell));
  return grid_svg(svgs, kUnknowns.size() * kRules.size());
}

// --- tables -----------------------------------------------------------------------------------------

std::string counts_of(const Cell& cell) {
  std::string text;
  for (std::size_t i = 0; i < kVerdicts; ++i) {
    const auto verdict = static_cast<Verdict>(i);
    if (cell.count(verdict) == 0) continue;
    text += (text.empty() ? "" : ", ") + std::string(name(verdict)) + " " + digits(cell.count(verdict));
  }
  return text;
}

Table verdict_table(const Matrix& matrix, const std::string& caption) {
  Table t{caption, {"energy"}, {}};
  for (const std::string_view unknowns : kUnknownNames) {
    for (const std::string_view rule : kRuleNames) t.header.push_back(std::string(unknowns) + ": " + std::string(rule));
  }
  for (const std::string_view energy : kFiveEnergies) {
    std::vector<std::string> row = {symbol(energy)};
    for (const Unknowns unknowns : kUnknowns) {
      for (const RemovalRule rule : kRules) row.push_back(counts_of(matrix.at(energy, unknowns, rule)));
    }
    t.rows.push_back(row);
  }
  return t;
}

/// The dense horseshoe by a method that is not the paper's.
struct Baseline {
  std::string name;
  Mesh mesh;
};

Baseline baseline(std::string name, const OptimizeOptions& options) {
  Baseline b{std::move(name), dense_horseshoe()};
  if (!optimize(b.mesh, options)) b.mesh = dense_horseshoe();
  return b;
}

/// What HOT is compared with elsewhere (§1.2): positions alone, edges Delaunay. And E_BP without removals.
const std::vector<Baseline>& baselines() {
  static const std::vector<Baseline> all = [] {
    OptimizeOptions barrier;
    barrier.repair = Repair::none;
    OptimizeOptions positions = barrier;
    positions.unknowns = Unknowns::positions;
    return std::vector<Baseline>{
        baseline("ODT, positions", *options_for("odt")), baseline("CVT, positions", *options_for("cvt")),
        baseline("E_BP, positions", positions), baseline("E_BP, positions and weights", barrier)};
  }();
  return all;
}

Claim barriers_against_baselines() {
  const auto good = [](const Baseline& b) { return quality(b.mesh).well_centered_fraction; };
  const auto& all = baselines();
  std::string found;
  for (const Baseline& b : all) found += (found.empty() ? "" : ", ") + b.name + ": " + digits(100 * good(b), 3) + " %";
  return {"1.2",
          "ODT and CVT leave more triangles of the dense horseshoe without their orthocenter than E_BP does.",
          "not compared",
          "well-centered " + found,
          std::max(good(all[0]), good(all[1])) < std::min(good(all[2]), good(all[3])),
          "temper's own way: Newton steps, flips at once, no removals; γ of E_BP shrinks to 0.003 ℓ. Input: " +
              digits(100 * quality(dense_horseshoe()).well_centered_fraction, 3) + " %.",
          Author::temper};
}

/// Positions and weights: final numbers of the runs that the paper's figures show.
Table energy_table(const Matrix& matrix) {
  struct Row {
    std::string name, paper;
    const Mesh& mesh;
  };
  const auto mesh_of = [&](std::string_view energy, RemovalRule rule) -> const Mesh& {
    return matrix.at(energy, Unknowns::positions_and_weights, rule).endings.front().mesh;
  };
  std::vector<Row> rows = {
      {"input", "fig. 11", dense_horseshoe()},
      {"E_T, no removal", "fig. 18: a good mesh", mesh_of("T", RemovalRule::none)},
      {"E_T, short edges", "§7: a good mesh", mesh_of("T", RemovalRule::short_edge)},
      {"E_BP, no removal", "fig. 18: a good mesh", mesh_of("BP", RemovalRule::none)},
      {"E_BP, short edges, weights from iteration 40", "fig. 29: five vertices fewer, regular", high_heat_bp().result},
      {"E_BHs, short edges, weights from iteration 40", "fig. 29: as E_BP", high_heat_bhs().result},
      {"E_BP, patch test", "fig. 31: coarse, of high quality", patch_test_run(Unknowns::positions_and_weights).result},
  };
  for (const Baseline& b : baselines()) rows.push_back({b.name + ", temper's own way", "§1.2: not compared", b.mesh});
  Table t{
      "Final meshes, positions and weights where nothing else is said, energies of ★1, γ = 1. The paper gives no "
      "numbers with these "
      "figures.",
      {"run", "paper", "E_F", "E_T", "E_∂T", "E_BP", "vertices", "well-centered", "nearly coincident",
       "non-regular edges"},
      {}};
  for (const Row& row : rows) {
    const Quality q = quality(row.mesh);
    const auto energy = [&](EnergyKind kind) { return digits(q.energy[static_cast<std::size_t>(kind)][1]); };
    t.rows.push_back({row.name, row.paper, energy(EnergyKind::F), energy(EnergyKind::T), energy(EnergyKind::dT),
                      energy(EnergyKind::BP), digits(q.vertices), digits(q.well_centered_fraction, 3),
                      digits(close_pairs(row.mesh).size()), digits(q.non_regular_edges)});
  }
  return t;
}

// --- claims -----------------------------------------------------------------------------------------

/// Runs of some cells, by verdict.
struct Tally {
  std::size_t runs = 0;
  std::array<std::size_t, kVerdicts> by = {};
  [[nodiscard]] std::size_t operator[](Verdict v) const { return by[static_cast<std::size_t>(v)]; }
  [[nodiscard]] std::string text() const {
    std::string all;
    for (std::size_t i = kVerdicts; i-- > 0;) {
      if (by[i] == 0) continue;
      all += (all.empty() ? "" : ", ") + std::string(name(static_cast<Verdict>(i))) + " in " + digits(by[i]);
    }
    return "of " + digits(runs) + " runs: " + all;
  }
};

Tally tally(const Matrix& matrix, const std::function<bool(const Cell&)>& asked) {
  Tally t;
  for (const Cell& cell : matrix.cells) {
    if (!asked(cell)) continue;
    for (const Ending& e : cell.endings) ++t.runs, ++t.by[static_cast<std::size_t>(e.verdict)];
  }
  return t;
}

bool is_barrier(const Cell& c) { return std::ranges::find(kBarriers, c.energy) != kBarriers.end(); }
bool is_unbounded(const Cell& c) { return c.energy == "F" || c.energy == "dT"; }
bool moves_only(const Cell& c) { return c.unknowns == Unknowns::positions; }

constexpr const char* kHow =
    "Dense horseshoe, Algorithm 1 with deferred flips and weights from iteration 0, each setting with several vertex "
    "orders. No step turns a triangle over. ";

Claim positions_collapse(const Matrix& m) {
  const Tally t =
      tally(m, [](const Cell& c) { return !is_barrier(c) && moves_only(c) && c.rule == RemovalRule::none; });
  return {"32",
          "Optimizing positions under E_F, E_∂T or E_T without removal leads to nearly coincident nodes.",
          "collapsed nodes",
          t.text(),
          t.runs > 0 && 2 * t[Verdict::collapsed] > t.runs,
          std::string(kHow) + "Nearly coincident: nearer than " + digits(kNearlyCoincident, 2) +
              " of the shorter edge beside the neighbor."};
}

Claim weights_mess(const Matrix& m, const Matrix& inverting) {
  const auto asked = [](const Cell& c) { return is_unbounded(c) && !moves_only(c) && c.rule == RemovalRule::none; };
  const Tally t = tally(m, asked), with = tally(inverting, asked);
  return {"32",
          "Optimizing weights under E_F or E_∂T can produce a HOT mess.",
          "a HOT mess with large weights and inverted elements",
          t.text() + "; with inversions allowed " + with.text(),
          t.runs > 0 && 2 * t[Verdict::mess] > t.runs && 2 * with[Verdict::mess] > with.runs,
          std::string(kHow) + "A mess: inverted triangles, or an energy a thousand times the input's."};
}

Claim removal_saves_positions(const Matrix& m, const Matrix& inverting) {
  const auto asked = [](const Cell& c) { return !is_barrier(c) && moves_only(c) && c.rule == RemovalRule::short_edge; };
  const Tally t = tally(m, asked);
  return {"32",
          "Explicit collapses make every energy work when positions alone are optimized.",
          "works",
          t.text(),
          t.runs > 0 && t[Verdict::good] == t.runs,
          std::string(kHow) +
              "The outer iterations may still oscillate (figure 20); the mesh after the last flips is judged. With "
              "inversions "
              "allowed, " +
              tally(inverting, asked).text() + "."};
}

Claim removal_does_not_save_weights(const Matrix& m) {
  const Tally t =
      tally(m, [](const Cell& c) { return is_unbounded(c) && !moves_only(c) && c.rule != RemovalRule::none; });
  return {"32",
          "With weights, E_F and E_∂T can still end in a HOT mess although vertices are removed.",
          "can still",
          t.text(),
          t.runs > 0 && t[Verdict::mess] > 0,
          kHow};
}

/// E_T with weights and short-edge collapses once more, hidden vertices removed: runs that end in a good mesh.
Tally theory_based_without_hidden(Effort effort) {
  Tally t;
  for (const Ending& e :
       endings("T", Unknowns::positions_and_weights, RemovalRule::short_edge, HiddenPolicy::remove, effort)) {
    ++t.runs, ++t.by[static_cast<std::size_t>(e.verdict)];
  }
  return t;
}

Claim theory_based_works(const Matrix& m, Effort effort) {
  const Tally t =
      tally(m, [](const Cell& c) { return c.energy == "T" && !moves_only(c) && c.rule == RemovalRule::short_edge; });
  return {"32",
          "E_T with collapses is sufficient for a good mesh, weights included.",
          "sufficient",
          t.text(),
          t[Verdict::mess] == 0 && t[Verdict::collapsed] == 0 && 2 * t[Verdict::good] > t.runs,
          std::string(kHow) + "Runs that end in a HOT mess: " + digits(t[Verdict::mess]) +
              "; weights may hide a vertex. With hidden vertices removed at the flips, " +
              theory_based_without_hidden(effort).text() + "."};
}

constexpr const char* kBarrierRuns =
    "E_BP and E_BHs with and without weights, without removals, with short-edge collapses and with the patch test, in "
    "several vertex orders.";

Claim barriers_always_work(const Matrix& m) {
  const Tally t = tally(m, is_barrier);
  return {"32",
          "The pseudo-barrier always works, and can be combined with removals; so does the shifted barrier.",
          "always works",
          t.text(),
          t.runs > 0 && t[Verdict::good] == t.runs,
          std::string(kBarrierRuns) + " No step turns a triangle over."};
}

/// As Algorithm 5 is printed: its searches are limited by the patch radius alone, and an inverted triangle with 0 < d <
/// ℓ is in the domain of E_BP, with h > h° in that of E_BHs (§4).
Claim barriers_work_by_themselves(const Matrix& inverting) {
  const Tally t = tally(inverting, is_barrier);
  return {"7 Conclusion",
          "E_BP is stable in all combinations of weights, positions, flips and collapses, by its barrier alone.",
          "stable in all combinations",
          t.text(),
          t.runs > 0 && t[Verdict::good] == t.runs,
          std::string(kBarrierRuns) +
              " Searches may turn triangles over: E_BP has any h in its domain (§4), and γ = 1 is no barrier for "
              "triangles of size 0.1. That it is stable needs searches that end before an inversion."};
}

/// The energies E_BP that a number of iterations reaches when weights join at i_w; one energy for each vertex order.
struct Delay {
  int weights_from = 0;
  std::vector<double> energies;
  std::size_t collapses = 0;
  [[nodiscard]] double mean() const {
    return std::accumulate(energies.begin(), energies.end(), 0.0) / static_cast<double>(energies.size());
  }
};

std::vector<Delay> delays(Effort effort, int sweeps) {
  std::vector<VertexOrder> orders = vertex_orders(effort == Effort::full ? 2 : 0);
  if (effort == Effort::reduced) orders.resize(2);
  std::vector<Delay> all;
  for (const int from : {0, 2, 4, 40}) {
    Delay d{from, {}, 0};
    for (const VertexOrder& order : orders) {
      OptimizeOptions options = high_heat_options("BP");
      options.paper.weights_from = from;
      visit_in(order, options);
      options.max_sweeps = sweeps;
      Mesh mesh = dense_horseshoe();
      const auto report = optimize(mesh, as_read(options));
      d.energies.push_back(report ? report->objective_after : std::numeric_limits<double>::infinity());
      d.collapses += report ? report->vertices_removed : 0;
    }
    all.push_back(d);
  }
  return all;
}

Claim later_weights_are_better(Effort effort) {
  const int sweeps = effort == Effort::full ? 150 : 50;
  const std::vector<Delay> all = delays(effort, sweeps);
  const Delay& none = all.front();
  std::string found;
  std::size_t better = 0, less_energy = 0, pairs = 0;
  for (const Delay& d : all) {
    found += (found.empty() ? "" : "; ") + ("from " + std::to_string(d.weights_from)) + ": " + digits(d.mean()) + ", " +
             digits(d.collapses) + " collapses";
    if (d.weights_from == 0) continue;
    if (d.mean() < none.mean() && d.collapses >= none.collapses) ++better;
    for (std::size_t i = 0; i < d.energies.size(); ++i, ++pairs)
      less_energy += d.energies[i] < none.energies[i] ? 1 : 0;
  }
  return {"7 Conclusion",
          "Weights should join only after a few position iterations: often more collapses, faster convergence, better "
          "quality.",
          "often",
          "mean E_BP after " + std::to_string(sweeps) + " iterations, weights " + found,
          2 * better > all.size() - 1,
          "Short-edge collapses, deferred flips, " + digits(none.energies.size()) +
              " vertex orders. Less energy and no fewer collapses than without delay for " + digits(better) + " of " +
              digits(all.size() - 1) + " delays; less energy in " + digits(less_energy) + " of " + digits(pairs) +
              " pairs of runs. Two or four iterations change little; what helps is to let positions converge and flip "
              "once before."};
}

}  // namespace

Page make(Effort effort) {
  const Matrix& matrix = summary_matrix(effort, Inversion::refuse);
  const Matrix& inverting = summary_matrix(effort, Inversion::allow);
  return {
      {{"fig32", summary_svg(matrix),
        "How runs on the dense horseshoe end, by energy, unknowns and rule of removal: what most vertex orders give, "
        "and how many. Computed from the final meshes; no step turns a triangle over."},
       {"fig32_meshes", meshes_svg(matrix),
        "The final meshes, vertices visited as numbered: x positions, w weights. Red and yellow: nearly coincident "
        "vertices. Weight circles at a quarter of their radius."}},
      {verdict_table(matrix, "Runs by verdict; no step turns a triangle over."),
       verdict_table(inverting, "The same with inversions allowed: steps are limited by the patch radius alone."),
       energy_table(matrix)},
      {positions_collapse(matrix), weights_mess(matrix, inverting), removal_saves_positions(matrix, inverting),
       removal_does_not_save_weights(matrix), theory_based_works(matrix, effort), barriers_always_work(matrix),
       barriers_work_by_themselves(inverting), later_weights_are_better(effort), barriers_against_baselines()}};
}

}  // namespace temper::gallery::fig32
