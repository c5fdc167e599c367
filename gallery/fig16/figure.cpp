// Figure 16: positions of the dense horseshoe without collapses, before flips.
#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/closeness.hpp"
#include "experiments/dense_runs.hpp"
#include "experiments/energies.hpp"
#include "experiments/text.hpp"
#include "figures.hpp"
#include "plot/plot.hpp"
#include "temper/quality.hpp"

namespace temper::gallery::fig16 {
namespace {

/// One run for each energy, vertices as numbered.
struct FiveRuns {
  std::array<Recording, kFiveEnergies.size()> runs;
  [[nodiscard]] const Recording& of(std::string_view energy) const { return runs[position_of(energy)]; }
  [[nodiscard]] const Mesh& mesh(std::string_view energy) const { return before_flips(of(energy)).mesh; }
};
FiveRuns five_runs() {
  FiveRuns five;
  for (std::size_t i = 0; i < kFiveEnergies.size(); ++i) {
    five.runs[i] = record(dense_horseshoe(), dense_positions(kFiveEnergies[i]), Keep::outer);
  }
  return five;
}

std::string panels(const FiveRuns& five, std::span<const std::string_view> energies) {
  std::vector<std::string> svgs;
  for (const std::string_view energy : energies) {
    const Mesh& mesh = five.mesh(energy);
    svgs.push_back(dense_picture(
        mesh, symbol(energy),
        std::to_string(five.of(energy).report.sweeps) + " sweeps, E_F = " + digits(dense_energy(mesh, "F"))));
  }
  return grid_svg(svgs, svgs.size());
}

std::string pair_names(const std::vector<ClosePair>& pairs) {
  std::string text;
  for (const ClosePair& p : pairs) {
    text += (text.empty() ? "" : ", ") + std::to_string(std::min(p.vertex, p.neighbor).index) + "–" +
            std::to_string(std::max(p.vertex, p.neighbor).index);
  }
  return text;
}

bool contains(const std::vector<ClosePair>& pairs, const ClosePair& pair) {
  return std::ranges::any_of(pairs, [&](const ClosePair& p) {
    return std::minmax(p.vertex, p.neighbor) == std::minmax(pair.vertex, pair.neighbor);
  });
}

Claim dt_makes_pairs(const FiveRuns& five) {
  const std::vector<ClosePair> pairs = close_pairs(five.mesh("dT")),
                               soon = close_pairs(five.mesh("dT"), kCollapseRatio);
  return {"16",
          "Positions under E_∂T become nearly coincident",
          "nearly coincident nodes",
          digits(pairs.size()) + " pairs: " + pair_names(pairs) + "; " + digits(soon.size() - pairs.size()) +
              " more within 0.1 of the perimeter edge",
          !pairs.empty(),
          "nearest " + digits(least_closeness(five.mesh("dT")), 2) +
              " of the shorter perimeter edge; nearly coincident is less than 0.05"};
}

Claim bp_makes_none(const FiveRuns& five) {
  const double least = least_closeness(five.mesh("BP"));
  return {"16",
          "Under E_BP they do not, even with γ = 1, a large value",
          "none",
          digits(close_pairs(five.mesh("BP")).size()) + " pairs; the nearest at " + digits(least, 3) +
              " of the shorter perimeter edge",
          least > kCollapseRatio,
          "not even within the collapse ratio of 0.1"};
}

Claim bp_raises_f(const FiveRuns& five) {
  const double before = dense_energy(dense_horseshoe(), "F"), after = dense_energy(five.mesh("BP"), "F");
  return {"16",
          "E_BP gives a mesh with more E_F^1 than the initial one",
          "higher than initially",
          digits(before, 5) + " before, " + digits(after, 5) + " after",
          after > before,
          "before flips; " + digits(dense_energy(five.of("BP").moments.back().mesh, "F"), 5) + " after them"};
}

std::string outside_text(const OutsideCenters& c) { return digits(c.across) + " with " + digits(c.across_distance, 2); }

Claim dt_pulls_centers_in(const FiveRuns& five) {
  const OutsideCenters input = centers_outside_domain(dense_horseshoe());
  const OutsideCenters dt = centers_outside_domain(five.mesh("dT")), f = centers_outside_domain(five.mesh("F"));
  return {"16",
          "E_∂T dramatically reduces how far circumcenters lie outside the domain, across the boundary edges of their "
          "triangles",
          "dramatically reduced",
          "circumcenters across a boundary edge and their distances from it together: input " + outside_text(input) +
              ", E_∂T " + outside_text(dt) + ", E_F " + outside_text(f),
          dt.across_distance < 0.1 * input.across_distance,
          "|h| at the boundary is what E_∂T adds to E_F; reduced by more than nine tenths"};
}

Claim count_outside(const FiveRuns& five) {
  const OutsideCenters input = centers_outside_domain(dense_horseshoe()), dt = centers_outside_domain(five.mesh("dT"));
  const OutsideCenters flipped = centers_outside_domain(five.of("dT").moments.back().mesh);
  return {
      "16",
      "The number of circumcenters in no triangle of the domain falls dramatically under E_∂T",
      "dramatically reduced",
      digits(input.count) + " in the input, " + digits(dt.count) + " before flips, " + digits(flipped.count) +
          " after; their distances from the boundary together: " + digits(input.distance, 3) + ", " +
          digits(dt.distance, 3) + ", " + digits(flipped.distance, 3),
      2 * dt.count < input.count,
      "they come much nearer, but not inside: E_∂T charges |h| at boundary edges only, and most of those circumcenters "
      "belong to triangles further in, " +
          digits(dt.count - std::min(dt.count, dt.across)) + " of " + digits(dt.count) + " before flips"};
}

Claim f_and_t_alike(const FiveRuns& five) {
  const std::vector<ClosePair> dt = close_pairs(five.mesh("dT"), kCollapseRatio);
  bool holds = true;
  std::string found;
  for (const std::string_view energy : {"F", "T"}) {
    const std::vector<ClosePair> pairs = close_pairs(five.mesh(energy));
    holds = holds && !pairs.empty() && std::ranges::all_of(pairs, [&](const ClosePair& p) { return contains(dt, p); });
    found += symbol(energy) + ": " + pair_names(pairs) + "; ";
  }
  return {"16",
          "E_F and E_T make about the same nearly coincident vertices as E_∂T",
          "about the same",
          found + "E_∂T within 0.1: " + pair_names(dt),
          holds,
          "every pair of E_F and E_T is one of E_∂T, which has more"};
}

Claim bhs_like_bp(const FiveRuns& five) {
  const Difference apart = difference(five.mesh("BHs"), five.mesh("BP"));
  const Difference moved = difference(five.mesh("BP"), dense_horseshoe());
  return {"16",
          "E_BHs gives a mesh similar to that of E_BP",
          "similar",
          "interior vertices differ by " + digits(apart.mean_move, 2) + " in the mean, while E_BP moved them by " +
              digits(moved.mean_move, 2),
          apart.mean_move < 0.1 * moved.mean_move,
          "−h° = " + digits(shift_beyond(dense_horseshoe()).value, 3) + ", constant; largest difference " +
              digits(apart.largest_move, 2)};
}

Table by_order(int random) {
  Table table{"Nearly coincident pairs by vertex order; steps stop short of inversion, before flips.",
              {"vertex order", "E_F", "E_∂T", "E_T", "E_BP", "E_BHs"},
              {}};
  for (const VertexOrder& order : vertex_orders(random)) {
    std::vector<std::string> row = {order.name};
    for (const std::string_view energy : kFiveEnergies) {
      const Recording run = record(dense_horseshoe(), dense_positions(energy, order), Keep::outer);
      row.push_back(digits(close_pairs(before_flips(run).mesh).size()));
    }
    table.rows.push_back(row);
  }
  return table;
}

Claim gamma_as_shift(int random) {
  const LengthParameter shift = shift_beyond(dense_horseshoe());
  std::size_t good = 0, all = 0;
  double ours = 0, shifted = 0, usual = 0;  // well-centered parts
  const auto run = [&](std::string_view energy, const VertexOrder& order, std::optional<LengthParameter> gamma) {
    OptimizeOptions options = dense_positions(energy, order);
    if (gamma) options.paper.gamma = *gamma;
    return before_flips(record(dense_horseshoe(), options, Keep::outer)).mesh;
  };
  for (const VertexOrder& order : vertex_orders(random)) {
    const Mesh mesh = run("BP", order, shift);
    const Quality q = quality(mesh);
    ++all;
    good += q.inverted_triangles == 0 && least_closeness(mesh) > kCollapseRatio;
    ours += q.well_centered_fraction;
    shifted += quality(run("BHs", order, {})).well_centered_fraction;
    usual += quality(run("BP", order, {})).well_centered_fraction;
  }
  const auto mean = [&](double sum) { return digits(sum / static_cast<double>(all), 3); };
  return {"4 Starting Inside the Barrier",
          "γ = h° may be suitable for E_BP",
          "may be suitable",
          "γ = −h° = " + digits(shift.value, 3) + ": " + digits(good) + " of " + digits(all) +
              " meshes without inverted or nearly coincident vertices; well-centered " + mean(ours) + ", E_BHs " +
              mean(shifted) + ", E_BP with γ = 1 " + mean(usual),
          good == all && ours >= 0.95 * shifted,
          "positions of the dense horseshoe, the h° that E_BHs needs there; vertex orders; well-centered at least 0.95 "
          "of what E_BHs reaches"};
}

}  // namespace

Page make(Effort effort) {
  const FiveRuns five = five_runs();
  constexpr std::array<std::string_view, 2> kShown = {"dT", "BP"};
  constexpr std::array<std::string_view, 3> kOthers = {"F", "T", "BHs"};
  Page page;
  page.pictures = {{"fig16", panels(five, kShown),
                    "Optimal positions before flips, no collapses. Red: nearly coincident vertices, within 0.05 of the "
                    "perimeter edge; "
                    "yellow: within 0.1, to coincide soon. Vertices in their order, steps stop short of inversion."},
                   {"fig16_others", panels(five, kOthers),
                    "The same for the other energies: E_F and E_T like E_∂T, E_BHs like E_BP."}};
  page.tables.push_back(by_order(effort == Effort::full ? 6 : 0));
  page.claims = {
      dt_makes_pairs(five), bp_makes_none(five), bp_raises_f(five), dt_pulls_centers_in(five),
      count_outside(five),  f_and_t_alike(five), bhs_like_bp(five), gamma_as_shift(effort == Effort::full ? 3 : 0)};
  return page;
}

}  // namespace temper::gallery::fig16
