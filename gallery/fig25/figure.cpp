// Figure 25: positions and weights from the mesh that oscillates, flips deferred. Under E_∂T a HOT mess, unless
// searches stop at the flip; under E_T a good mesh without limits.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "experiments/mesh_picture.hpp"
#include "experiments/oscillating_horseshoe.hpp"
#include "experiments/text.hpp"
#include "figures.hpp"
#include "plot/plot.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/energy.hpp"
#include "temper/regularity.hpp"

namespace temper::gallery::fig25 {
namespace {

// Positions, then weights, sweep by sweep with deferred flips, from the mesh that oscillates (figure 25): Algorithm 1
// with all positions first, so that it can be seen what each does. How far a search for a weight reaches decides
// whether it leaves a local minimum for the unbounded side.

struct PositionWeightLoop {
  EnergyKind energy = EnergyKind::dT;
  double weight_search_radius = 1;  ///< greatest change of a weight in one search, over r²
  bool limited = false;             ///< searches stop after the next flip: overshoot 1.1, 1.01, …
};

/// A mesh of the run.
struct LoopStage {
  std::string name;  ///< "positions 1", "weights 1", "flips 1": after that part of the first sweep
  Mesh mesh;
  double energy = 0;
  std::size_t inverted = 0;     ///< triangles
  std::size_t non_regular = 0;  ///< edges; 0 where triangles are inverted
  double largest_weight = 0;
};

std::size_t count_inverted(const Mesh& mesh) {
  std::size_t count = 0;
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    if (orient2d(mesh.position(a), mesh.position(b), mesh.position(c)) != Sign::positive) ++count;
  }
  return count;
}

LoopStage stage(std::string name, const Mesh& mesh, EnergyKind energy) {
  EnergyModel model;
  model.kind = energy;
  LoopStage s{std::move(name), mesh, total_energy(mesh, model), count_inverted(mesh), 0, 0};
  if (s.inverted == 0) s.non_regular = count_non_regular_edges(mesh);
  for (const VertexId v : mesh.vertices()) s.largest_weight = std::max(s.largest_weight, std::abs(mesh.weight(v)));
  return s;
}

OptimizeOptions options_of(const PositionWeightLoop& loop, const VertexOrder& order, int sweeps) {
  OptimizeOptions options = positions_and_collapses();
  options.energy = loop.energy;
  options.unknowns = Unknowns::positions_and_weights;
  options.paper.collapse_from = {};
  options.paper.anchor = {};
  options.paper.inversion = Inversion::allow;
  options.paper.visits = Visits::twice;
  options.paper.weight_search_radius = loop.weight_search_radius;
  options.paper.flip_limit = loop.limited ? FlipLimit::after : FlipLimit::unlimited;
  options.paper.inner = 1;
  options.paper.outer = 0;
  options.paper.stopping = StoppingRule::relative;  // a rise ends the paper's
  options.paper.tolerance = 0;
  options.max_sweeps = sweeps;
  visit_in(order, options);
  return options;
}

/// The mesh after the positions of a sweep, counted from 1: all events up to the last move of it.
Mesh after_positions(const Recording& run, int sweep) {
  std::size_t end = 0;
  for (std::size_t i = 0; i < run.events.size(); ++i) {
    if (run.events[i].sweep < sweep || (run.events[i].sweep == sweep && run.events[i].kind == EventKind::move))
      end = i + 1;
  }
  auto mesh = replay(run.moments.front().mesh, std::span(run.events).first(end));
  return mesh ? *std::move(mesh) : Mesh();
}

/// The stages of up to so many sweeps; it ends with the sweep after which a triangle is inverted, for flips cannot make
/// such a mesh regular.
std::vector<LoopStage> run_loop(const PositionWeightLoop& loop, const Mesh& start, const VertexOrder& order,
                                int sweeps) {
  const Recording run = record(start, options_of(loop, order, sweeps), Keep::sweeps);
  std::vector<LoopStage> stages = {stage("start", start, loop.energy)};
  for (const Moment& m : run.moments) {
    if (m.kind == Snapshot::Moment::after_sweep) {
      const std::string number = std::to_string(m.sweep);
      stages.push_back(stage("positions " + number, after_positions(run, m.sweep), loop.energy));
      stages.push_back(stage("weights " + number, m.mesh, loop.energy));
    } else if (m.kind == Snapshot::Moment::after_flips) {
      stages.push_back(stage("flips " + std::to_string(m.sweep), m.mesh, loop.energy));
    }
  }
  return stages;
}

constexpr double kShownReach = 4;  // over r²
constexpr int kShownSweeps = 20;

struct Policy {
  std::string name;
  EnergyKind energy = EnergyKind::dT;
  bool limited = false;
};
const Policy kMess{"E_∂T, unlimited", EnergyKind::dT, false};
const Policy kLimited{"E_∂T, limited", EnergyKind::dT, true};
const Policy kTheory{"E_T, unlimited", EnergyKind::T, false};

std::vector<LoopStage> stages(const Policy& policy, double reach, const VertexOrder& order, int sweeps) {
  return run_loop({policy.energy, reach, policy.limited}, oscillating_mesh(), order, sweeps);
}

const std::vector<LoopStage>& mess() {
  static const std::vector<LoopStage> run = stages(kMess, kShownReach, shown_order(), kShownSweeps);
  return run;
}

const LoopStage& stage(const std::vector<LoopStage>& run, const std::string& name) {
  const auto found = std::ranges::find(run, name, &LoopStage::name);
  return found == run.end() ? run.back() : *found;
}

// --- pictures --------------------------------------------------------------------------------------------

std::string panel(const LoopStage& s, const std::string& title, double weight_scale, const Box& box) {
  MeshPicture picture;
  picture.title = title;
  picture.footer = "E = " + digits(s.energy) + ", " + digits(s.inverted) +
                   " triangles inverted, max |w| = " + digits(s.largest_weight, 2);
  picture.width = 380;
  picture.weight_scale = weight_scale;
  picture.box = box;
  return mesh_picture_svg(s.mesh, picture);
}

Picture panels() {
  constexpr Box kWide = {{-3.4, -1.4}, {3.4, 5.4}}, kNear = {{-2.3, -0.3}, {2.3, 4.3}};
  constexpr double kQuarter = 0.25;
  const LoopStage limited = stages(kLimited, kShownReach, shown_order(), kShownSweeps).back();
  const LoopStage theory = stages(kTheory, kShownReach, shown_order(), kShownSweeps).back();
  const std::vector<std::string> svgs = {panel(stage(mess(), "weights 1"), "E∂T: after the first weights", 1, kWide),
                                         panel(stage(mess(), "positions 2"), "E∂T: after the next positions", 1, kWide),
                                         panel(limited, "E∂T, limited to the flip threshold", kQuarter, kNear),
                                         panel(theory, "ET, unlimited", kQuarter, kNear)};
  return {
      "fig25", grid_svg(svgs, 2),
      "Positions, then weights, flips after each sweep, from the mesh at the lower right of figure 20. Above, radii to "
      "scale: the first weights turn dual edges over, then positions turn triangles over (pink). Below, a quarter of "
      "√|w|, after " +
          std::to_string(kShownSweeps) + " sweeps. A search changes a weight by at most 4 r²."};
}

// --- over reaches and vertex orders ------------------------------------------------------------------------

struct Tally {
  Policy policy;
  double reach = 0;
  std::size_t runs = 0, tangled = 0, irregular = 0, higher = 0;
  double greatest = 0;  ///< energy at the end, of runs without inverted triangles
  double largest_weight = 0;
  [[nodiscard]] bool good() const { return runs > 0 && tangled + irregular + higher == 0; }
};

void add(const std::vector<LoopStage>& run, Tally& tally) {
  ++tally.runs;
  const bool tangled = std::ranges::any_of(run, [](const LoopStage& s) { return s.inverted > 0; });
  for (const LoopStage& s : run) tally.largest_weight = std::max(tally.largest_weight, s.largest_weight);
  if (tangled) {
    ++tally.tangled;
    return;
  }
  tally.irregular += run.back().non_regular > 0 ? 1 : 0;
  tally.higher += run.back().energy < run.front().energy ? 0 : 1;
  tally.greatest = std::max(tally.greatest, run.back().energy);
}

std::vector<Tally> tallies(Effort effort) {
  const bool full = effort == Effort::full;
  const std::vector<double> reaches = full ? std::vector<double>{1, 2, 4, 8} : std::vector<double>{1, 4};
  std::vector<Tally> all;
  for (const double reach : reaches) {
    for (const Policy& policy : {kMess, kLimited, kTheory}) {
      Tally tally{policy, reach};
      for (const VertexOrder& order : vertex_orders(full ? 5 : 1)) {
        if (order.order != SweepOrder::hilbert) add(stages(policy, reach, order, kShownSweeps), tally);
      }
      all.push_back(tally);
    }
  }
  return all;
}

const Tally& find(const std::vector<Tally>& all, const Policy& policy, double reach) {
  return *std::ranges::find_if(all, [&](const Tally& t) { return t.policy.name == policy.name && t.reach == reach; });
}

Table table(const std::vector<Tally>& all) {
  Table t{
      "How often runs end as a mess (some triangle inverted), by the greatest change of a weight in one search, over "
      "r², "
      "the mean square distance to the neighbors. The energy is the greatest that a run without a mess ends with.",
      {"searches", "reach / r²", "runs", "messes", "not regular", "energy", "largest |w|"},
      {}};
  for (const Tally& tally : all) {
    t.rows.push_back({tally.policy.name, digits(tally.reach), digits(tally.runs), digits(tally.tangled),
                      digits(tally.irregular), tally.tangled == tally.runs ? "" : digits(tally.greatest),
                      digits(tally.largest_weight, 2)});
  }
  return t;
}

// --- claims ------------------------------------------------------------------------------------------------

/// Runs with positions and weights vertex by vertex that turn a triangle over.
std::string messes_vertex_by_vertex(Effort effort) {
  std::size_t messes = 0, runs = 0;
  for (const VertexOrder& order : vertex_orders(effort == Effort::full ? 5 : 0)) {
    OptimizeOptions options = positions_and_collapses();
    options.unknowns = Unknowns::positions_and_weights;
    options.paper.collapse_from = {};
    visit_in(order, options);
    options.paper.inner = 1;
    options.paper.outer = 0;
    options.max_sweeps = kShownSweeps;
    options.paper.inversion = Inversion::allow;
    messes += record(oscillating_mesh(), options, Keep::outer).report.stopped == Stopped::tangled ? 1 : 0;
    ++runs;
  }
  return digits(messes) + " of " + digits(runs);
}

Claim makes_a_mess(const std::vector<Tally>& all, Effort effort) {
  const Tally &far = find(all, kMess, kShownReach), &near = find(all, kMess, 1);
  return {
      "25",
      "Positions and weights under E_∂T with deferred flips lead to a HOT mess.",
      "a HOT mess",
      digits(far.tangled) + " of " + digits(far.runs) + " runs with weight searches up to " + digits(kShownReach) +
          " r², weights up to " + digits(far.largest_weight, 2) + "; " + digits(near.tangled) + " of " +
          digits(near.runs) + " up to r²",
      far.runs > 0 && far.tangled == far.runs,
      "It is the reach of the search that decides: farther out E_∂T is lower than at the local minimum. The paper does "
      "not give its reach for weights. With each weight right after its position, up to r², " +
          messes_vertex_by_vertex(effort) + " end as a mess."};
}

Claim duals_first() {
  const LoopStage &positions = stage(mess(), "positions 1"), &weights = stage(mess(), "weights 1");
  const LoopStage& next = stage(mess(), "positions 2");
  return {"25",
          "The first weight iteration inverts dual elements, the position iterations after it primal ones.",
          "first dual, then primal",
          "edges not regular: " + digits(positions.non_regular) + " before the first weights, " +
              digits(weights.non_regular) + " after; triangles inverted: " + digits(weights.inverted) + ", and " +
              digits(next.inverted) + " after the next positions",
          weights.non_regular > positions.non_regular && weights.inverted == 0 && next.inverted > 0,
          "The pictured run. Its energy goes from " + digits(mess().front().energy) + " to " + digits(weights.energy) +
              " and " + digits(next.energy) + "."};
}

Claim is_good(const std::vector<Tally>& all, const Policy& policy, const std::string& claim) {
  std::size_t runs = 0, bad = 0;
  double greatest = 0, weight = 0;
  for (const Tally& t : all) {
    if (t.policy.name != policy.name) continue;
    runs += t.runs;
    bad += t.tangled + t.irregular + t.higher;
    greatest = std::max(greatest, t.greatest);
    weight = std::max(weight, t.largest_weight);
  }
  return {"25",
          claim,
          "a good mesh",
          "good in " + digits(runs - bad) + " of " + digits(runs) + " runs: energy at most " + digits(greatest) +
              ", weights at most " + digits(weight, 2),
          runs > 0 && bad == 0,
          "Good: never an inverted triangle, regular at the end, energy below the start's; whatever the vertex order "
          "and the "
          "reach of the searches."};
}

}  // namespace

Page make(Effort effort) {
  const std::vector<Tally> all = tallies(effort);
  return {{panels()},
          {table(all)},
          {makes_a_mess(all, effort), duals_first(),
           is_good(all, kLimited, "Limiting positions and weights to the flip threshold of E_∂T leads to a good mesh."),
           is_good(all, kTheory, "Under E_T the mesh is good even without limits.")}};
}

}  // namespace temper::gallery::fig25
