#include "experiments/star_matrices.hpp"

#include <array>
#include <functional>
#include <string>

#include "experiments/energies.hpp"
#include "experiments/summary_matrix.hpp"
#include "experiments/text.hpp"

namespace temper::gallery {
namespace {

constexpr std::array<Star, 2> kOthers = {Star::zero, Star::two};

std::string name_of(Star star) { return star == Star::zero ? "★0" : "★2"; }

const Matrix& matrix_of(Star star, Effort effort) { return summary_matrix(effort, Inversion::refuse, star); }

bool is_hot(const Cell& c) { return c.energy == "F" || c.energy == "dT" || c.energy == "T"; }
bool is_unbounded(const Cell& c) { return c.energy == "F" || c.energy == "dT"; }
bool moves_only(const Cell& c) { return c.unknowns == Unknowns::positions; }

/// Runs of some cells of both matrices: those with that end, and all.
struct Count {
  std::size_t with = 0, all = 0;
};
Count count(const Matrix& matrix, Verdict verdict, const std::function<bool(const Cell&)>& asked) {
  Count c;
  for (const Cell& cell : matrix.cells) {
    if (!asked(cell)) continue;
    c.with += cell.count(verdict);
    c.all += cell.endings.size();
  }
  return c;
}

/// A claim that both stars have to meet: `part` of the asked runs at least end so.
Claim of_both(Effort effort, const std::string& claim, Verdict verdict, double part,
              const std::function<bool(const Cell&)>& asked, const std::string& why = "") {
  bool holds = true;
  std::string found;
  for (const Star star : kOthers) {
    const Count c = count(matrix_of(star, effort), verdict, asked);
    holds = holds && c.all > 0 && static_cast<double>(c.with) >= part * static_cast<double>(c.all);
    found += (found.empty() ? "" : "; ") + name_of(star) + ": " + std::string(name(verdict)) + " in " + digits(c.with) +
             " of " + digits(c.all) + " runs";
  }
  return {"7 Further Exploration",
          claim,
          "“have not studied ★0 nor ★2”",
          found,
          holds,
          "The runs of figure 32 with another star, two vertex orders; asked for: in at least " +
              digits(100 * part, 3) + " % of them." + why,
          Author::temper};
}

std::string counts_of(const Cell& cell) {
  std::string text;
  for (std::size_t i = 0; i < kVerdicts; ++i) {
    const auto verdict = static_cast<Verdict>(i);
    if (cell.count(verdict) > 0)
      text += (text.empty() ? "" : ", ") + std::string(name(verdict)) + " " + digits(cell.count(verdict));
  }
  return text;
}

}  // namespace

Table star_table(Effort effort) {
  Table t{"The runs of figure 32 for ★0 and ★2, by verdict; no step turns a triangle over.",
          {"energy", "star", "x, no removal", "x, short edges", "x, patch test", "x and w, no removal",
           "x and w, short edges", "x and w, patch test"},
          {}};
  for (const std::string_view energy : kFiveEnergies) {
    for (const Star star : kOthers) {
      std::vector<std::string> row = {symbol(energy), name_of(star)};
      for (const Unknowns unknowns : kUnknowns) {
        for (const RemovalRule rule : kRules) {
          row.push_back(counts_of(matrix_of(star, effort).at(energy, unknowns, rule)));
        }
      }
      t.rows.push_back(row);
    }
  }
  return t;
}

std::vector<Claim> star_claims(Effort effort) {
  return {of_both(effort, "For ★0 and ★2, too, the barriers E_BP and E_BHs always work.", Verdict::good, 1,
                  [](const Cell& c) { return !is_hot(c); }),
          of_both(effort, "For ★0 and ★2, too, positions under E_F, E_∂T and E_T without removals collapse edges.",
                  Verdict::collapsed, 0.5,
                  [](const Cell& c) { return is_hot(c) && moves_only(c) && c.rule == RemovalRule::none; }),
          of_both(
              effort, "For ★0 and ★2, too, weights under E_F and E_∂T produce a HOT mess.", Verdict::mess, 0.5,
              [](const Cell& c) { return is_unbounded(c) && !moves_only(c) && c.rule == RemovalRule::none; },
              " E_F^2 is a convex parabola in each weight (figure 4), and so has nothing to run away to."),
          of_both(effort, "For ★0 and ★2, too, explicit collapses make every energy work on positions alone.",
                  Verdict::good, 1,
                  [](const Cell& c) { return is_hot(c) && moves_only(c) && c.rule == RemovalRule::short_edge; })};
}

}  // namespace temper::gallery
