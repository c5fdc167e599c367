// Figure 14: weights of the sparse horseshoe from iteration 0 on, no collapses, over all vertex orders.
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "experiments/closeness.hpp"
#include "experiments/energies.hpp"
#include "experiments/sparse_runs.hpp"
#include "experiments/text.hpp"
#include "figures.hpp"
#include "plot/plot.hpp"

namespace temper::gallery::fig14 {
namespace {

/// Counts of how runs end over the vertex orders, by energy.
struct Counts {
  std::array<SequenceCount, kFiveEnergies.size()> immediate, deferred;  ///< i_w = 0 and 2
};
Counts count_all(std::size_t stride) {
  Counts counts;
  for (std::size_t i = 0; i < kFiveEnergies.size(); ++i) {
    counts.immediate[i] = count_sequences({.energy = kFiveEnergies[i], .weights_from = 0}, stride);
    counts.deferred[i] = count_sequences({.energy = kFiveEnergies[i], .weights_from = 2}, stride);
  }
  return counts;
}

/// For each energy, the order that leaves the edge most open and the weights bounded; else as numbered, early.
std::string panels(const Counts& counts) {
  std::vector<std::string> svgs;
  for (std::size_t i = 0; i < kFiveEnergies.size(); ++i) {
    const VertexSequence sequence = counts.immediate[i].most_open.value_or(kAsNumbered);
    const SparseRun run = run_sparse({.energy = kFiveEnergies[i], .weights_from = 0, .sequence = sequence});
    const SparseSweep& last = run.runs_away() ? run.sweeps[1] : run.last();
    svgs.push_back(sparse_picture(last.mesh, symbol(kFiveEnergies[i]) + ", vertex order " + name(sequence),
                                  "y = " + digits(last.p4.y) + ", |w| ≤ " + digits(last.largest_weight, 3)));
  }
  return grid_svg(svgs, 3);
}

Table outcomes(const Counts& counts) {
  Table table{
      "How runs over all vertex orders end: p_4 away from its neighbors, with bounded weights or with weights "
      "that run away, or nearly coincident with a neighbor.",
      {"energy", "i_w", "orders", "open, bounded", "open, weights run away", "nearly collapsed"},
      {}};
  for (std::size_t i = 0; i < kFiveEnergies.size(); ++i) {
    for (const int weights_from : {0, 2}) {
      const SequenceCount& c = weights_from == 0 ? counts.immediate[i] : counts.deferred[i];
      table.rows.push_back({symbol(kFiveEnergies[i]), std::to_string(weights_from), digits(c.all),
                            digits(c.open_bounded), digits(c.open - c.open_bounded), digits(c.near)});
    }
  }
  return table;
}

Claim deters_near_collapses(const Counts& counts) {
  bool holds = true;
  std::string found;
  for (std::size_t i = 0; i < kHotEnergies.size(); ++i) {
    const SequenceCount &now = counts.immediate[i], &later = counts.deferred[i];
    holds = holds && now.open > later.open && now.near > 0;
    found += (found.empty() ? "" : "; ") + symbol(kFiveEnergies[i]) + " " + digits(now.open) + " of " +
             digits(now.all) + ", against " + digits(later.open) + " with i_w = 2";
  }
  return {
      "14",
      "With i_w = 0 E_F, E_∂T and E_T can leave the edge open, depending on the vertex order; with i_w = 2 less",
      "do not nearly collapse if i_w = 0, depending on the order",
      "orders that leave it open: " + found,
      holds,
      "each order of the five vertices; open means that p_4 is further than 0.05 of the shorter perimeter edge from "
      "every neighbor, whether or not the weights stay bounded"};
}

Claim hot_weights_run_away(const Counts& counts) {
  const SequenceCount &f = counts.immediate[0], &dt = counts.immediate[1], &t = counts.immediate[2];
  return {"3.1.2",
          "E_F, and so E_∂T inside the domain, is unbounded in the weights; E_T is not",
          "E_F^1 → −∞ as w → −∞",
          "orders that leave the edge open with bounded weights: E_F " + digits(f.open_bounded) + ", E_∂T " +
              digits(dt.open_bounded) + ", E_T " + digits(t.open_bounded) + " of " + digits(t.all) +
              ", while with weights that run away: " + digits(f.open - f.open_bounded) + ", " +
              digits(dt.open - dt.open_bounded) + " and " + digits(t.open - t.open_bounded),
          t.open_bounded == t.open && f.open_bounded < f.open && dt.open_bounded < dt.open,
          "runs of up to 12 sweeps; runaway is |E| > 1e4, where bounded runs stay below 400"};
}

Claim barriers_open(const Counts& counts) {
  std::size_t all = 0, open = 0;
  for (std::size_t i = kHotEnergies.size(); i < kFiveEnergies.size(); ++i) {
    for (const SequenceCount& c : {counts.immediate[i], counts.deferred[i]}) {
      all += c.all;
      open += c.open_bounded;
    }
  }
  return {"14",
          "E_BP and E_BHs make no near-collapses whatever i_w",
          "none regardless of i_w",
          digits(open) + " of " + digits(all) + " runs leave the edge open, with bounded weights",
          open == all,
          "both energies, i_w = 0 and 2, all vertex orders tried"};
}

/// Among orders that leave both energies open and bounded: how far p_4 ends apart.
Claim t_like_dt() {
  std::size_t both = 0, alike = 0;
  double nearest = 1e300, furthest = 0;
  for (const VertexSequence& sequence : all_sequences()) {
    const SparseRun t = run_sparse({.energy = "T", .weights_from = 0, .sequence = sequence});
    const SparseRun dt = run_sparse({.energy = "dT", .weights_from = 0, .sequence = sequence});
    if (t.runs_away() || dt.runs_away() || t.nearly_collapses() || dt.nearly_collapses()) continue;
    const double apart = length(t.last().p4 - dt.last().p4);
    ++both;
    constexpr double kAlike = 0.2;  // a tenth of the distance of p_1 from p_3
    if (apart < kAlike) ++alike;
    nearest = std::min(nearest, apart);
    furthest = std::max(furthest, apart);
  }
  std::string found = "no order leaves both open and bounded";
  if (both > 0) {
    found = "of " + digits(both) + " orders that leave both open and bounded, " + digits(alike) +
            " end with p_4 within 0.2; distances " + digits(nearest, 2) + " to " + digits(furthest, 2);
  }
  return {"14",
          "E_T is similar to E_∂T",
          "similar",
          found,
          both > 0 && 4 * alike > 3 * both,
          "three of four were asked for, where both have a bounded optimum; E_∂T has none for most orders, as it is "
          "E_F inside the domain"};
}

}  // namespace

Page make(Effort effort) {
  const std::size_t stride = effort == Effort::full ? 1 : kReducedStride;
  const Counts counts = count_all(stride);
  Page page;
  page.pictures.push_back({"fig14", panels(counts),
                           "Weights from iteration 0, circles at a quarter of their radius; for each energy the vertex "
                           "order that keeps p_4 furthest from its neighbors with bounded weights. When none does, the "
                           "input's order after one sweep."});
  page.tables.push_back(outcomes(counts));
  page.claims = {deters_near_collapses(counts), hot_weights_run_away(counts), barriers_open(counts), t_like_dt()};
  return page;
}

}  // namespace temper::gallery::fig14
