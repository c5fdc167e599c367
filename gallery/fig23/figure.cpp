// Figure 23: where nine policies for the weights lead, from the mesh that oscillates.
#include <algorithm>
#include <string>
#include <vector>

#include "experiments/domain.hpp"
#include "experiments/mesh_picture.hpp"
#include "experiments/numbers.hpp"
#include "experiments/text.hpp"
#include "experiments/weight_policies.hpp"
#include "figures.hpp"
#include "plot/plot.hpp"

namespace temper::gallery::fig23 {
namespace {

constexpr double kWeightScale = 0.25;
constexpr Box kBox = {{-2.3, -0.3}, {2.3, 4.3}};                          // with room for the circles
constexpr std::size_t kAtOnce = 0, kFlipsDeferred = 1, kAllDeferred = 2;  // columns

std::string panel(const PolicyRun& run) {
  MeshPicture picture;
  picture.title = run.policy.limit_name + ": " + run.policy.update_name;
  picture.footer = "E = " + digits(run.energy()) + ", " + digits(run.flips) + " flips, " +
                   digits(run.hidden_inside + run.hidden_on_boundary) + " hidden";
  picture.weight_scale = kWeightScale;
  picture.box = kBox;
  return mesh_picture_svg(run.end, picture);
}

Picture panels() {
  std::vector<std::string> svgs;
  for (const PolicyRun& run : policy_runs()) svgs.push_back(panel(run));
  return {
      "fig23", grid_svg(svgs, kPolicyColumns),
      "After " + digits(policy_runs().front().energies.size() - 1) +
          " sweeps over the weights under E_∂T, from the mesh at the lower right of figure 20. Circles at a quarter of "
          "√|w|, green positive, red negative. Hidden vertices are removed, save at corners of the domain."};
}

Table table() {
  Table t{"The nine runs. Hidden vertices are counted inside the domain and on its boundary.",
          {"limit", "updates", "energy", "flips", "hidden inside", "on the boundary"},
          {}};
  for (const PolicyRun& r : policy_runs()) {
    t.rows.push_back({r.policy.limit_name, r.policy.update_name, digits(r.energy()), digits(r.flips),
                      digits(r.hidden_inside), digits(r.hidden_on_boundary)});
  }
  return t;
}

/// The nine with each vertex order.
using Orders = std::vector<std::vector<PolicyRun>>;
Orders with_orders(Effort effort, const WeightReading& reading = {}) {
  Orders all;
  for (const VertexOrder& order : vertex_orders(effort == Effort::full ? 10 : 0)) {
    all.push_back(run_policies(order, reading));
  }
  return all;
}

/// The same as the figure's, with searches as far as 4 r², and with the normalized energy.
struct Readings {
  Orders shown, far, normalized;
};

std::size_t hidden(const PolicyRun& run) { return run.hidden_inside + run.hidden_on_boundary; }

Claim unlimited_flips_most() {
  const PolicyRun& unlimited = policy_run(policy_runs(), FlipLimit::unlimited, kAtOnce);
  const PolicyRun& after = policy_run(policy_runs(), FlipLimit::after, kAtOnce);
  const PolicyRun& before = policy_run(policy_runs(), FlipLimit::before, kAtOnce);
  return {"23",
          "With immediate updates unlimited weights flip most, stopping after flips less, stopping before never.",
          "37, 13 and 0 flips",
          digits(unlimited.flips) + ", " + digits(after.flips) + " and " + digits(before.flips) + " flips",
          unlimited.flips > after.flips && after.flips > before.flips && before.flips == 0,
          "Every flip of the run counts, also of edges that flip back."};
}

/// What a policy hides, in the figure's order and at most over all of them.
struct Hidden {
  std::size_t inside = 0, on_boundary = 0, most_inside = 0, most_on_boundary = 0;
  [[nodiscard]] std::string text() const {
    return digits(inside) + " inside, " + digits(on_boundary) + " on the boundary";
  }
  [[nodiscard]] std::string most() const {
    return "at most " + digits(most_inside) + " and " + digits(most_on_boundary);
  }
};

Hidden hidden_by(const WeightReading& reading, const Orders& orders, std::size_t column) {
  const PolicyRun& run = policy_run(policy_runs(reading), FlipLimit::unlimited, column);
  Hidden h{run.hidden_inside, run.hidden_on_boundary};
  for (const auto& runs : orders) {
    const PolicyRun& other = policy_run(runs, FlipLimit::unlimited, column);
    h.most_inside = std::max(h.most_inside, other.hidden_inside);
    h.most_on_boundary = std::max(h.most_on_boundary, other.hidden_on_boundary);
  }
  return h;
}

constexpr const char* kReach =
    "The paper's greatest search distance is \"the patch radius\", a length, where a weight is one squared: it decides "
    "this claim.";

Claim unlimited_hides(const Readings& readings) {
  const Hidden near = hidden_by({}, readings.shown, kAtOnce), far = hidden_by(kFarSearches, readings.far, kAtOnce);
  return {"23",
          "With immediate updates and unlimited weights many vertices become hidden, inside and three on the boundary.",
          "many inside, three on the boundary",
          "searches up to 4 r²: " + far.text() + "; up to r²: " + near.text(),
          far.inside > 3 && far.on_boundary > 0,
          "Over " + digits(readings.shown.size()) + " vertex orders " + far.most() + " with 4 r², " + near.most() +
              " with r², the mean square distance to the neighbors. " + kReach};
}

Claim before_never_flips() {
  const PolicyRun& at_once = policy_run(policy_runs(), FlipLimit::before, kAtOnce);
  const PolicyRun& deferred = policy_run(policy_runs(), FlipLimit::before, kFlipsDeferred);
  return {"23",
          "Stopping before with immediate weights has no flips and hides no vertices, so that it does not matter when "
          "flips are done.",
          "independent of whether flips are immediate or deferred",
          digits(at_once.flips) + " and " + digits(deferred.flips) + " flips, " + digits(hidden(at_once)) + " and " +
              digits(hidden(deferred)) + " hidden, the two meshes " +
              (at_once.end == deferred.end ? "equal bit for bit" : "differ"),
          at_once.flips + deferred.flips + hidden(at_once) + hidden(deferred) == 0 && at_once.end == deferred.end,
          "Positions, weights and connectivity compared without tolerance."};
}

/// Orthocenters beyond the boundary, and how far the farthest is.
struct Outside {
  std::size_t count = 0;
  double farthest = 0;
};

Outside orthocenters_outside(const Mesh& mesh) {
  constexpr double kOnBoundary = 1e-6;  // where |h| is least; edges there are 0.1 long and more
  Outside outside;
  for (const TriangleId t : mesh.triangles()) {
    const Vec2 o = orthocenter_of(mesh, t);
    const double distance = is_in_domain(mesh, o) ? 0 : distance_to_boundary(mesh, o);
    if (distance > kOnBoundary) ++outside.count;
    outside.farthest = std::max(outside.farthest, distance);
  }
  return outside;
}

Claim duals_move_inside() {
  std::size_t all_inside = 0;
  double farthest = 0;
  std::string exceptions;
  for (const PolicyRun& run : policy_runs()) {
    const Outside outside = orthocenters_outside(run.end);
    if (outside.count == 0) {
      ++all_inside;
      farthest = std::max(farthest, outside.farthest);
    } else {
      exceptions += (exceptions.empty() ? "" : "; ") + digits(outside.count) + " outside, up to " +
                    digits(outside.farthest, 2) + ", in " + run.policy.limit_name + ", " + run.policy.update_name;
    }
  }
  const Outside start = orthocenters_outside(oscillating_mesh());
  return {"23",
          "All dual vertices have moved inside the domain.",
          "all",
          "all inside or on the boundary in " + digits(all_inside) + " of " + digits(policy_runs().size()) +
              " meshes; at the start " + digits(start.count) + " outside, up to " + digits(start.farthest, 2),
          all_inside == policy_runs().size(),
          "Those on the boundary are up to " + digits(farthest, 1) + " beyond it: |h| is least there. " +
              (exceptions.empty() ? "" : "Exceptions: " + exceptions + ".")};
}

std::size_t rises_of(const Orders& orders, std::size_t column) {
  std::size_t rises = 0;
  for (const auto& runs : orders) rises += policy_run(runs, FlipLimit::unlimited, column).rises;
  return rises;
}

Claim deferred_flips_are_chaotic(const Readings& readings) {
  const Hidden near = hidden_by({}, readings.shown, kFlipsDeferred);
  const Hidden far = hidden_by(kFarSearches, readings.far, kFlipsDeferred);
  const PolicyRun& run = policy_run(policy_runs(kFarSearches), FlipLimit::unlimited, kFlipsDeferred);
  return {"23",
          "Unlimited weights with deferred flips are chaotic, and hide vertices of the arch.",
          "chaotic, a different domain",
          "searches up to 4 r²: the energy rose after " + digits(run.rises) + " of " + digits(run.energies.size() - 1) +
              " sweeps, hidden " + far.text() + "; up to r² after " +
              digits(policy_run(policy_runs(), FlipLimit::unlimited, kFlipsDeferred).rises) + ", hidden " + near.text(),
          run.rises > 1 && far.inside + far.on_boundary > 0,
          "Over " + digits(readings.shown.size()) + " vertex orders it rose after " +
              digits(rises_of(readings.far, kFlipsDeferred)) + " sweeps in all with 4 r², after " +
              digits(rises_of(readings.shown, kFlipsDeferred)) + " with r². " + kReach +
              " Vertices at corners of the domain are never removed: the domain stays."};
}

/// Least energies of a policy over vertex orders, and in how many of them no other limit did better.
struct Standing {
  std::vector<double> energies;
  std::size_t best = 0;
  double worst_excess = 0;  ///< over the best limit, relative
};

Standing standing(const std::vector<std::vector<PolicyRun>>& orders, FlipLimit limit, std::size_t column) {
  constexpr double kTie = 1e-3;  // relative
  Standing s;
  for (const auto& runs : orders) {
    const double energy = policy_run(runs, limit, column).least();
    double best = energy;
    for (const FlipLimit other : kPolicyRows) best = std::min(best, policy_run(runs, other, column).least());
    s.energies.push_back(energy);
    s.best += energy <= (1 + kTie) * best ? 1 : 0;
    s.worst_excess = std::max(s.worst_excess, energy / best - 1);
  }
  return s;
}

Table standings(const std::vector<std::vector<PolicyRun>>& orders) {
  Table t{"The least energy of each run, over " + digits(orders.size()) +
              " vertex orders: median, and in how many orders no other limit ends lower by more than 0.1 %.",
          {"updates", "unlimited", "best in", "before", "best in", "after", "best in"},
          {}};
  for (const std::size_t column : {kAtOnce, kFlipsDeferred, kAllDeferred}) {
    std::vector<std::string> row = {policy_runs()[column].policy.update_name};
    for (const FlipLimit limit : kPolicyRows) {
      const Standing s = standing(orders, limit, column);
      row.push_back(digits(median(s.energies)));
      row.push_back(digits(s.best));
    }
    t.rows.push_back(row);
  }
  return t;
}

/// In how many cases, orders and columns, stopping after is best.
struct AfterBest {
  std::size_t best = 0, cases = 0;
  double worst = 0;  ///< relative excess elsewhere
  [[nodiscard]] std::string text() const {
    return "in " + digits(best) + " of " + digits(cases) + " cases, elsewhere at most " + digits(100 * worst, 2) +
           " % above the lowest";
  }
};

AfterBest after_best(const Orders& orders) {
  AfterBest all;
  for (const std::size_t column : {kAtOnce, kFlipsDeferred, kAllDeferred}) {
    const Standing s = standing(orders, FlipLimit::after, column);
    all.best += s.best;
    all.worst = std::max(all.worst, s.worst_excess);
  }
  all.cases = kPolicyColumns * orders.size();
  return all;
}

Claim after_is_best(const Readings& readings) {
  const AfterBest near = after_best(readings.shown), far = after_best(readings.far);
  return {"6.6.2",
          "Stopping after the threshold gives the mesh of lowest energy in all cases.",
          "in all cases",
          "searches up to 4 r²: " + far.text() + "; up to r²: " + near.text() +
              "; with the normalized energy: " + after_best(readings.normalized).text(),
          far.cases > 0 && far.best == far.cases,
          "Searches that reach only r² stay near the local minimum without any limit, and gain by not stopping: "
          "unlimited weights are then best in " +
              digits(standing(readings.shown, FlipLimit::unlimited, kAtOnce).best) + " of " +
              digits(readings.shown.size()) + " orders with immediate updates and in " +
              digits(standing(readings.shown, FlipLimit::unlimited, kFlipsDeferred).best) + " with deferred flips."};
}

Claim after_beats_before(const std::vector<std::vector<PolicyRun>>& orders) {
  std::size_t better = 0;
  for (const auto& runs : orders) {
    const double after = policy_run(runs, FlipLimit::after, kAtOnce).energy();
    better += after < policy_run(runs, FlipLimit::before, kAtOnce).energy() ? 1 : 0;
  }
  return {"6.6.2",
          "With immediate updates stopping after gives lower energy than stopping before.",
          "the best quality",
          "in " + digits(better) + " of " + digits(orders.size()) +
              " vertex orders; shown: " + digits(policy_run(policy_runs(), FlipLimit::after, kAtOnce).energy()) +
              " against " + digits(policy_run(policy_runs(), FlipLimit::before, kAtOnce).energy()),
          !orders.empty() && better == orders.size(),
          "The energy after the same number of sweeps."};
}

/// Deferred weights and flips against immediate ones, stopping before and after.
struct Deferral {
  std::size_t lower = 0, more_hidden = 0, cases = 0;
  [[nodiscard]] std::string text() const {
    return "lower in " + digits(lower) + " of " + digits(cases) + " cases, more hidden vertices in " +
           digits(more_hidden);
  }
};

Deferral deferral(const Orders& orders) {
  Deferral d;
  for (const auto& runs : orders) {
    for (const FlipLimit limit : {FlipLimit::before, FlipLimit::after}) {
      const PolicyRun &deferred = policy_run(runs, limit, kAllDeferred), &at_once = policy_run(runs, limit, kAtOnce);
      ++d.cases;
      d.lower += deferred.least() < at_once.least() ? 1 : 0;
      d.more_hidden += hidden(deferred) > hidden(at_once) ? 1 : 0;
    }
  }
  return d;
}

Claim deferring_hides(const Readings& readings) {
  const Deferral shown = deferral(readings.shown);
  return {"6.6.2",
          "With deferred weights stopping after or before reaches lower energy than with immediate updates, because "
          "vertices on the base of the arms are hidden.",
          "lower energy, hidden vertices",
          shown.text() + "; with the normalized energy: " + deferral(readings.normalized).text(),
          shown.cases > 0 && 2 * shown.lower > shown.cases && shown.more_hidden == shown.cases,
          "Stopping before and after with " + digits(readings.shown.size()) +
              " vertex orders; in most cases was asked "
              "for. \"These results depend on optimizing the normalized energy\": E_∂T over squared areas."};
}

}  // namespace

Page make(Effort effort) {
  const Readings readings{with_orders(effort), with_orders(effort, kFarSearches), with_orders(effort, kNormalized)};
  const Orders& orders = readings.shown;
  return {{panels()},
          {table(), standings(orders)},
          {unlimited_flips_most(), unlimited_hides(readings), before_never_flips(), duals_move_inside(),
           deferred_flips_are_chaotic(readings), after_is_best(readings), after_beats_before(orders),
           deferring_hides(readings)}};
}

}  // namespace temper::gallery::fig23
