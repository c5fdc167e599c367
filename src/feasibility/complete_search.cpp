#include "feasibility/complete_search.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>

#include "base/sort_unique.hpp"
#include "feasibility/certify.hpp"
#include "feasibility/edge_rows.hpp"
#include "feasibility/knowledge.hpp"
#include "feasibility/proof_checker.hpp"

namespace temper {
namespace {

constexpr std::size_t kShort = 3;  // lemmas with more edges are left out when apexes are only counted
constexpr double kGoodSide = 4;    // factor of the number of apexes, for a side where weights are good

/// The proof that ends with a lemma, of the lemmas that it needs.
std::vector<Lemma> needed_lemmas(std::vector<Lemma>& lemmas, LemmaId last) {
  std::vector<Lemma> needed;
  std::vector<std::uint8_t> is_needed(last + 1, 0);
  is_needed[last] = 1;
  for (LemmaId i = last + 1; i-- > 0;) {
    if (is_needed[i] == 0) continue;
    for (const Lemma::Case& c : lemmas[i].cases) is_needed[c.lemma] = 1;
  }
  std::vector<LemmaId> number(last + 1, 0);
  for (LemmaId i = 0; i <= last; ++i) {
    if (is_needed[i] == 0) continue;
    for (Lemma::Case& c : lemmas[i].cases) c.lemma = number[c.lemma];
    number[i] = needed.size();
    needed.push_back(std::move(lemmas[i]));
  }
  return needed;
}

/// Says whether a triangle keeps the constraints with these weights, up to rounding.
template <class Weight>
bool keeps(const Mesh& mesh, Constraints constraints, const std::array<VertexId, 3>& corners, const Weight& weight) {
  for (std::size_t k = 0; k < 3; ++k) {
    const VertexId p = corners[k], q = corners[(k + 1) % 3], r = corners[(k + 2) % 3];
    if (value_of(linear_form(mesh, {WeightConstraint::Kind::height, p, q, r}), weight) <= 0) return false;
    if (constraints == Constraints::heights_only) continue;
    const double crossing = value_of(linear_form(mesh, split_constraint(p, q)), weight);
    if (crossing <= 0 || crossing >= 1) return false;
  }
  return true;
}

/// Says whether the triangle keeps the constraints of the edge pq.
bool keeps_exactly(const Space& space, Constraints constraints, const std::array<WeightedPoint, 3>& corners) {
  const auto& [p, q, r] = corners;
  if (constraints == Constraints::well_centered) return is_well_centered(space, p, q, r);
  return signed_height_sign(space, p, q, r) == Sign::positive;
}

class CompleteSearch {
 public:
  CompleteSearch(const Mesh& mesh, Constraints constraints, const std::function<bool()>& stop)
      : mesh_(mesh),
        constraints_(constraints),
        stop_(stop),
        sight_(mesh),
        checker_(mesh, sight_, constraints),
        rows_(mesh, sight_, constraints),
        know_(mesh, sight_) {
    ranges_.push_back(rows_.of_pairs());
    std::vector<ProofEdge> of_all;  // sorted, so that the search does not depend on the connectivity of the mesh
    for (const HalfedgeId h : mesh.halfedges()) {
      if (mesh.is_unflippable(h)) of_all.push_back(edge_between(mesh.origin(h), mesh.target(h)));
    }
    sort_unique(of_all);
    for (const ProofEdge& e : of_all) push(e);
  }

