// Figure 17: positions and weights of the dense horseshoe under E_F, a HOT mess.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "experiments/dense_runs.hpp"
#include "experiments/energies.hpp"
#include "experiments/mesh_picture.hpp"
#include "experiments/text.hpp"
#include "figures.hpp"
#include "plot/plot.hpp"
#include "temper/quality.hpp"

namespace temper::gallery::fig17 {
namespace {

constexpr int kSweeps = 60;  // at most: good runs have converged, or nearly
constexpr int kReducedSweeps = 20;
constexpr int kLastRow = 6;     // the last iteration that the paper shows
constexpr double kAbsurd = 10;  // times the energy of the input, either sign

std::size_t inverted(const Mesh& mesh) { return quality(mesh).inverted_triangles; }

/// The change in a sweep of the energy of the mesh, and of the energies of the patches, step by step. Equal but for
/// rounding.
struct Change {
  int sweep = 0;
  double energy = 0;  ///< after the sweep
  double total = 0, steps = 0;
  /// To a hundredth: the energy has digits left.
  [[nodiscard]] bool sound() const { return std::abs(total - steps) <= 0.01 * std::abs(total); }
};
std::vector<Change> changes(const Recording& run) {
  std::vector<Change> all;
  double last = run.moments.empty() ? 0 : run.moments.front().energy;
  for (const Moment* m : run.all(Snapshot::Moment::after_sweep)) {
    Change change{m->sweep, m->energy, m->energy - last, 0};
    for (const TraceEvent& e : run.events) {
      const bool is_step = e.sweep == m->sweep && std::isfinite(e.after - e.before);  // not so the anchor's shift
      if (is_step && (e.kind == EventKind::move || e.kind == EventKind::weight)) change.steps += e.after - e.before;
    }
    last = m->energy;
    all.push_back(change);
  }
  return all;
}

/// The end of one run.
struct Ending {
  int sweeps = 0;
  int first_inverted = 0;  ///< sweep; 0: none
  double least = 0;        ///< energy over the sweeps
  double least_sound = 0;  ///< the same, until rounding takes over
  bool absurd = false;     ///< the energy went far beyond the input's
  [[nodiscard]] bool mess() const { return first_inverted > 0 || absurd || least < 0; }
};
Ending ending_of(const Recording& run, std::string_view energy) {
  const double start = std::abs(dense_energy(dense_horseshoe(), energy));
  Ending ending;
  for (const Moment* m : run.all(Snapshot::Moment::after_sweep)) {
    ending.sweeps = m->sweep;
    ending.least = std::min(ending.least, m->energy);
    ending.absurd = ending.absurd || !(std::abs(m->energy) < kAbsurd * start);
    if (ending.first_inverted == 0 && inverted(m->mesh) > 0) ending.first_inverted = m->sweep;
  }
  for (const Change& change : changes(run)) {
    if (!change.sound()) break;
    ending.least_sound = std::min(ending.least_sound, change.energy);
  }
  return ending;
}

/// The remedies that §6.5.2 tries.
struct Remedy {
  const char* name;
  bool delay = false;      ///< weights only when positions have converged
  bool collapses = false;  ///< short-edge collapses from iteration 0
  FlipLimit limit = FlipLimit::unlimited;
};
constexpr Remedy kNone = {"weights from iteration 0"};
constexpr Remedy kDelay = {"weights after converged positions", true};
constexpr Remedy kDelayAndCollapse = {"the same, with collapses", true, true};
constexpr Remedy kRestricted = {"the same, steps to 1.1 of the flip threshold", true, true, FlipLimit::after};
constexpr Remedy kStopsShort = {"the same, steps short of the flip threshold", true, true, FlipLimit::before};

Ending run(std::string_view energy, const VertexOrder& order, const Remedy& remedy, int sweeps) {
  Mesh mesh = dense_horseshoe();
  if (remedy.delay) {
    OptimizeOptions positions = dense_positions(energy, order);
    if (remedy.collapses) positions.paper.collapse_from = 0, positions.paper.collapse_energy = EnergyKind::F;
    mesh = record(mesh, positions, Keep::outer).moments.back().mesh;
  }
  OptimizeOptions both = dense_options(energy, order);
  if (remedy.collapses) both.paper.collapse_from = 0, both.paper.collapse_energy = EnergyKind::F;
  both.paper.flip_limit = remedy.limit;
  both.max_sweeps = sweeps;
  return ending_of(record(mesh, both, Keep::sweeps), energy);
}

/// The runs to make of each remedy.
struct Sample {
  std::vector<VertexOrder> orders;
  int sweeps = kSweeps;  ///< at most
};

/// Counts of how runs end, by remedy and energy.
struct Count {
  std::size_t all = 0, mess = 0, inverted = 0, negative = 0;
  int latest_inverted = 0;
  double least = 0, least_sound = 0;
};
Count count(std::string_view energy, const Remedy& remedy, const Sample& sample) {
  Count c;
  for (const VertexOrder& order : sample.orders) {
    const Ending e = run(energy, order, remedy, sample.sweeps);
    ++c.all;
    c.mess += e.mess();
    c.inverted += e.first_inverted > 0;
    c.negative += e.least < 0;
    c.latest_inverted = std::max(c.latest_inverted, e.first_inverted);
    c.least = std::min(c.least, e.least);
    c.least_sound = std::min(c.least_sound, e.least_sound);
  }
  return c;
}

struct Counts {
  Count f, dt;
};
Counts count_both(const Remedy& remedy, const Sample& sample) {
  return {count("F", remedy, sample), count("dT", remedy, sample)};
}

/// A run of E_F that goes on for the iterations that the paper shows. Rounding can raise such energies, which the
/// paper's rule takes for convergence: most runs end before.
struct Shown {
  std::string order;
  Recording run;
};
Shown shown_run() {
  constexpr int kTries = 40;
  for (const VertexOrder& order : vertex_orders(kTries)) {
    OptimizeOptions options = dense_options("F", order);
    options.max_sweeps = kLastRow;
    Recording recording = record(dense_horseshoe(), options, Keep::sweeps);
    if (recording.report.sweeps == kLastRow) return {order.name, std::move(recording)};
  }
  return {"as numbered", record(dense_horseshoe(), dense_options("F"), Keep::sweeps)};
}

std::string panels(const Recording& recording) {
  std::vector<std::string> svgs;
  for (const Moment& m : recording.moments) {
    const bool counts = m.kind == Snapshot::Moment::start || m.kind == Snapshot::Moment::after_sweep;
    if (!counts || (m.sweep > 2 && m.sweep != recording.report.sweeps)) continue;
    MeshPicture picture;
    picture.box = {{-2.4, -0.4}, {2.4, 4.4}};
    picture.width = 340;
    picture.dual = false;
    picture.title = "iteration " + std::to_string(m.sweep);
    picture.footer = digits(inverted(m.mesh)) + " triangles turned over";
    svgs.push_back(mesh_picture_svg(m.mesh, picture));
    picture.inverted = false;
    picture.weight_scale = 1;
    picture.title = "weights";
    picture.footer = "E_F = " + digits(m.energy, 3);
    svgs.push_back(mesh_picture_svg(m.mesh, picture));
  }
  return grid_svg(svgs, 2);
}

Claim quickly(const Count& f) {
  return {
      "17",
      "Positions and weights under E_F quickly give large negative energies and inverted elements",
      "quickly; rows up to iteration 6",
      digits(f.inverted) + " of " + digits(f.all) + " vertex orders have inverted triangles, the latest after sweep " +
          std::to_string(f.latest_inverted) + "; " + digits(f.negative) + " negative energies, down to " +
          digits(f.least, 2),
      f.inverted == f.all && f.latest_inverted <= kLastRow && 2 * f.negative > f.all,
      "i_w = 0, no collapses, inversions allowed. " + digits(f.least_sound, 3) +
          " is the least energy that rounding leaves sound; beyond, around flat triangles whose orthocenters are far "
          "away, terms cancel until a sweep's change and the sum of its steps have no digit in common, and positive "
          "energies are as absurd"};
}

/// A sentence on how the run with vertices as numbered stops.
std::string early_stop() {
  const std::vector<Change> all = changes(record(dense_horseshoe(), dense_options("F"), Keep::sweeps));
  if (all.empty()) return "it does not start";
  const Change& last = all.back();
  return "as numbered it stops in sweep " + std::to_string(last.sweep) + ", whose steps change their patches by " +
         digits(last.steps, 2) + " together, and the total by " + digits(last.total, 2);
}

Claim shown_is_mess(const Shown& shown) {
  const auto sweeps = shown.run.all(Snapshot::Moment::after_sweep);
  std::string found;
  bool grows = sweeps.size() > 1;
  for (std::size_t i = 0; i < sweeps.size(); ++i) {
    found += (i == 0 ? "" : ", ") + digits(sweeps[i]->energy, 2) + " (" + digits(inverted(sweeps[i]->mesh)) + ")";
    if (i > 0) grows = grows && sweeps[i]->energy < sweeps[i - 1]->energy;
  }
  return {"17",
          "It does not recover: energies fall and elements stay inverted through iteration 6",
          "a mess in rows 1, 2 and 6",
          "E_F and inverted triangles by iteration, order " + shown.order + ": " + found,
          grows && inverted(sweeps.back()->mesh) > 0,
          "the first vertex order whose run lasts that long. A total that rises counts as converged: " + early_stop()};
}

Claim dt_no_better(const Count& dt) {
  return {"17",
          "E_∂T is no better, since the tangled elements are interior to the domain",
          "no better",
          digits(dt.mess) + " of " + digits(dt.all) + " vertex orders end in a mess, " + digits(dt.inverted) +
              " with inverted triangles",
          2 * dt.mess > dt.all,
          "the same runs under E_∂T; a mess has inverted triangles, negative energy, or ten times the input's"};
}

Claim delay_and_collapse(const Counts& delayed, const Counts& collapsed) {
  return {"17",
          "Collapsing, and delaying weights until positions have converged, still gives a HOT mess",
          "still HOT messes",
          "E_F: " + digits(collapsed.f.mess) + " of " + digits(collapsed.f.all) +
              " orders, E_∂T: " + digits(collapsed.dt.mess) + "; without collapses " + digits(delayed.f.mess) +
              " and " + digits(delayed.dt.mess),
          2 * collapsed.f.mess > collapsed.f.all && 2 * collapsed.dt.mess > collapsed.dt.all,
          "positions to convergence, flips, then positions and weights; E_c = E_F"};
}

Claim restricting(const Counts& restricted, const Counts& before, const Counts& unrestricted) {
  const std::size_t was = unrestricted.f.mess + unrestricted.dt.mess, is = restricted.f.mess + restricted.dt.mess;
  return {"17",
          "These, and restricting weight changes, can sometimes prevent a HOT mess",
          "sometimes",
          "steps to 1.1 of the flip threshold: a mess in " + digits(restricted.f.mess) + " of " +
              digits(restricted.f.all) + " orders for E_F, " + digits(restricted.dt.mess) + " of " +
              digits(restricted.dt.all) + " for E_∂T, against " + digits(unrestricted.f.mess) + " and " +
              digits(unrestricted.dt.mess) + " without the limit",
          is < was && is > 0,
          "steps that stop short of the threshold: " + digits(before.f.mess) + " and " + digits(before.dt.mess)};
}

Table remedies(const std::vector<std::pair<const char*, Counts>>& rows) {
  Table table{
      "Positions and weights of the dense horseshoe: vertex orders that end in a HOT mess, and of these with "
      "inverted triangles and with negative energy.",
      {"weights and steps", "energy", "orders", "mess", "inverted", "negative"},
      {}};
  for (const auto& [name, counts] : rows) {
    for (const auto& [energy, c] : {std::pair{"E_F", counts.f}, std::pair{"E_∂T", counts.dt}}) {
      table.rows.push_back({name, energy, digits(c.all), digits(c.mess), digits(c.inverted), digits(c.negative)});
    }
  }
  return table;
}

}  // namespace

Page make(Effort effort) {
  const bool full = effort == Effort::full;
  const Sample sample = {vertex_orders(full ? 20 : 0), full ? kSweeps : kReducedSweeps};
  const Counts none = count_both(kNone, sample), delayed = count_both(kDelay, sample);
  const Counts collapsed = count_both(kDelayAndCollapse, sample), restricted = count_both(kRestricted, sample);
  const Counts before = count_both(kStopsShort, sample);
  const Shown shown = shown_run();
  Page page;
  page.pictures.push_back(
      {"fig17", panels(shown.run),
       "Left the mesh, with triangles that are turned over in red; right the weights as circles of radius √|w|, green "
       "positive, red negative. Iterations 0, 1, 2 and 6, vertex order " +
           shown.order + "."});
  page.tables.push_back(remedies({{kNone.name, none},
                                  {kDelay.name, delayed},
                                  {kDelayAndCollapse.name, collapsed},
                                  {kRestricted.name, restricted},
                                  {kStopsShort.name, before}}));
  page.claims = {quickly(none.f), shown_is_mess(shown), dt_no_better(none.dt), delay_and_collapse(delayed, collapsed),
                 restricting(restricted, before, collapsed)};
  return page;
}

}  // namespace temper::gallery::fig17