  CompleteSearchResult run() {
    MarginSimplex program(rows_.all(), rows_.n_weights());
    std::optional<LemmaId> lemma = refute(program, ranges_);
    if (!lemma && !is_over()) {
      result_.bound = program.margin();
      root_.emplace(program);
      n_root_ranges_ = ranges_.size();
      lemma = continue_with(program);
    }
    if (lemma) {
      result_.end = CompleteSearchResult::End::none;
      result_.bound = 0;
      result_.proof.lemmas = needed_lemmas(know_.lemmas(), *lemma);
      result_.proof.constraints = constraints_;
    } else if (stopped_) {
      result_.end = CompleteSearchResult::End::stopped;
    } else if (found_) {
      result_.end = CompleteSearchResult::End::found;
    }
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool is_over() const { return found_ || stopped_; }

  void push(const ProofEdge& e) {
    know_.push(e);
    ranges_.push_back(rows_.of_edge(e[0], e[1]));
  }
  void pop() {
    know_.pop();
    ranges_.pop_back();
  }

  // --- lemmas --------------------------------------------------------------------------------------

  /// The lemma of a program without margin; nothing if the exact check does not accept it.
  std::optional<LemmaId> lemma_of(const MarginSimplex& program) {
    double largest = 0;
    program.for_each_multiplier([&](std::size_t /*row*/, double y) { largest = std::max(largest, y); });
    for (const double dropped : {1e-9, 1e-12, 1e-15}) {  // as in certify()
      Lemma lemma;
      program.for_each_multiplier([&](std::size_t row, double y) {
        if (!(y > dropped * largest)) return;
        lemma.terms.push_back(rows_.term(row, y));
        const WeightConstraint& c = lemma.terms.back().constraint;
        if (rows_.needs_edge(row) && !sight_.must_be_edge(c.p, c.q)) lemma.edges.push_back(edge_between(c.p, c.q));
      });
      sort_unique(lemma.edges);
      if (checker_.check(lemma, know_.lemmas()) == CertificateCheck::proves) return know_.store(std::move(lemma));
    }
    return std::nullopt;
  }

  /// Solves a program. Returns its lemma if it has no margin. If rounding spoils the lemma, the program is solved once
  /// more from its first basis.
  std::optional<LemmaId> refute(MarginSimplex& program, std::span<const EdgeRows::Range> ranges) {
    ++result_.programs;
    for (const bool again : {false, true}) {
      if (again) program.restart();
      const MarginSimplex::End end = program.solve(ranges, stop_);
      if (end == MarginSimplex::End::stopped) stopped_ = true;
      if (stopped_ || (end == MarginSimplex::End::optimal && program.margin() >= kNoMargin)) break;
      if (end == MarginSimplex::End::failed) continue;
      if (const auto lemma = lemma_of(program)) return lemma;
    }
    return std::nullopt;
  }

  // --- apexes --------------------------------------------------------------------------------------

  /// Says whether the edge alone has no margin, in all triangulations.
  bool is_dead(const ProofEdge& e) {
    if (sight_.must_be_edge(e[0], e[1])) return false;
    Knowledge::Tested& tested = know_.pair(e).tested;
    if (tested == Knowledge::Tested::no && !is_over()) {
      MarginSimplex program = *root_;
      std::vector<EdgeRows::Range> ranges(ranges_.begin(),
                                          ranges_.begin() + static_cast<std::ptrdiff_t>(n_root_ranges_));
      ranges.push_back(rows_.of_edge(e[0], e[1]));
      tested = refute(program, ranges) ? Knowledge::Tested::dead : Knowledge::Tested::alive;
    }
    return tested == Knowledge::Tested::dead;
  }

  std::size_t count_apexes(const Side& side) {
    const std::vector<VertexId>& all = know_.apexes(side);
    return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [&](VertexId x) {
      const ProofEdge ax = edge_between(side[0], x), bx = edge_between(side[1], x);
      return !know_.known_across(ax) && !know_.known_across(bx) && !is_dead(ax) && !is_dead(bx) &&
             !know_.lemma_against(side, x, kShort);
    }));
  }

  /// The side without triangle that has the fewest apexes for each lemma that names its edge. Sides whose triangle in
  /// the regular triangulation breaks the constraints are preferred.
  std::optional<Side> open_side(const MarginSimplex& program) {
    std::optional<Side> best;
    double least = kUnbounded;
    const auto weight = [&](VertexId v) { return rows_.weight(program, v); };
    for (const ProofEdge& e : know_.known()) {
      for (const Side& side : {Side{e[0], e[1]}, Side{e[1], e[0]}}) {
        if (!know_.is_open(side)) continue;
        const std::vector<VertexId> order = by_height(side, program);
        const bool is_kept = !order.empty() && keeps(mesh_, constraints_, {side[0], side[1], order.front()}, weight);
        const auto n_lemmas = static_cast<double>(know_.pair(e).lemmas.size());
        const double score = (is_kept ? kGoodSide : 1) * static_cast<double>(count_apexes(side)) / (1 + n_lemmas);
        if (score < least) best = side, least = score;
        if (score == 0) return best;
      }
    }
    return best;
  }

  /// Returns the apexes of a side. The apex of the regular triangulation comes first: it has the lowest orthocenter.
  std::vector<VertexId> by_height(const Side& side, const MarginSimplex& program) {
    std::vector<std::pair<double, VertexId>> order;
    for (const VertexId x : know_.apexes(side)) {
      const LinearForm form = linear_form(mesh_, {WeightConstraint::Kind::height, side[0], side[1], x});
      order.emplace_back(value_of(form, [&](VertexId v) { return rows_.weight(program, v); }), x);
    }
    std::sort(order.begin(), order.end());
    std::vector<VertexId> sorted;
    sorted.reserve(order.size());
    for (const auto& [height, x] : order) sorted.push_back(x);
    return sorted;
  }

  // --- search --------------------------------------------------------------------------------------

  /// Returns a lemma whose edges are all known, if there is one.
  std::optional<LemmaId> explore(const MarginSimplex& before) {
    if (stop_ && stop_()) stopped_ = true;
    if (stopped_) return std::nullopt;
    MarginSimplex program = before;
    if (const auto lemma = refute(program, ranges_)) return lemma;
    return continue_with(program);
  }

  std::optional<LemmaId> continue_with(const MarginSimplex& program) {
    if (is_over()) return std::nullopt;
    if (const auto side = open_side(program)) return is_over() ? std::nullopt : branch(*side, program);
    take(program);
    return std::nullopt;
  }

  std::optional<LemmaId> branch(const Side& side, const MarginSimplex& program) {
    const auto [a, b] = side;
    Lemma lemma;
    lemma.side = side;
    bool is_proved = true;
    const auto need = [&](const ProofEdge& e) {
      if (!sight_.must_be_edge(e[0], e[1])) lemma.edges.push_back(e);
    };
    need(edge_between(a, b));
    for (const VertexId x : by_height(side, program)) {
      const ProofEdge ax = edge_between(a, x), bx = edge_between(b, x);
      const auto across_ax = know_.known_across(ax), across_bx = know_.known_across(bx);
      if (across_ax || across_bx) {
        need(across_ax ? *across_ax : *across_bx);
        continue;
      }
      std::optional<LemmaId> against = know_.lemma_against(side, x, know_.known().size());
      if (!against) {
        against = explore_with({ax, bx}, program);
        if (is_over()) return std::nullopt;
        if (!against) {
          is_proved = false;
          continue;
        }
        const std::vector<ProofEdge>& edges = know_.lemmas()[*against].edges;
        if (std::all_of(edges.begin(), edges.end(), [&](const ProofEdge& e) { return know_.is_known(e); }))
          return against;
      }
      for (const ProofEdge& e : know_.lemmas()[*against].edges) {
        if (e != ax && e != bx) need(e);
      }
      lemma.cases.push_back({x, *against});
    }
    if (!is_proved) return std::nullopt;
    sort_unique(lemma.edges);
    return know_.store(std::move(lemma));
  }

  std::optional<LemmaId> explore_with(const std::array<ProofEdge, 2>& edges, const MarginSimplex& program) {
    const std::size_t before = know_.known().size();
    for (const ProofEdge& e : edges) {
      if (!know_.is_known(e)) push(e);
    }
    const auto lemma = explore(program);
    while (know_.known().size() > before) pop();
    return lemma;
  }

  /// Takes the weights of a whole triangulation, if its triangles keep the constraints exactly.
  void take(const MarginSimplex& program) {
    const auto at = [&](VertexId v) {
      const Vec2 p = mesh_.position(v);
      return WeightedPoint{p.x, p.y, rows_.weight(program, v)};
    };
    for (const ProofEdge& e : know_.known()) {
      for (const Side& side : {Side{e[0], e[1]}, Side{e[1], e[0]}}) {
        for (const VertexId x : know_.apexes(side)) {
          if (!know_.is_known(edge_between(side[0], x)) || !know_.is_known(edge_between(side[1], x))) continue;
          if (!keeps_exactly(mesh_.space(), constraints_, {at(side[0]), at(side[1]), at(x)})) return;
        }
      }
    }
    found_ = true;
    result_.weights = IdVector<VertexId, double>(mesh_.n_vertices(), 0.0);
    for (const VertexId v : mesh_.vertices()) result_.weights[v] = rows_.weight(program, v);
  }

  const Mesh& mesh_;
  Constraints constraints_;
  const std::function<bool()>& stop_;
  Sight sight_;
  ProofChecker checker_;
  EdgeRows rows_;
  Knowledge know_;
  std::vector<EdgeRows::Range> ranges_;  ///< of pairs, then of the known edges
  std::optional<MarginSimplex> root_;    ///< the program of the edges of all triangulations
  std::size_t n_root_ranges_ = 0;
  bool found_ = false, stopped_ = false;
  CompleteSearchResult result_;
};

}  // namespace

CompleteSearchResult search_completely(const Mesh& mesh, Constraints constraints, const std::function<bool()>& stop) {
  return CompleteSearch(mesh, constraints, stop).run();
}

}  // namespace temper
